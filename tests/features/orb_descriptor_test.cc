// SPDX-License-Identifier: GPL-3.0-or-later
// Our features, handed to OpenCV's ORB for description, must get the same bits on every level.
#include <gtest/gtest.h>

#include <cstring>
#include <opencv2/features2d.hpp>

#include "orbslam/features/orb_extractor.h"
#include "orientation.h"
#include "steered_brief.h"
#include "test_images.h"

namespace orbslam {
namespace {

constexpr int kEdgePx = 19, kFastThreshold = 20;

// As the float that OpenCV takes it for, so that both pyramids have the same scales.
constexpr double kScaleFactor = 1.2f;

/// OpenCV scales a level's pixels by the nominal factor and maps corners, not centres: the same pixel of the
/// level has other coordinates there.
std::vector<cv::KeyPoint> ToOpenCv(const std::vector<OrbKeypoint>& keypoints, cv::Size image) {
  std::vector<cv::KeyPoint> converted;
  for (size_t i = 0; i < keypoints.size(); ++i) {
    const auto& k = keypoints[i];
    // class_id remembers which it was: OpenCV may drop and reorder.
    const double scale = std::pow(kScaleFactor, k.level);
    const cv::Point2f pixel = LevelPixel(k, image, scale) * scale;
    converted.emplace_back(pixel.x, pixel.y, 31.0f, k.angle_deg, k.response, k.level, static_cast<int>(i));
  }
  return converted;
}

class OrbDescriptor : public ::testing::TestWithParam<uint64_t> {};

TEST_P(OrbDescriptor, EqualsOpenCvsOnEveryLevel) {
  const cv::Mat image = ShapesImage({640, 480}, GetParam());
  OrbExtractor extractor({.scale_factor = kScaleFactor});
  const OrbFeatures ours = extractor.Extract(image);
  auto keypoints = ToOpenCv(ours.keypoints, image.size());
  cv::Mat theirs;
  cv::ORB::create(1000, static_cast<float>(kScaleFactor), 8, kEdgePx, 0, 2, cv::ORB::FAST_SCORE, 31,
                  kFastThreshold)
      ->compute(image, keypoints, theirs);
  EXPECT_EQ(keypoints.size(), ours.keypoints.size());
  std::vector<int> of_level(8, 0);
  for (int row = 0; row < theirs.rows; ++row) {
    const Descriptor& descriptor = ours.descriptors[keypoints[row].class_id];
    EXPECT_EQ(std::memcmp(descriptor.words.data(), theirs.ptr(row), 32), 0)
        << "level " << keypoints[row].octave;
    ++of_level[keypoints[row].octave];
  }
  for (const int count : of_level) EXPECT_GT(count, 30);
}

INSTANTIATE_TEST_SUITE_P(Seeds, OrbDescriptor, ::testing::Values(1, 2, 3));

TEST(OrbDescriptor, OrientationEqualsOpenCvs) {
  const cv::Mat image = ShapesImage({640, 480}, 4);
  std::vector<cv::KeyPoint> keypoints;
  cv::ORB::create(2000, 1.2f, 1, 31, 0, 2, cv::ORB::FAST_SCORE)->detect(image, keypoints);
  ASSERT_GT(keypoints.size(), 500u);
  for (const auto& keypoint : keypoints) {
    const auto* pixel = image.ptr(static_cast<int>(keypoint.pt.y)) + static_cast<int>(keypoint.pt.x);
    EXPECT_FLOAT_EQ(CentroidAngleDeg(pixel, static_cast<ptrdiff_t>(image.step)), keypoint.angle);
  }
}

TEST(OrbDescriptor, TurnsWithTheImage) {
  const cv::Mat image = ShapesImage({65, 65}, 5);
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
  const auto angle = [](const cv::Mat& m) {
    return CentroidAngleDeg(m.ptr(32) + 32, static_cast<ptrdiff_t>(m.step));
  };
  EXPECT_NEAR(std::remainder(angle(turned) - angle(image) - 90.0f, 360.0f), 0.0f, 0.1f);
}

}  // namespace
}  // namespace orbslam
