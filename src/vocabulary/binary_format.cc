// SPDX-License-Identifier: GPL-3.0-or-later
#include "binary_format.h"

#include <bit>
#include <cstring>
#include <span>
#include <string>

#include "orbslam/util/check.h"

namespace orbslam {
namespace {

static_assert(std::endian::native == std::endian::little,
              "the format is read and written as it lies in memory");

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

/// One to one in either argument when the other is fixed: a change of a single word always changes the
/// result.
uint64_t Mix(uint64_t hash, uint64_t word) { return std::rotl((hash ^ word) * 0x9E3779B97F4A7C15u, 29); }

/// Four independent lanes of 8 bytes, for the processor to work on at once: about memory speed.
uint64_t Checksum(std::span<const std::byte> bytes) {
  uint64_t lanes[4] = {1, 2, 3, 4};
  uint64_t block[4];
  const size_t whole = bytes.size() / sizeof(block) * sizeof(block);
  const auto mix_block = [&] {
    for (int i = 0; i < 4; ++i) lanes[i] = Mix(lanes[i], block[i]);
  };
  for (size_t at = 0; at < whole; at += sizeof(block)) {
    std::memcpy(block, bytes.data() + at, sizeof(block));
    mix_block();
  }
  std::memset(block, 0, sizeof(block));
  if (whole < bytes.size()) std::memcpy(block, bytes.data() + whole, bytes.size() - whole);
  mix_block();
  uint64_t hash = bytes.size();
  for (const uint64_t lane : lanes) hash = Mix(hash, lane);
  return hash;
}

uint64_t ChecksumOf(Header header, const VocabularyTree& tree) {
  header.checksum = 0;
  uint64_t hash = Checksum(std::as_bytes(std::span(&header, 1)));
  hash = Mix(hash, Checksum(std::as_bytes(std::span(tree.descriptors))));
  hash = Mix(hash, Checksum(std::as_bytes(std::span(tree.child_counts))));
  return Mix(hash, Checksum(std::as_bytes(std::span(tree.word_weights))));
}

/// Fills items with the front of bytes and drops it there. The header has promised that there are enough.
template <class T>
void TakeInto(std::span<T> items, std::string_view* bytes) {
  ORBSLAM_CHECK(bytes->size() >= items.size_bytes());
  std::memcpy(items.data(), bytes->data(), items.size_bytes());
  bytes->remove_prefix(items.size_bytes());
}

template <class T>
void Append(std::span<const T> items, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(items.data()), items.size_bytes());
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
  if (bytes.size() < sizeof(header)) return Error{"truncated vocabulary: it ends within its header"};
  const size_t file_size = bytes.size();
  TakeInto(std::span(&header, 1), &bytes);
  if (const Status status = CheckHeader(header, file_size); !status) return status.error();

  VocabularyTree tree;
  tree.branching = static_cast<int>(header.branching);
  tree.depth = static_cast<int>(header.depth);
  tree.descriptors.resize(header.num_nodes);
  tree.child_counts.resize(header.num_nodes);
  tree.word_weights.resize(header.num_words);
  TakeInto(std::span(tree.descriptors), &bytes);
  TakeInto(std::span(tree.child_counts), &bytes);
  TakeInto(std::span(tree.word_weights), &bytes);
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
  Append(std::span<const Header>(&header, 1), &bytes);
  Append(std::span<const Descriptor>(tree.descriptors), &bytes);
  Append(std::span<const uint8_t>(tree.child_counts), &bytes);
  Append(std::span<const float>(tree.word_weights), &bytes);
  return bytes;
}

}  // namespace orbslam
