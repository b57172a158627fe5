// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/orb_extractor.h"

#include <algorithm>
#include <cmath>

#include "orbslam/features/fast_corners.h"
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

struct Level {
  cv::Rect Area() const {
    return {kBorderPx, kBorderPx, image.cols - 2 * kBorderPx, image.rows - 2 * kBorderPx};
  }
  bool HasArea() const { return std::min(image.cols, image.rows) > 2 * kBorderPx; }

  int wanted = 0;  // features
  cv::Mat image;   // of the first level: the caller's
  Shrinker shrinker;
  Smoother smoother;
  cv::Mat smooth;
  std::vector<Corner> corners;
};

// Resizing maps centres of pixels: (x + 0.5) of a level is (x + 0.5) * its true scale in the image. cv::ORB
// and ORB-SLAM2 multiply x alone, which moves corners of the coarsest level by more than a pixel against the
// finest.
class ToFullSize {
 public:
  ToFullSize(const cv::Mat& full, const cv::Mat& level)
      : scale_u_(static_cast<float>(full.cols) / static_cast<float>(level.cols)),
        scale_v_(static_cast<float>(full.rows) / static_cast<float>(level.rows)) {}

  cv::Point2f operator()(const Corner& corner, cv::Point2f offset = {}) const {
    return {(static_cast<float>(corner.x) + offset.x + 0.5f) * scale_u_ - 0.5f,
            (static_cast<float>(corner.y) + offset.y + 0.5f) * scale_v_ - 0.5f};
  }

 private:
  float scale_u_, scale_v_;
};

bool IsSet(const cv::Mat& mask, const cv::Point2f& position) {
  return mask.at<uint8_t>(static_cast<int>(std::lround(position.y)),
                          static_cast<int>(std::lround(position.x))) != 0;
}

}  // namespace

struct OrbExtractor::Impl {
  explicit Impl(const OrbExtractorOptions& orb_options)
      : options(Checked(orb_options)),
        scales(options.num_levels, options.scale_factor),
        levels(options.num_levels),
        finder(options.fast_threshold, options.min_fast_threshold) {
    const std::vector<int> wanted = FeaturesPerLevel(options);
    for (int i = 0; i < options.num_levels; ++i) levels[i].wanted = wanted[i];
  }

  cv::Size LevelSize(const cv::Mat& image, int level) const;
  void DescribeLevel(int level, const cv::Mat& mask, OrbFeatures* features);

  OrbExtractorOptions options;
  ScalePyramid scales;
  std::vector<Level> levels;
  int num_levels = 0;  // those of the present image that are large enough
  FastCorners finder;
  std::vector<Corner> candidates;
};

cv::Size OrbExtractor::Impl::LevelSize(const cv::Mat& image, int level) const {
  const double scale = scales.Scale(level);
  return {static_cast<int>(std::lrint(image.cols / scale)), static_cast<int>(std::lrint(image.rows / scale))};
}

void OrbExtractor::Impl::DescribeLevel(int index, const cv::Mat& mask, OrbFeatures* features) {
  const Level& level = levels[index];
  const ToFullSize to_full_size(levels[0].image, level.image);
  candidates = level.corners;
  if (!mask.empty()) {
    std::erase_if(candidates, [&](const Corner& corner) { return IsSet(mask, to_full_size(corner)); });
    features->num_dropped += static_cast<int>(level.corners.size() - candidates.size());
  }
  for (const Corner& corner : SpreadByQuadTree(candidates, level.Area(), level.wanted)) {
    const float angle_deg =
        CentroidAngleDeg(level.image.ptr(corner.y) + corner.x, static_cast<ptrdiff_t>(level.image.step));
    const cv::Point2f position = to_full_size(corner, finder.PeakOffset(level.image, corner));
    features->keypoints.push_back(
        {position.x, position.y, angle_deg, static_cast<float>(corner.score), index});
    features->descriptors.push_back(DescribePixel(level.smooth.ptr(corner.y) + corner.x,
                                                  static_cast<ptrdiff_t>(level.smooth.step), angle_deg));
  }
}

OrbExtractor::OrbExtractor(const OrbExtractorOptions& options) : impl_(std::make_unique<Impl>(options)) {}

OrbExtractor::~OrbExtractor() = default;

const OrbExtractorOptions& OrbExtractor::options() const { return impl_->options; }

void OrbExtractor::FindCorners(const cv::Mat& image) {
  impl_->num_levels = 0;
  if (image.empty()) return;
  ORBSLAM_CHECK(image.type() == CV_8UC1);
  impl_->levels[0].image = image;
  for (int i = 0; i < impl_->options.num_levels; ++i) {
    Level& level = impl_->levels[i];
    if (i > 0) level.shrinker.Shrink(impl_->levels[i - 1].image, impl_->LevelSize(image, i), &level.image);
    if (!level.HasArea()) break;
    level.corners = impl_->finder.Detect(level.image, kBorderPx);
    level.smoother.Smooth(level.image, &level.smooth);
    ++impl_->num_levels;
  }
}

OrbFeatures OrbExtractor::Describe(const cv::Mat& mask) {
  OrbFeatures features;
  if (impl_->num_levels == 0) return features;
  ORBSLAM_CHECK(mask.empty() || (mask.type() == CV_8UC1 && mask.size() == impl_->levels[0].image.size()));
  features.keypoints.reserve(impl_->options.num_features + 3 * impl_->options.num_levels);
  features.descriptors.reserve(features.keypoints.capacity());
  for (int i = 0; i < impl_->num_levels; ++i) impl_->DescribeLevel(i, mask, &features);
  return features;
}

OrbFeatures OrbExtractor::Extract(const cv::Mat& image) {
  FindCorners(image);
  return Describe({});
}

}  // namespace orbslam
