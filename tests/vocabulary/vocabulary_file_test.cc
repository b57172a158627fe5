// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/vocabulary/vocabulary_file.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cstdio>

#include "orbslam/util/file.h"
#include "vocabulary/random_vocabulary.h"

namespace orbslam {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class VocabularyFileTest : public testing::Test {
 protected:
  /// What reading a file with this content says; it must be one line that begins with the path.
  std::string Refusal(const std::string& content) {
    const std::string path = folder_ / "refused";
    EXPECT_TRUE(WriteFileAtomically(path, content).ok());
    const Result<Vocabulary> vocabulary = ReadVocabulary(path);
    if (vocabulary) return "accepted";
    EXPECT_THAT(vocabulary.error().message, StartsWith(path + ":"));
    EXPECT_THAT(vocabulary.error().message, Not(HasSubstr("\n")));
    return vocabulary.error().message;
  }
  std::string WrittenBytes(const Vocabulary& vocabulary) {
    EXPECT_TRUE(WriteVocabulary(vocabulary, folder_ / "written").ok());
    return ReadFile(folder_ / "written").value();
  }

  TemporaryFolder folder_{"vocabulary_file"};
};

TEST_F(VocabularyFileTest, RoundTripKeepsEverything) {
  for (const int branching : {2, 3, 10}) {
    const Vocabulary written = RandomVocabulary(branching, 3, static_cast<uint64_t>(branching));
    ASSERT_TRUE(WriteVocabulary(written, folder_ / "voc.bin").ok());
    const Result<Vocabulary> read = ReadVocabulary(folder_ / "voc.bin");
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->branching(), written.branching());
    EXPECT_EQ(read->depth(), written.depth());
    EXPECT_EQ(read->tree().descriptors, written.tree().descriptors);
    EXPECT_EQ(read->tree().child_counts, written.tree().child_counts);
    EXPECT_EQ(read->tree().word_weights, written.tree().word_weights);
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}),
            1);  // nothing temporary stays
}

TEST_F(VocabularyFileTest, EveryTruncationIsRefused) {
  const std::string bytes = WrittenBytes(RandomVocabulary(3, 2, 1));
  ASSERT_LT(bytes.size(), 1000U);
  for (size_t length = 0; length < bytes.size(); ++length) {
    const std::string refusal = Refusal(bytes.substr(0, length));
    EXPECT_THAT(refusal, HasSubstr(length < 8 ? "not a vocabulary" : "truncated")) << length;
  }
  EXPECT_THAT(Refusal(bytes + '\0'), HasSubstr("damaged"));
}

TEST_F(VocabularyFileTest, EveryFlippedBitIsRefused) {
  const std::string bytes = WrittenBytes(RandomVocabulary(3, 2, 2));
  Rng rng(3);
  for (size_t at = 0; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << rng.Below(8)));
    EXPECT_NE(Refusal(damaged), "accepted") << "byte " << at;
  }
}

TEST_F(VocabularyFileTest, ForeignFilesAreRefused) {
  EXPECT_THAT(Refusal("\x89PNG\r\n\x1a\n and so on"), HasSubstr("not a vocabulary"));
  EXPECT_THAT(Refusal("%YAML:1.0\nvocabulary:\n"), HasSubstr("not a vocabulary"));
  EXPECT_THAT(Refusal(std::string(5000, '\0')), HasSubstr("not a vocabulary"));
  EXPECT_THAT(ReadVocabulary(folder_ / "missing").error().message, HasSubstr("missing"));
  EXPECT_FALSE(ReadVocabulary(folder_.path().string()).ok());
}

TEST_F(VocabularyFileTest, WritingIntoNoFolderIsAnError) {
  const Status status = WriteVocabulary(RandomVocabulary(2, 2, 1), folder_ / "none/voc.bin");
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.error().message, HasSubstr("none/voc.bin"));
}

TEST(ShippedVocabularyTest, OpensQuicklyAndIsWhatItsDocumentationSays) {
  const auto start = std::chrono::steady_clock::now();
  const Result<Vocabulary> vocabulary = ReadVocabulary(ORBSLAM_SHIPPED_VOCABULARY);
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(vocabulary.ok()) << vocabulary.error().message;
  std::printf("opened in %.1f ms\n", elapsed.count());
  EXPECT_EQ(vocabulary->branching(), 10);
  EXPECT_EQ(vocabulary->depth(), 5);
  EXPECT_GT(vocabulary->num_words(), 50000);
}

}  // namespace
}  // namespace orbslam
