// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "orbslam/features/descriptor.h"

namespace orbslam {

/// A corner in a raw (distorted) image.
struct OrbKeypoint {
  float u = 0, v = 0;   // px, in the full-size image: the peak of the FAST score, finer than a pixel
  float angle_deg = 0;  // of the intensity centroid, in [0, 360)
  float response = 0;   // FAST score
  int level = 0;        // of the pyramid; its scale is scale_factor^level
};

struct OrbFeatures {
  std::vector<OrbKeypoint> keypoints;
  std::vector<Descriptor> descriptors;  // one a keypoint
  int num_dropped = 0;                  // corners that a mask covers
};

struct OrbExtractorOptions {
  int num_features = 1000;     // ORBextractor.nFeatures: wanted over all levels
  double scale_factor = 1.2;   // ORBextractor.scaleFactor: between levels
  int num_levels = 8;          // ORBextractor.nLevels
  int fast_threshold = 20;     // ORBextractor.iniThFAST, grey levels
  int min_fast_threshold = 7;  // ORBextractor.minThFAST: in cells where the first finds nothing
};

/// ORB of ORB-SLAM's kind: FAST corners found cell by cell on an image pyramid, spread over the image by a
/// quad-tree, oriented by the intensity centroid, described by steered BRIEF. Not thread-safe: keeps buffers.
class OrbExtractor {
 public:
  explicit OrbExtractor(const OrbExtractorOptions& options);
  ~OrbExtractor();

  /// image: CV_8UC1. Keypoints come in ascending level. A small or featureless image gives few or none.
  OrbFeatures Extract(const cv::Mat& image);

  /// The same in two steps, for a mask that comes later than the image. All corners of image (CV_8UC1, not
  /// copied: it must stay as it is until the last Describe of it):
  void FindCorners(const cv::Mat& image);
  /// num_features of them, spread over what is off the mask (CV_8UC1 of the image's size, non-zero: no
  /// corner's pixel there; or empty), so that what is masked takes no keypoint from the rest.
  OrbFeatures Describe(const cv::Mat& mask);

  const OrbExtractorOptions& options() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace orbslam
