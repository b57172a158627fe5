// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/matching/epipolar_search.h"

#include <gmock/gmock.h>

#include <map>
#include <numeric>

#include "matching/random_features.h"
#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/geometry/triangulation.h"

namespace orbslam::test {
namespace {

std::vector<int> All(const FrameFeatures& features) {
  std::vector<int> all(features.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

class EpipolarSearch : public testing::TestWithParam<int> {
 protected:
  EpipolarSearch() {
    camera_.width = 640, camera_.height = 480;
    camera_.fx = 525, camera_.fy = 520, camera_.cx = 319.5, camera_.cy = 239.5;
    for (int i = 0; i < from_.size(); ++i) {  // every keypoint is a point that the other camera sees too
      from_.angles_deg[i] = 10;
      const cv::Point2f& pixel = from_.pixels[i];
      const Eigen::Vector3d x = camera_.Unproject(pixel.x, pixel.y, rng_.Uniform(1, 5));
      const Eigen::Vector2f seen = camera_.Project(to_from_from_ * x).cast<float>();
      to_.pixels[i] = {seen.x(), seen.y()};
      to_.descriptors[i] = WithNoise(from_.descriptors[i], 15, &rng_);
      to_.angles_deg[i] = 10;
    }
  }

  Eigen::Matrix3d Fundamental() const {
    Eigen::Matrix3d pixel_from_direction;
    pixel_from_direction << camera_.fx, 0, camera_.cx, 0, camera_.fy, camera_.cy, 0, 0, 1;
    const Eigen::Matrix3d inverse = pixel_from_direction.inverse();
    return inverse.transpose() * EssentialMatrix(to_from_from_) * inverse;
  }
  std::vector<int> Search() const {
    return SearchByEpipolarLine(from_, All(from_), to_, All(to_), Fundamental(), pyramid_);
  }
  /// Distance of keypoint j from the line of keypoint i, in standard deviations.
  double Sigmas(int i, int j) const {
    const Eigen::Vector3d line = Fundamental() * Eigen::Vector3d(from_.pixels[i].x, from_.pixels[i].y, 1);
    const double px = line.dot(Eigen::Vector3d(to_.pixels[j].x, to_.pixels[j].y, 1)) / line.head<2>().norm();
    return std::abs(px) / pyramid_.SigmaPx(to_.levels[j]);
  }
  /// Keypoint of `to` -> least distance of a keypoint of `from` that may claim it, by definition.
  std::map<int, int> BestClaims() const {
    std::map<int, int> claims;
    for (int i = 0; i < from_.size(); ++i) {
      std::pair<int, int> best{kStrictMaxDistance + 1, -1};
      for (int j = 0; j < to_.size(); ++j) {
        if (Sigmas(i, j) >= 1.96) continue;
        best = std::min(best, {HammingDistance(from_.descriptors[i], to_.descriptors[j]), j});
      }
      if (best.second < 0) continue;
      const auto it = claims.emplace(best.second, best.first).first;
      it->second = std::min(it->second, best.first);
    }
    return claims;
  }

  Rng rng_{static_cast<uint64_t>(GetParam())};
  PinholeCamera camera_;
  const ScalePyramid pyramid_{8, 1.2};
  const Rigid3d to_from_from_ = {So3Exp(0.1 * RandomDirection(&rng_)), 0.3 * RandomDirection(&rng_)};
  FrameFeatures from_ = RandomFeatures(300, &rng_), to_ = from_;
};

TEST_P(EpipolarSearch, FindsThePartners) {
  const std::vector<int> match = Search();
  int num_right = 0;
  for (int i = 0; i < from_.size(); ++i) num_right += match[i] == i;
  EXPECT_GT(num_right, 280);
}

TEST_P(EpipolarSearch, EqualsBruteForce) {
  for (cv::Point2f& pixel : to_.pixels) pixel.y += RandomFloat(&rng_, -5, 5);
  const std::vector<int> match = Search();
  std::map<int, int> found;
  for (int i = 0; i < from_.size(); ++i) {
    if (match[i] < 0) continue;
    const int distance = HammingDistance(from_.descriptors[i], to_.descriptors[match[i]]);
    EXPECT_TRUE(found.emplace(match[i], distance).second) << "keypoint " << match[i] << " was given twice";
  }
  EXPECT_EQ(found, BestClaims());
  EXPECT_GT(found.size(), 50u);
}

TEST_P(EpipolarSearch, KeypointThatTurnedAgainstTheRestIsDropped) {
  ASSERT_EQ(Search()[7], 7);
  to_.angles_deg[7] = 190;
  EXPECT_THAT(Search(), testing::Not(testing::Contains(7)));
}

TEST_P(EpipolarSearch, AnswersForThoseAskedAmongThoseOffered) {
  const std::vector<int> asked{20, 3, 11}, offered{3, 20};
  const std::vector<int> match = SearchByEpipolarLine(from_, asked, to_, offered, Fundamental(), pyramid_);
  EXPECT_THAT(match, testing::ElementsAre(20, 3, testing::Ne(11)));
  EXPECT_TRUE(SearchByEpipolarLine(from_, {}, to_, offered, Fundamental(), pyramid_).empty());
}

INSTANTIATE_TEST_SUITE_P(Seeds, EpipolarSearch, testing::Range(1, 4));

}  // namespace
}  // namespace orbslam::test
