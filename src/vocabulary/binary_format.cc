// SPDX-License-Identifier: GPL-3.0-or-later
#include "binary_format.h"

#include <span>
#include <string>

#include "orbslam/util/bytes.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

constexpr uint32_t kVersion = 1;

struct Header {
  char magic[8];
  uint32_t version;
  uint32_t branching;
  uint32_t depth;
  uint32_t descriptor_bytes;
  uint64_t num_nodes;
  uint64_t num_words;
  uint64_t checksum;
};
static_assert(sizeof(Header) == 48 && sizeof(Descriptor) == 32);

uint64_t ChecksumOf(Header header, const VocabularyTree& tree) {
  header.checksum = 0;
  uint64_t hash = Checksum(std::as_bytes(std::span(&header, 1)));
  hash = MixChecksum(hash, Checksum(std::as_bytes(std::span(tree.descriptors))));
  hash = MixChecksum(hash, Checksum(std::as_bytes(std::span(tree.child_counts))));
  return MixChecksum(hash, Checksum(std::as_bytes(std::span(tree.word_weights))));
}

/// Nothing is allocated before the size of the file has confirmed the counts.
Status CheckHeader(const Header& header, size_t file_size) {
  constexpr uint64_t kMostNodes = uint64_t{1} << 28;
  if (header.version != kVersion) {
    return Error{"vocabulary of version " + std::to_string(header.version) + "; this program reads version " +
                 std::to_string(kVersion)};
  }
  if (header.descriptor_bytes != sizeof(Descriptor))
    return Error{"vocabulary of descriptors other than 256 bits"};
  if (header.num_nodes > kMostNodes || header.num_words > header.num_nodes || header.branching > 255 ||
      header.depth > 255) {
    return Error{"damaged vocabulary: impossible counts"};
  }
  const size_t wanted = sizeof(Header) + header.num_nodes * 33 + header.num_words * 4;
  if (file_size != wanted) {
    return Error{std::string(file_size < wanted ? "truncated" : "damaged") +
                 " vocabulary: " + std::to_string(file_size) + " bytes instead of " + std::to_string(wanted)};
  }
  return OkStatus();
}

}  // namespace

Result<VocabularyTree> ParseBinaryTree(std::string_view bytes) {
  Header header{};
  const size_t file_size = bytes.size();
  if (!TakeBytes(&header, &bytes)) return Error{"truncated vocabulary: it ends within its header"};
  if (const Status status = CheckHeader(header, file_size); !status) return status.error();

  VocabularyTree tree;
  tree.branching = static_cast<int>(header.branching);
  tree.depth = static_cast<int>(header.depth);
  ORBSLAM_CHECK(
      TakeBytes(header.num_nodes, &tree.descriptors, &bytes) &&
      TakeBytes(header.num_nodes, &tree.child_counts, &bytes) &&
      TakeBytes(header.num_words, &tree.word_weights, &bytes));  // the size of the file has promised it
  if (ChecksumOf(header, tree) != header.checksum)
    return Error{"damaged vocabulary: the checksum does not match"};
  return tree;
}

std::string FormatBinaryTree(const VocabularyTree& tree) {
  Header header{};
  kBinaryMagic.copy(header.magic, sizeof(header.magic));
  header.version = kVersion;
  header.branching = static_cast<uint32_t>(tree.branching);
  header.depth = static_cast<uint32_t>(tree.depth);
  header.descriptor_bytes = sizeof(Descriptor);
  header.num_nodes = tree.child_counts.size();
  header.num_words = tree.word_weights.size();
  header.checksum = ChecksumOf(header, tree);

  std::string bytes;
  AppendBytes(std::span<const Header>(&header, 1), &bytes);
  AppendBytes(std::span<const Descriptor>(tree.descriptors), &bytes);
  AppendBytes(std::span<const uint8_t>(tree.child_counts), &bytes);
  AppendBytes(std::span<const float>(tree.word_weights), &bytes);
  return bytes;
}

}  // namespace orbslam
