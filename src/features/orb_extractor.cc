// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/orb_extractor.h"

#include <algorithm>
#include <cmath>

#include "fast_corners.h"
#include "orbslam/features/scale_pyramid.h"
#include "orbslam/util/check.h"
#include "orientation.h"
#include "quad_tree.h"
#include "shrink.h"
#include "smooth.h"
#include "steered_brief.h"

namespace orbslam {
namespace {

constexpr int kBorderPx = std::max(kPatternReach, kPatchRadius + 1);

// A level's share falls with its side length, so that all levels together get num_features.
std::vector<int> FeaturesPerLevel(const OrbExtractorOptions& options) {
  const double ratio = 1.0 / options.scale_factor;
  double sum = 0;
  for (int level = 0; level < options.num_levels; ++level) sum += std::pow(ratio, level);
  std::vector<int> wanted;
  int rest = options.num_features;
  for (int level = 0; level < options.num_levels; ++level) {
    const double share = options.num_features * std::pow(ratio, level) / sum;
    wanted.push_back(std::min(rest, static_cast<int>(std::lround(share))));
    rest -= wanted.back();
  }
  wanted.back() += rest;
  return wanted;
}

const OrbExtractorOptions& Checked(const OrbExtractorOptions& options) {
  ORBSLAM_CHECK(options.num_levels >= 1 && options.scale_factor > 1.0 && options.num_features >= 0);
  return options;
}

}  // namespace

struct OrbExtractor::Impl {
  explicit Impl(const OrbExtractorOptions& orb_options)
      : options(Checked(orb_options)),
        scales(options.num_levels, options.scale_factor),
        wanted(FeaturesPerLevel(options)),
        images(options.num_levels),
        shrinkers(options.num_levels),
        corners(options.fast_threshold, options.min_fast_threshold) {}

  cv::Size LevelSize(int level) const;
  void ExtractLevel(int level, OrbFeatures* features);

  OrbExtractorOptions options;
  ScalePyramid scales;
  std::vector<int> wanted;          // features, by level
  std::vector<cv::Mat> images;      // by level; the first is the caller's
  std::vector<Shrinker> shrinkers;  // to each level, from the one before
  Smoother smoother;
  cv::Mat smooth;
  FastCorners corners;
  std::vector<Corner> candidates;
};

cv::Size OrbExtractor::Impl::LevelSize(int level) const {
  const double scale = scales.Scale(level);
  return {static_cast<int>(std::lrint(images[0].cols / scale)),
          static_cast<int>(std::lrint(images[0].rows / scale))};
}

void OrbExtractor::Impl::ExtractLevel(int level, OrbFeatures* features) {
  const cv::Mat& image = images[level];
  candidates = corners.Detect(image, kBorderPx);
  const cv::Rect area(kBorderPx, kBorderPx, image.cols - 2 * kBorderPx, image.rows - 2 * kBorderPx);
  const std::vector<Corner> chosen = SpreadByQuadTree(candidates, area, wanted[level]);
  if (chosen.empty()) return;
  smoother.Smooth(image, &smooth);
  // Resizing maps centres of pixels: (x + 0.5) of a level is (x + 0.5) * its true scale in the image. cv::ORB
  // and ORB-SLAM2 multiply x alone, which moves corners of the coarsest level by more than a pixel against
  // the finest.
  const float scale_u = static_cast<float>(images[0].cols) / static_cast<float>(image.cols);
  const float scale_v = static_cast<float>(images[0].rows) / static_cast<float>(image.rows);
  for (const Corner& corner : chosen) {
    const float angle_deg =
        CentroidAngleDeg(image.ptr(corner.y) + corner.x, static_cast<ptrdiff_t>(image.step));
    features->keypoints.push_back({(static_cast<float>(corner.x) + 0.5f) * scale_u - 0.5f,
                                   (static_cast<float>(corner.y) + 0.5f) * scale_v - 0.5f, angle_deg,
                                   static_cast<float>(corner.score), level});
    features->descriptors.push_back(
        DescribePixel(smooth.ptr(corner.y) + corner.x, static_cast<ptrdiff_t>(smooth.step), angle_deg));
  }
}

OrbExtractor::OrbExtractor(const OrbExtractorOptions& options) : impl_(std::make_unique<Impl>(options)) {}

OrbExtractor::~OrbExtractor() = default;

const OrbExtractorOptions& OrbExtractor::options() const { return impl_->options; }

OrbFeatures OrbExtractor::Extract(const cv::Mat& image) {
  OrbFeatures features;
  if (image.empty()) return features;
  ORBSLAM_CHECK(image.type() == CV_8UC1);
  features.keypoints.reserve(impl_->options.num_features + 3 * impl_->options.num_levels);
  features.descriptors.reserve(features.keypoints.capacity());
  impl_->images[0] = image;
  for (int level = 0; level < impl_->options.num_levels; ++level) {
    const cv::Size size = impl_->LevelSize(level);
    if (std::min(size.width, size.height) <= 2 * kBorderPx) break;
    if (level > 0) impl_->shrinkers[level].Shrink(impl_->images[level - 1], size, &impl_->images[level]);
    impl_->ExtractLevel(level, &features);
  }
  impl_->images[0].release();
  return features;
}

}  // namespace orbslam
