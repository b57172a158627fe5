// SPDX-License-Identifier: GPL-3.0-or-later
// ReadVocabulary() on DBoW2's text format.
#include <gmock/gmock.h>

#include <cstdlib>
#include <set>
#include <sstream>

#include "orbslam/util/file.h"
#include "orbslam/vocabulary/vocabulary_file.h"
#include "vocabulary/random_vocabulary.h"

namespace orbslam {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

constexpr const char* kZeros = " 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 ";
constexpr const char* kOnes =
    " 255 255 255 255 255 255 255 255 255 255 255 255 255 255 255 255 255 255 255 255 255 255 255 255 255 "
    "255 255 255 "
    "255 255 255 255 ";

class TextVocabularyTest : public testing::Test {
 protected:
  Result<Vocabulary> Read(const std::string& text) {
    EXPECT_TRUE(WriteFileAtomically(folder_ / "voc.txt", text).ok());
    return ReadVocabulary(folder_ / "voc.txt");
  }
  std::string Refusal(const std::string& text) {
    const Result<Vocabulary> vocabulary = Read(text);
    return vocabulary ? "accepted" : vocabulary.error().message;
  }

  TemporaryFolder folder_{"text_vocabulary"};
  // Depth first, as DBoW2 writes: 1 = (0), 2 and 3 below 1, 4 = (0).
  const std::string node1_ = "0 0" + std::string(kZeros) + " 0\n",
                    node2_ = "1 1" + std::string(kZeros) + " 1.5\n",
                    node3_ = "1 1 8" + std::string(kZeros).substr(2) + " 2.5\n",
                    node4_ = "0 1" + std::string(kOnes) + " 3.5\n";
};

TEST_F(TextVocabularyTest, ReadsNodesInAnyOrderOfTheTree) {
  const Result<Vocabulary> vocabulary = Read("2 2  0 0\n" + node1_ + node2_ + node3_ + node4_ + "\n");
  ASSERT_TRUE(vocabulary.ok()) << vocabulary.error().message;
  EXPECT_EQ(vocabulary->num_words(), 3);
  const auto weight_of = [&](const Descriptor& d) {
    return vocabulary->tree().word_weights[vocabulary->Find(d, 2).word];
  };
  EXPECT_EQ(weight_of({}), 1.5F);
  EXPECT_EQ(weight_of({{8, 0, 0, 0}}), 2.5F);  // the first byte's bit 3: the lowest byte of the first word
  EXPECT_EQ(weight_of({{~0ull, ~0ull, ~0ull, 0}}), 3.5F);
}

TEST_F(TextVocabularyTest, RefusalsNameFileAndLine) {
  EXPECT_THAT(Refusal("2 2 0 0\n" + node1_ + node4_),
              HasSubstr("voc.txt:2: node 1 is not a leaf but has no children"));
  EXPECT_THAT(Refusal("2 2 0 0\n"), HasSubstr("truncated"));
  EXPECT_THAT(Refusal("2 2 0 0\n" + node4_ + node2_), HasSubstr("voc.txt:3: the parent is a leaf"));
  EXPECT_THAT(Refusal("2 2 0 0\n" + node1_ + "7 1" + kZeros + " 1\n"), HasSubstr("voc.txt:3: the parent"));
  EXPECT_THAT(Refusal("2 2 0 0\n" + node1_ + node2_ + node3_ + node4_ + node4_),
              HasSubstr("more than k children"));
  EXPECT_THAT(Refusal("2 1 0 0\n" + node1_ + node2_ + node3_ + node4_), HasSubstr("deeper than L"));
  EXPECT_THAT(Refusal("2 2 5 0\n" + node1_), HasSubstr("voc.txt:1: only L1"));
  EXPECT_THAT(Refusal("2 2\n"), HasSubstr("voc.txt:1: not a vocabulary"));
  for (const std::string bad : {"0 1 1 2 3", "0 2", "0 1 x", "0 1 256"}) {
    EXPECT_THAT(Refusal("2 2 0 0\n" + node1_ + bad + "\n"), HasSubstr("voc.txt:3: expected"));
  }
  EXPECT_THAT(Refusal("2 2 0 0\n0 1" + std::string(kZeros) + " 1 9\n"), HasSubstr("voc.txt:2: expected"));
}

/// The lines of a vocabulary, with the leaf flag set of every node that no line names as parent.
std::string WithChildlessNodesAsLeaves(const std::string& text) {
  std::istringstream lines(text);
  std::string header, line, result;
  std::getline(lines, header);
  std::vector<std::pair<int, std::string>> nodes{{-1, ""}};
  std::set<int> parents;
  while (std::getline(lines, line)) {
    const size_t blank = line.find(' ');
    nodes.emplace_back(std::stoi(line), line.substr(blank + 2));  // behind `parent leaf`
    parents.insert(nodes.back().first);
  }
  for (size_t id = 1; id < nodes.size(); ++id) {
    const char* leaf = parents.contains(static_cast<int>(id)) ? " 0" : " 1";
    result += std::to_string(nodes[id].first) + leaf + nodes[id].second + "\n";
  }
  return header + "\n" + result;
}

TEST_F(TextVocabularyTest, OriginalVocabularyIsRefusedWhenTruncatedAndReadWhenComplete) {
  const char* data = std::getenv("ORBSLAM_DATA");
  if (data == nullptr) GTEST_SKIP() << "needs ORBSLAM_DATA (vocabulary/ORBvoc_prefix.txt)";
  const std::string path = std::string(data) + "/vocabulary/ORBvoc_prefix.txt";
  const Result<Vocabulary> truncated = ReadVocabulary(path);
  ASSERT_FALSE(truncated.ok());
  EXPECT_THAT(truncated.error().message, testing::StartsWith(path + ":"));
  EXPECT_THAT(truncated.error().message, EndsWith("the file is truncated"));

  const Result<Vocabulary> vocabulary = Read(WithChildlessNodesAsLeaves(ReadFile(path).value()));
  ASSERT_TRUE(vocabulary.ok()) << vocabulary.error().message;
  EXPECT_EQ(vocabulary->branching(), 10);
  EXPECT_EQ(vocabulary->depth(), 6);
  EXPECT_EQ(vocabulary->num_nodes(), 2001);
}

}  // namespace
}  // namespace orbslam
