// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/orb_extractor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/features2d.hpp>
#include <set>
#include <tuple>

#include "orbslam/features/scale_pyramid.h"
#include "quad_tree.h"
#include "test_images.h"

namespace orbslam {
namespace {

size_t CoveredCells(const std::vector<cv::Point2f>& pixels) {
  std::set<std::pair<int, int>> cells;
  for (const auto& p : pixels) cells.emplace(static_cast<int>(p.x) / 32, static_cast<int>(p.y) / 32);
  return cells.size();
}

std::vector<cv::Point2f> Pixels(const OrbFeatures& features) {
  std::vector<cv::Point2f> pixels;
  for (const auto& k : features.keypoints) pixels.emplace_back(k.u, k.v);
  return pixels;
}

TEST(OrbExtractor, FindsAboutAsManyAsWantedSharedOutByScale) {
  for (const int wanted : {0, 1, 300, 1000, 2000}) {
    OrbExtractor extractor({.num_features = wanted});
    const OrbFeatures features = extractor.Extract(ShapesImage({640, 480}, 1));
    EXPECT_EQ(features.keypoints.size(), features.descriptors.size());
    EXPECT_NEAR(static_cast<double>(features.keypoints.size()), wanted, 0.02 * wanted + 24);
    if (wanted < 300) continue;
    std::vector<double> of_level(8, 0);
    for (const auto& k : features.keypoints) ++of_level[k.level];
    for (int level = 1; level < 8; ++level) EXPECT_NEAR(of_level[level - 1] / of_level[level], 1.2, 0.15);
  }
}

TEST(OrbExtractor, CoversTheImageFarBetterThanTheStrongestCorners) {
  cv::Mat image = ShapesImage({640, 480}, 2, {0, 0, 640, 480});
  cv::Mat faint = image(cv::Rect(200, 0, 440, 480));  // strong texture on the left, faint elsewhere
  faint = faint / 6 + 100;
  std::vector<cv::KeyPoint> strongest;
  cv::ORB::create(1000)->detect(image, strongest);
  std::vector<cv::Point2f> strongest_pixels;
  cv::KeyPoint::convert(strongest, strongest_pixels);
  OrbExtractor extractor({});
  EXPECT_GT(2 * CoveredCells(Pixels(extractor.Extract(image))), 3 * CoveredCells(strongest_pixels));
}

TEST(OrbExtractor, KeepsAwayFromTheBorderAndKeypointsAreDistinct) {
  OrbExtractor extractor({});
  const ScalePyramid scales(8, 1.2);
  std::set<std::tuple<int, float, float>> seen;
  int level = 0;
  for (const auto& k : extractor.Extract(ShapesImage({333, 251}, 3)).keypoints) {
    const double scale = scales.Scale(k.level);
    const cv::Point2d pixel = LevelPixel(k, {333, 251}, scale);
    EXPECT_GE(std::min(pixel.x, pixel.y), 18.5);
    EXPECT_LE(pixel.x, std::round(333 / scale) - 19.5);
    EXPECT_LE(pixel.y, std::round(251 / scale) - 19.5);
    EXPECT_TRUE(k.angle_deg >= 0 && k.angle_deg < 360);
    EXPECT_GE(k.level, level);
    level = k.level;
    EXPECT_TRUE(seen.emplace(k.level, k.u, k.v).second);
  }
  EXPECT_GT(seen.size(), 500u);
}

TEST(OrbExtractor, AnySizeIsHandled) {
  OrbExtractor extractor({});
  for (const cv::Size size : {cv::Size(0, 0), cv::Size(1, 1), cv::Size(38, 38), cv::Size(16, 1000)}) {
    EXPECT_TRUE(extractor.Extract(NoiseImage(size, 4)).keypoints.empty());
  }
  for (const cv::Size size : {cv::Size(39, 39), cv::Size(40, 40), cv::Size(1000, 41), cv::Size(41, 1000),
                              cv::Size(97, 61), cv::Size(1301, 777)}) {
    const OrbFeatures features = extractor.Extract(NoiseImage(size, 4));
    EXPECT_EQ(features.keypoints.size(), features.descriptors.size());
    for (const auto& k : features.keypoints) {
      EXPECT_TRUE(cv::Rect(cv::Point(), size).contains({static_cast<int>(k.u), static_cast<int>(k.v)}));
    }
  }
}

TEST(OrbExtractor, PlainImagesHaveNoFeatures) {
  OrbExtractor extractor({});
  for (const int grey : {0, 128, 255}) {
    EXPECT_TRUE(extractor.Extract(cv::Mat(480, 640, CV_8UC1, cv::Scalar(grey))).keypoints.empty());
  }
}

TEST(OrbExtractor, WhatIsMaskedTakesNoKeypointFromTheRest) {
  const cv::Size size(640, 480);
  cv::Mat mask(size, CV_8UC1, cv::Scalar(255));
  const cv::Rect open(400, 100, 200, 300);
  mask(open) = 0;
  OrbExtractor extractor({.num_features = 300});
  extractor.FindCorners(ShapesImage(size, 10));
  const OrbFeatures all = extractor.Describe({}), off_mask = extractor.Describe(mask);
  EXPECT_EQ(all.num_dropped, 0);
  EXPECT_NEAR(static_cast<double>(off_mask.keypoints.size()), 300, 30);
  EXPECT_EQ(off_mask.descriptors.size(), off_mask.keypoints.size());
  for (const auto& k : off_mask.keypoints) {
    const double half_pixel = 0.5 * std::pow(1.2, k.level) + 0.5;  // of its level, and of the mask
    EXPECT_TRUE(k.u > open.x - half_pixel && k.u < open.br().x - 1 + half_pixel) << k.u;
    EXPECT_TRUE(k.v > open.y - half_pixel && k.v < open.br().y - 1 + half_pixel) << k.v;
  }
}

TEST(OrbExtractor, EveryCornerIsDroppedByTheMaskOrByItsComplement) {
  const cv::Size size(320, 240);
  cv::Mat left(size, CV_8UC1, cv::Scalar(0));
  left(cv::Rect(0, 0, 150, 240)) = 1;
  const cv::Mat whole(size, CV_8UC1, cv::Scalar(1)), right = whole - left;
  OrbExtractor extractor({});
  extractor.FindCorners(ShapesImage(size, 11));
  EXPECT_GT(extractor.Describe(left).num_dropped, 0);
  EXPECT_GT(extractor.Describe(right).num_dropped, 0);
  EXPECT_EQ(extractor.Describe(left).num_dropped + extractor.Describe(right).num_dropped,
            extractor.Describe(whole).num_dropped);
  EXPECT_TRUE(extractor.Describe(whole).keypoints.empty());
}

TEST(OrbExtractor, RepeatsItself) {
  const auto as_tuple = [](const OrbKeypoint& k) {
    return std::tie(k.u, k.v, k.angle_deg, k.response, k.level);
  };
  OrbExtractor used({}), fresh({});
  const cv::Mat image = ShapesImage({640, 480}, 5);
  used.Extract(ShapesImage({320, 240}, 6));
  // The same pixels as a part of a larger image.
  cv::Mat larger = NoiseImage({800, 600}, 7);
  image.copyTo(larger(cv::Rect(50, 60, 640, 480)));
  const OrbFeatures a = used.Extract(image), b = fresh.Extract(larger(cv::Rect(50, 60, 640, 480)));
  ASSERT_EQ(a.keypoints.size(), b.keypoints.size());
  for (size_t i = 0; i < a.keypoints.size(); ++i)
    EXPECT_EQ(as_tuple(a.keypoints[i]), as_tuple(b.keypoints[i]));
  EXPECT_EQ(a.descriptors, b.descriptors);
}

TEST(OrbExtractor, AQuarterTurnKeepsMostFeatures) {
  const cv::Mat image = ShapesImage({480, 480}, 8);
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
  OrbExtractor extractor({});
  const OrbFeatures a = extractor.Extract(image), b = extractor.Extract(turned);
  int matched = 0;
  for (size_t i = 0; i < a.keypoints.size(); ++i) {
    const auto nearest = FindNearestTwo(a.descriptors[i], b.descriptors);
    const OrbKeypoint& k = b.keypoints[nearest.index];
    const double distance_px = std::hypot(k.u - (479 - a.keypoints[i].v), k.v - a.keypoints[i].u);
    matched += nearest.distance < 50 && distance_px < 5;
  }
  EXPECT_GT(matched, 0.7 * static_cast<double>(a.keypoints.size()));
}

TEST(QuadTree, LeavesAreTheStrongestOfTheirSurroundings) {
  Rng rng(9);
  for (const cv::Rect area : {cv::Rect(19, 19, 600, 440), cv::Rect(5, 5, 30, 900), cv::Rect(19, 19, 1, 1)}) {
    std::vector<Corner> corners;
    std::set<std::pair<int, int>> taken;
    for (int i = 0; i < 2000; ++i) {
      const Corner corner{static_cast<int16_t>(area.x + rng.Below(area.width)),
                          static_cast<int16_t>(area.y + rng.Below(area.height)),
                          static_cast<int>(rng.Below(200))};
      if (taken.emplace(corner.x, corner.y).second) corners.push_back(corner);
    }
    const int best = std::max_element(corners.begin(), corners.end(), [](auto& a, auto& b) {
                       return a.score < b.score;
                     })->score;
    const int available = static_cast<int>(corners.size());
    for (const int wanted : {0, 1, 10, 217, 5000}) {
      const auto chosen = SpreadByQuadTree(corners, area, wanted);
      const int count = static_cast<int>(chosen.size());
      EXPECT_GE(count, std::min(wanted, available));
      const int roots = std::max(area.width, area.height) / std::min(area.width, area.height) + 1;
      EXPECT_LE(count, wanted == 0 ? 0 : std::min(std::max(wanted + 3, roots), available));
      for (const Corner& c : chosen) EXPECT_TRUE(taken.contains({c.x, c.y}));
      if (wanted > 0) {
        EXPECT_TRUE(
            std::any_of(chosen.begin(), chosen.end(), [&](const Corner& c) { return c.score == best; }));
      }
    }
  }
}

}  // namespace
}  // namespace orbslam
