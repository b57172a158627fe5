// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/matching/projection_search.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "matching/random_features.h"

namespace orbslam::test {
namespace {

using testing::ElementsAre;

class ProjectionSearch : public testing::TestWithParam<int> {
 protected:
  std::vector<ProjectionQuery> RandomQueries(int count) {
    std::vector<ProjectionQuery> queries;
    for (int i = 0; i < count; ++i) {
      const auto& model = features_.descriptors[rng_.Below(static_cast<uint32_t>(features_.size()))];
      const int level = static_cast<int>(rng_.Below(8));
      const float u = RandomFloat(&rng_, 0, 640), right_u = rng_.Below(2) == 0 ? u - 25 : -1;
      queries.push_back({WithNoise(model, 30, &rng_), u, RandomFloat(&rng_, 0, 480), right_u,
                         RandomFloat(&rng_, 5, 60), level - 1, level + 1, RandomFloat(&rng_, 0, 360)});
    }
    return queries;
  }

  Rng rng_{static_cast<uint64_t>(GetParam())};
  FrameFeatures features_ = RandomFeatures(600, &rng_);
};

bool IsCandidate(const ProjectionQuery& q, const FrameFeatures& f, int i) {
  const bool both_right = q.right_u >= 0 && f.right_u[i] >= 0;
  return std::abs(f.pixels[i].x - q.u) < q.radius_px && std::abs(f.pixels[i].y - q.v) < q.radius_px &&
         f.levels[i] >= q.min_level && f.levels[i] <= q.max_level &&
         (!both_right || std::abs(f.right_u[i] - q.right_u) <= q.radius_px);
}

/// (distance, keypoint) of every candidate, best first.
std::vector<std::pair<int, int>> RankedCandidates(const ProjectionQuery& q, const FrameFeatures& f,
                                                  const std::vector<char>& is_taken) {
  std::vector<std::pair<int, int>> ranked;
  for (int i = 0; i < f.size(); ++i) {
    if (is_taken[i] == 0 && IsCandidate(q, f, i))
      ranked.emplace_back(HammingDistance(q.descriptor, f.descriptors[i]), i);
  }
  std::ranges::sort(ranked);
  return ranked;
}

/// Least distance at which anybody may claim each keypoint, by the definition of the search.
std::map<int, int> BestClaims(const std::vector<ProjectionQuery>& queries, const FrameFeatures& f,
                              const std::vector<char>& is_taken, const ProjectionSearchOptions& options) {
  std::map<int, int> claims;
  for (const ProjectionQuery& q : queries) {
    const auto ranked = RankedCandidates(q, f, is_taken);
    if (ranked.empty() || ranked[0].first > options.max_distance) continue;
    const bool has_rival = ranked.size() > 1 && f.levels[ranked[0].second] == f.levels[ranked[1].second];
    if (has_rival && ranked[0].first > options.max_ratio * ranked[1].first) continue;
    const auto [it, is_new] = claims.emplace(ranked[0].second, ranked[0].first);
    it->second = std::min(it->second, ranked[0].first);
  }
  return claims;
}

/// Whether equal distances make it a matter of order which candidate is the best or its rival.
bool HasTie(const std::vector<std::pair<int, int>>& ranked) {
  for (size_t i = 0; i + 1 < std::min<size_t>(ranked.size(), 3); ++i) {
    if (ranked[i].first == ranked[i + 1].first) return true;
  }
  return false;
}

TEST_P(ProjectionSearch, EqualsBruteForce) {
  std::vector<char> is_taken(features_.size());
  for (char& taken : is_taken) taken = rng_.Below(5) == 0;
  auto queries = RandomQueries(400);
  std::erase_if(queries,
                [&](const ProjectionQuery& q) { return HasTie(RankedCandidates(q, features_, is_taken)); });
  for (const double max_ratio : {1.0, 0.9, 0.7}) {
    const ProjectionSearchOptions options{.max_ratio = max_ratio};
    const std::vector<int> match = SearchByProjection(queries, features_, is_taken, options);
    std::map<int, int> found;
    for (size_t q = 0; q < queries.size(); ++q) {
      if (match[q] < 0) continue;
      EXPECT_TRUE(IsCandidate(queries[q], features_, match[q]));
      const int distance = HammingDistance(queries[q].descriptor, features_.descriptors[match[q]]);
      EXPECT_TRUE(found.emplace(match[q], distance).second) << "keypoint " << match[q] << " was given twice";
    }
    EXPECT_GT(found.size(), 50u);
    EXPECT_EQ(found, BestClaims(queries, features_, is_taken, options)) << "ratio " << max_ratio;
  }
}

TEST_P(ProjectionSearch, RollingTheCameraChangesNoMatch) {
  auto queries = RandomQueries(300);
  const ProjectionSearchOptions options{.check_orientation = true};
  const auto unchecked = SearchByProjection(queries, features_, {}, ProjectionSearchOptions());
  for (size_t q = 0; q < queries.size(); ++q) {  // two thirds agree, in the middle of a bin
    if (unchecked[q] >= 0 && q % 3 != 0)
      queries[q].angle_deg = std::fmod(features_.angles_deg[unchecked[q]] + 354, 360.0f);
  }
  const std::vector<int> match = SearchByProjection(queries, features_, {}, options);
  EXPECT_NE(match, unchecked) << "some disagree";
  for (ProjectionQuery& query : queries) query.angle_deg = std::fmod(query.angle_deg + 24, 360.0f);
  for (float& angle : features_.angles_deg) angle = std::fmod(angle + 24, 360.0f);
  EXPECT_EQ(SearchByProjection(queries, features_, {}, options), match);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ProjectionSearch, testing::Range(1, 5));

/// One keypoint and one query that finds it, unless a test spoils it.
class ProjectionGate : public testing::Test {
 protected:
  ProjectionGate() {
    features_.pixels = {{320, 240}};
    features_.angles_deg = {0};
    features_.levels = {3};
    features_.descriptors = {query_.descriptor};
    features_.depths_m = {2};
    features_.right_u = {300};
    features_.grid = FeatureGrid(features_.pixels, kImage);
  }
  std::vector<int> Search(const std::vector<ProjectionQuery>& queries,
                          const std::vector<char>& is_taken = {}) {
    return SearchByProjection(queries, features_, is_taken, options_);
  }
  int Find(const ProjectionQuery& query) { return Search({query})[0]; }

  Rng rng_{5};
  ProjectionSearchOptions options_;
  ProjectionQuery query_{RandomDescriptor(&rng_), 322, 238, 302, 5, 2, 4, -1};
  FrameFeatures features_;
};

TEST_F(ProjectionGate, FindsTheKeypoint) { EXPECT_EQ(Find(query_), 0); }

TEST_F(ProjectionGate, LevelWindowIsInclusive) {
  const auto at_levels = [&](int min, int max) {
    query_.min_level = min, query_.max_level = max;
    return Find(query_);
  };
  EXPECT_EQ(at_levels(3, 3), 0);
  EXPECT_EQ(at_levels(0, 2), -1);
  EXPECT_EQ(at_levels(4, 7), -1);
}

TEST_F(ProjectionGate, RightColumnMustAgreeIfBothHaveOne) {
  query_.right_u = 310;
  EXPECT_EQ(Find(query_), -1);
  query_.right_u = -1;
  EXPECT_EQ(Find(query_), 0);
  query_.right_u = 310;
  features_.right_u[0] = -1;
  EXPECT_EQ(Find(query_), 0);
}

TEST_F(ProjectionGate, DescriptorDistanceIsInclusive) {
  query_.descriptor.words[0] ^= 0xFF;  // 8 bits
  options_.max_distance = 8;
  EXPECT_EQ(Find(query_), 0);
  options_.max_distance = 7;
  EXPECT_EQ(Find(query_), -1);
}

TEST_F(ProjectionGate, TakenKeypointGoesToNobody) { EXPECT_THAT(Search({query_}, {1}), ElementsAre(-1)); }

TEST_F(ProjectionGate, NearestQueryWinsInAnyOrder) {
  ProjectionQuery worse = query_;
  worse.descriptor.words[0] ^= 1;
  EXPECT_THAT(Search({query_, worse}), ElementsAre(0, -1));
  EXPECT_THAT(Search({worse, query_}), ElementsAre(-1, 0));
}

TEST_F(ProjectionGate, NothingToFindNothingFound) {
  EXPECT_TRUE(Search({}).empty());
  features_ = FrameFeatures();
  EXPECT_EQ(Find(query_), -1);
}

}  // namespace
}  // namespace orbslam::test
