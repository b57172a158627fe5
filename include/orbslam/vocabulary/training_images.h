// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "orbslam/features/orb_extractor.h"
#include "orbslam/util/result.h"

namespace orbslam {

struct TileOptions {
  int width = 640, height = 480;  // of a tile, px
  int max_image_side = 2560;      // px; larger photographs are soft at full size and are shrunk to this first
  double scale_step =
      1.5;  // then by this from one scale to the next, down to where one tile holds the picture
  int min_image_side = 240;  // px; smaller pictures give no tile
};

/// Cuts a picture (CV_8UC1) into tiles without overlap, centred, at several scales. A picture smaller than a
/// tile in either direction is one tile of its own size.
std::vector<cv::Mat> CutTiles(const cv::Mat& gray, const TileOptions& options);

struct TrainingImageOptions {
  TileOptions tiles;
  OrbExtractorOptions extractor;
  int min_features = 200;  // tiles with fewer (sky, walls) say little and are left out
  int num_threads = 1;     // the result does not depend on it
};

struct TrainingImages {
  std::vector<std::vector<Descriptor>> descriptors;  // one entry a tile, in the order of the files
  std::vector<std::string> unreadable;               // why files were left out
};

/// Reads pictures (with `read`: CV_8UC1 or why not), cuts tiles and describes them. on_file is called after
/// each file with the number of files done so far, by one thread at a time; may be empty.
TrainingImages DescribeTrainingImages(std::span<const std::string> files,
                                      const std::function<Result<cv::Mat>(const std::string&)>& read,
                                      const TrainingImageOptions& options,
                                      const std::function<void(size_t files_done)>& on_file);

}  // namespace orbslam
