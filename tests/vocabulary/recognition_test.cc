// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped vocabulary on real sequences that it was not trained on.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "orbslam/features/orb_extractor.h"
#include "orbslam/io/image_file.h"
#include "orbslam/vocabulary/vocabulary_file.h"

namespace orbslam {
namespace {

std::vector<BowVector> BowsOfSequence(const Vocabulary& vocabulary, const std::string& folder, size_t step) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files.push_back(entry.path().string());
  std::ranges::sort(files);
  OrbExtractor extractor({});
  std::vector<BowVector> bows;
  for (size_t i = 0; i < files.size(); i += step) {
    bows.push_back(vocabulary.Transform(extractor.Extract(ReadGray(files[i]).value()).descriptors, 1).bow);
  }
  return bows;
}

float Median(std::vector<float> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

TEST(RecognitionTest, FramesNearInTimeScoreMuchHigherThanOthers) {
  const char* data = std::getenv("ORBSLAM_DATA");
  if (data == nullptr) GTEST_SKIP() << "needs ORBSLAM_DATA (fr1_xyz and fr1_rpy)";
  const Result<Vocabulary> vocabulary = ReadVocabulary(ORBSLAM_SHIPPED_VOCABULARY);
  ASSERT_TRUE(vocabulary.ok()) << vocabulary.error().message;
  const std::string folder = data;
  const auto xyz = BowsOfSequence(*vocabulary, folder + "/fr1_xyz/rgb", 4);  // every 0.13 s
  const auto rpy = BowsOfSequence(*vocabulary, folder + "/fr1_rpy/rgb", 4);
  ASSERT_GT(std::min(xyz.size(), rpy.size()), 20U);

  std::vector<float> near, other;
  for (const auto* sequence : {&xyz, &rpy}) {
    for (size_t i = 1; i < sequence->size(); ++i) near.push_back(Score((*sequence)[i - 1], (*sequence)[i]));
  }
  for (const BowVector& a : xyz) {
    for (const BowVector& b : rpy) other.push_back(Score(a, b));
  }
  std::printf("median score 0.13 s apart %.3f, across the sequences %.3f\n", Median(near), Median(other));
  EXPECT_GT(Median(near), 1.5F * Median(other));  // both show the same desk, so others are not unlike
}

}  // namespace
}  // namespace orbslam
