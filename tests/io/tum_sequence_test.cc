// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/io/tum_sequence.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "orbslam/util/random.h"
#include "util/temp_dir.h"

namespace orbslam {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(TumSequence, ReadsAssociationsHoweverTheyAreSeparated) {
  const TempDir dir;
  const std::string list = dir.Write("list.txt",
                                     "\xEF\xBB\xBF# comment\r\n\r\n"
                                     "1.500 rgb/a.png 1.51 depth/a.png\r\n"
                                     "  1.600,rgb/b.png,\t1.61   depth/b.png\r\n"
                                     "1.7000 /abs/c.png 1.71 depth/c.png");
  const Result<TumSequence> sequence = ReadTumSequence("/data", list);
  ASSERT_TRUE(sequence.ok());
  EXPECT_THAT(sequence->warnings, IsEmpty());
  ASSERT_EQ(sequence->entries.size(), 3u);
  EXPECT_EQ(sequence->entries[0].timestamp_text, "1.500");
  EXPECT_EQ(sequence->entries[0].timestamp_s, 1.5);
  EXPECT_EQ(sequence->entries[0].rgb_path, "/data/rgb/a.png");
  EXPECT_EQ(sequence->entries[1].depth_path, "/data/depth/b.png");
  EXPECT_EQ(sequence->entries[2].rgb_path, "/abs/c.png");
  EXPECT_EQ(sequence->entries[2].timestamp_text, "1.7000");
  for (const RgbdEntry& entry : sequence->entries) EXPECT_NEAR(entry.depth_delay_s, 0.01, 1e-9);
}

TEST(TumSequence, DepthTimesOfAnotherClockTellNoDelay) {
  const TempDir dir;
  const std::string list = dir.Write("list.txt", "1 a 0.95 b\n2 a 7002 b\n3 a 7003 b\n4 a 4 b\n");
  const Result<TumSequence> sequence = ReadTumSequence("", list);
  ASSERT_TRUE(sequence.ok());
  std::vector<double> delays_s;
  for (const RgbdEntry& entry : sequence->entries) delays_s.push_back(entry.depth_delay_s);
  EXPECT_THAT(delays_s, ElementsAre(testing::DoubleNear(-0.05, 1e-9), 0, 0, 0));
  EXPECT_THAT(sequence->warnings,
              ElementsAre(HasSubstr("list.txt: 2 depth images are more than 0.1 s away")));
}

TEST(TumSequence, BadLinesAreSkippedCountedAndTold) {
  const TempDir dir;
  const std::string list = dir.Write("list.txt",
                                     "1 a 1 b\n"
                                     "2 a 2\n"
                                     "3 a 3 b c\n"
                                     "nan a 1 b\n"
                                     "4 a inf b\n"
                                     "5s a 5 b\n"
                                     "0.5 a 1 b\n"
                                     "1.0 a 1 b\n"
                                     "6 a 6 b\n");
  const Result<TumSequence> sequence = ReadTumSequence("", list);
  ASSERT_TRUE(sequence.ok());
  EXPECT_EQ(sequence->entries.size(), 2u);
  EXPECT_THAT(sequence->warnings,
              ElementsAre(AllOf(HasSubstr("list.txt:2: expected 4 fields"), HasSubstr("2 such lines")),
                          AllOf(HasSubstr("list.txt:4: the time is not a finite"), HasSubstr("3 such lines")),
                          AllOf(HasSubstr("list.txt:7: the time is not after"), HasSubstr("2 such lines"))));
}

TEST(TumSequence, PairsTheTwoListsWhenThereAreNoAssociations) {
  const TempDir dir;
  dir.Write("rgb.txt", "# rgb\n1.00 rgb/1\n1.03 rgb/2\n1.06 rgb/3\n9 rgb/4\n");
  dir.Write("depth.txt", "1.025 depth/1\n1.05 depth/2\n1.079 depth/3\nx\n");
  const Result<TumSequence> sequence = ReadTumSequence(dir.Path(""));
  ASSERT_TRUE(sequence.ok());
  ASSERT_EQ(sequence->entries.size(), 2u);
  EXPECT_EQ(sequence->entries[0].timestamp_text, "1.03");
  EXPECT_EQ(sequence->entries[0].depth_path, dir.Path("depth/1"));
  EXPECT_EQ(sequence->entries[1].depth_path, dir.Path("depth/2"));
  EXPECT_NEAR(sequence->entries[0].depth_delay_s, -0.005, 1e-9);
  EXPECT_NEAR(sequence->entries[1].depth_delay_s, -0.01, 1e-9);
  EXPECT_THAT(sequence->warnings, ElementsAre(HasSubstr("depth.txt:4: expected 2 fields")));
}

TEST(TumSequence, WhatCannotBeReadIsNamed) {
  const TempDir dir;
  const auto error_of = [](const std::string& folder, const std::string& list = {}) {
    return ReadTumSequence(folder, list).error().message;
  };
  EXPECT_THAT(error_of("", dir.Path("none.txt")), AllOf(HasSubstr("none.txt"), HasSubstr("No such file")));
  EXPECT_THAT(error_of("", dir.Path("")), HasSubstr("Is a directory"));
  EXPECT_THAT(error_of("", dir.Write("empty.txt", "# nothing\n\n")), HasSubstr("empty.txt: no line"));
  EXPECT_THAT(error_of("", dir.Write("bad.txt", "what is this\n")),
              HasSubstr("bad.txt:1: expected 4 fields"));
  EXPECT_THAT(error_of(dir.Path("")), HasSubstr("rgb.txt: cannot open"));
  dir.Write("rgb.txt", "1 a\n");
  EXPECT_THAT(error_of(dir.Path("")), HasSubstr("depth.txt: cannot open"));
  dir.Write("depth.txt", "1.5 a\n");
  EXPECT_THAT(error_of(dir.Path("")), HasSubstr("no time in rgb.txt is within 0.02 s"));
}

/// Picks the closest pair of unused indices again and again.
std::vector<std::pair<int, int>> AssociateByLookingAtAllPairs(std::vector<double> a, std::vector<double> b,
                                                              double max_difference_s) {
  constexpr double kUsed = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::pair<int, int>> pairs;
  while (true) {
    double best = max_difference_s;
    std::pair<int, int> pair{-1, -1};
    for (size_t i = 0; i < a.size(); ++i) {
      for (size_t j = 0; j < b.size(); ++j) {
        if (std::abs(a[i] - b[j]) < best) {
          best = std::abs(a[i] - b[j]);
          pair = {static_cast<int>(i), static_cast<int>(j)};
        }
      }
    }
    if (pair.first < 0) break;
    a[pair.first] = b[pair.second] = kUsed;
    pairs.push_back(pair);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(AssociateByTime, IsWhatGreedySearchOverAllPairsFinds) {
  for (int seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    const auto times = [&] {
      std::vector<double> times_s;
      for (double t = 1305031102; times_s.size() < 40;) times_s.push_back(t += rng.Uniform(0.001, 0.05));
      return times_s;
    };
    const std::vector<double> a = times(), b = times();
    EXPECT_EQ(AssociateByTime(a, b, 0.02), AssociateByLookingAtAllPairs(a, b, 0.02));
  }
}

}  // namespace
}  // namespace orbslam
