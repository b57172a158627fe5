// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/vocabulary/training_images.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "parallel_for.h"

namespace orbslam {
namespace {

cv::Mat Shrink(const cv::Mat& image, double scale) {
  if (scale >= 1) return image;
  const cv::Size size(std::max(1, static_cast<int>(std::lround(image.cols * scale))),
                      std::max(1, static_cast<int>(std::lround(image.rows * scale))));
  cv::Mat smaller;
  cv::resize(image, smaller, size, 0, 0, cv::INTER_AREA);
  return smaller;
}

void AppendGrid(const cv::Mat& image, const TileOptions& options, std::vector<cv::Mat>* tiles) {
  const int columns = image.cols / options.width;
  const int rows = image.rows / options.height;
  const int left = (image.cols - columns * options.width) / 2;
  const int top = (image.rows - rows * options.height) / 2;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const cv::Rect where(left + column * options.width, top + row * options.height, options.width,
                           options.height);
      tiles->push_back(image(where).clone());
    }
  }
}

/// What one file yields.
struct FileTiles {
  std::vector<std::vector<Descriptor>> descriptors;
  std::optional<std::string> problem;
};

FileTiles DescribeFile(const Result<cv::Mat>& image, const TrainingImageOptions& options) {
  FileTiles file;
  if (!image) {
    file.problem = image.error().message;
    return file;
  }
  OrbExtractor extractor(options.extractor);
  for (const cv::Mat& tile : CutTiles(*image, options.tiles)) {
    OrbFeatures features = extractor.Extract(tile);
    if (static_cast<int>(features.descriptors.size()) < options.min_features) continue;
    file.descriptors.push_back(std::move(features.descriptors));
  }
  return file;
}

}  // namespace

std::vector<cv::Mat> CutTiles(const cv::Mat& gray, const TileOptions& options) {
  std::vector<cv::Mat> tiles;
  if (std::min(gray.cols, gray.rows) < options.min_image_side) return tiles;
  if (gray.cols < options.width || gray.rows < options.height) {
    tiles.push_back(
        Shrink(gray, static_cast<double>(options.max_image_side) / std::max(gray.cols, gray.rows)));
    return tiles;
  }
  const double one_tile = std::max(static_cast<double>(options.width) / gray.cols,
                                   static_cast<double>(options.height) / gray.rows);
  double scale = std::min(1.0, static_cast<double>(options.max_image_side) / std::max(gray.cols, gray.rows));
  for (; scale > one_tile; scale /= options.scale_step) AppendGrid(Shrink(gray, scale), options, &tiles);
  AppendGrid(Shrink(gray, one_tile), options, &tiles);
  return tiles;
}

TrainingImages DescribeTrainingImages(std::span<const std::string> files,
                                      const std::function<Result<cv::Mat>(const std::string&)>& read,
                                      const TrainingImageOptions& options,
                                      const std::function<void(size_t files_done)>& on_file) {
  std::vector<FileTiles> results(files.size());
  std::mutex report_mutex;
  size_t files_done = 0;
  ParallelFor(files.size(), options.num_threads, [&](size_t i) {
    results[i] = DescribeFile(read(files[i]), options);
    const std::lock_guard lock(report_mutex);
    ++files_done;
    if (on_file) on_file(files_done);
  });

  TrainingImages all;
  for (FileTiles& file : results) {
    std::ranges::move(file.descriptors, std::back_inserter(all.descriptors));
    if (file.problem) all.unreadable.push_back(*file.problem);
  }
  return all;
}

}  // namespace orbslam
