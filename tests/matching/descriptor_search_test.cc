// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/matching/descriptor_search.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <numeric>

#include "matching/random_features.h"

namespace orbslam::test {
namespace {

/// `from` again, in another order, with noise on the descriptors and the camera rolled; from_index: who is
/// who.
FrameFeatures SeenAgain(const FrameFeatures& from, float roll_deg, int noise_bits, Rng* rng,
                        std::vector<int>* from_index) {
  FrameFeatures to = from;
  from_index->resize(from.size());
  std::iota(from_index->begin(), from_index->end(), 0);
  for (int i = from.size() - 1; i > 0; --i) std::swap((*from_index)[i], (*from_index)[rng->Below(i + 1)]);
  for (int i = 0; i < to.size(); ++i) {
    to.descriptors[i] = WithNoise(from.descriptors[(*from_index)[i]], noise_bits, rng);
    to.angles_deg[i] = std::fmod(from.angles_deg[(*from_index)[i]] + roll_deg, 360.0f);
  }
  return to;
}

std::vector<int> All(const FrameFeatures& features) {
  std::vector<int> all(features.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

class DescriptorSearch : public testing::TestWithParam<int> {
 protected:
  Rng rng_{static_cast<uint64_t>(GetParam())};
  FrameFeatures from_ = RandomFeatures(300, &rng_);
  std::vector<int> from_index_;
};

TEST_P(DescriptorSearch, FindsWhatIsSeenAgainHoweverTheCameraRolls) {
  for (const float roll_deg : {6.0f, 90.0f, 186.0f, 354.0f}) {
    const FrameFeatures to = SeenAgain(from_, roll_deg, 8, &rng_, &from_index_);
    const std::vector<int> match = SearchByDescriptor(from_, All(from_), to, All(to), {});
    int num_found = 0;
    for (int i = 0; i < from_.size(); ++i) {
      if (match[i] < 0) continue;
      ++num_found;
      EXPECT_EQ(from_index_[match[i]], i);
    }
    EXPECT_GT(num_found, 250) << roll_deg;
  }
}

/// Keypoint of `to` -> least distance of a keypoint of `from` that may claim it, by definition.
std::map<int, int> BestClaims(const FrameFeatures& from, const FrameFeatures& to,
                              const std::vector<int>& to_indices, const DescriptorSearchOptions& options) {
  std::map<int, int> claims;
  for (const Descriptor& query : from.descriptors) {
    std::vector<std::pair<int, int>> ranked;
    for (const int i : to_indices) ranked.emplace_back(HammingDistance(query, to.descriptors[i]), i);
    std::ranges::stable_sort(ranked, {}, &std::pair<int, int>::first);
    if (ranked[0].first > options.max_distance || ranked[0].first > options.max_ratio * ranked[1].first)
      continue;
    const auto it = claims.emplace(ranked[0].second, ranked[0].first).first;
    it->second = std::min(it->second, ranked[0].first);
  }
  return claims;
}

TEST_P(DescriptorSearch, EqualsBruteForce) {
  const FrameFeatures to = SeenAgain(from_, 0, 40, &rng_, &from_index_);
  std::vector<int> to_indices;
  for (int i = 0; i < to.size(); i += 2) to_indices.push_back(i);
  for (const double max_ratio : {0.99, 0.8, 0.6}) {
    const DescriptorSearchOptions options{
        .max_distance = 90, .max_ratio = max_ratio, .check_orientation = false};
    const std::vector<int> match = SearchByDescriptor(from_, All(from_), to, to_indices, options);
    std::map<int, int> found;
    for (int i = 0; i < from_.size(); ++i) {
      if (match[i] < 0) continue;
      const int distance = HammingDistance(from_.descriptors[i], to.descriptors[match[i]]);
      EXPECT_TRUE(found.emplace(match[i], distance).second) << "keypoint " << match[i] << " was given twice";
    }
    EXPECT_GT(found.size(), 20u);
    EXPECT_EQ(found, BestClaims(from_, to, to_indices, options)) << "ratio " << max_ratio;
  }
}

TEST_P(DescriptorSearch, KeypointThatTurnedAgainstTheRestIsDropped) {
  FrameFeatures to = SeenAgain(from_, 30, 0, &rng_, &from_index_);
  to.angles_deg[7] = std::fmod(to.angles_deg[7] + 180, 360.0f);
  const std::vector<int> match = SearchByDescriptor(from_, All(from_), to, All(to), {});
  EXPECT_THAT(match, testing::Not(testing::Contains(7)));
  EXPECT_GT(std::ranges::count_if(match, [](int m) { return m >= 0; }), 290);
}

TEST_P(DescriptorSearch, AnswersInTheOrderOfTheQuestions) {
  const FrameFeatures to = SeenAgain(from_, 0, 0, &rng_, &from_index_);
  const std::vector<int> asked = {20, 3, 11};
  const std::vector<int> match = SearchByDescriptor(from_, asked, to, All(to), {});
  ASSERT_EQ(match.size(), asked.size());
  for (size_t q = 0; q < asked.size(); ++q) EXPECT_EQ(from_index_.at(match[q]), asked[q]);
}

INSTANTIATE_TEST_SUITE_P(Seeds, DescriptorSearch, testing::Range(1, 4));

}  // namespace
}  // namespace orbslam::test
