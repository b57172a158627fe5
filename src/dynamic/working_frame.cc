// SPDX-License-Identifier: GPL-3.0-or-later
#include "working_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>
#include <opencv2/imgproc.hpp>

#include "corner_flow.h"
#include "normals.h"
#include "orbslam/util/check.h"

namespace orbslam {
namespace {

GridCamera Reduced(const PinholeCamera& camera, int step) {
  const double s = step, shift = (s - 1) / 2;  // from the centre of a block's first pixel to the block's
  return {camera.width / step,
          camera.height / step,
          static_cast<float>(camera.fx / s),
          static_cast<float>(camera.fy / s),
          static_cast<float>((camera.cx - shift) / s),
          static_cast<float>((camera.cy - shift) / s)};
}

Eigen::Vector2d RawPixel(const PinholeCamera& camera, int step, int u, int v) {
  const double shift = (step - 1) / 2.0;
  return camera.Distort({u * step + shift, v * step + shift});
}

constexpr float kNone = 1e9f;  // metres, lowest of no depth at all

/// What there is to say of the measured pixels of a block.
struct BlockSums {
  float sum_m = 0, lowest_m = kNone, highest_m = 0;
  int count = 0;
};

/// Four columns at a time; the loop over the rest is for steps of 2 and 6.
BlockSums SumBlock(const float* corner, size_t stride, int step) {
  cv::v_float32x4 sum = cv::v_setzero_f32(), lowest = cv::v_setall_f32(kNone), highest = sum, count = sum;
  BlockSums all;
  for (int y = 0; y < step; ++y) {
    const float* row = corner + y * stride;
    int x = 0;
    for (; x + 4 <= step; x += 4) {
      const cv::v_float32x4 z = cv::v_load(row + x), is_measured = z > cv::v_setzero_f32();
      const cv::v_float32x4 measured = z & is_measured;
      sum += measured;
      count += cv::v_setall_f32(1) & is_measured;
      highest = cv::v_max(highest, measured);
      lowest = cv::v_min(lowest, cv::v_select(is_measured, z, cv::v_setall_f32(kNone)));
    }
    for (; x < step; ++x) {
      if (!(row[x] > 0)) continue;
      all.sum_m += row[x], ++all.count;
      all.lowest_m = std::min(all.lowest_m, row[x]), all.highest_m = std::max(all.highest_m, row[x]);
    }
  }
  all.sum_m += cv::v_reduce_sum(sum), all.count += static_cast<int>(cv::v_reduce_sum(count));
  all.lowest_m = std::min(all.lowest_m, cv::v_reduce_min(lowest));
  all.highest_m = std::max(all.highest_m, cv::v_reduce_max(highest));
  return all;
}

constexpr int kBlocks = 4;  // that are looked at together

/// The mean of each block of 4 x 4 pixels that are all measured and on one surface, as most are; else 0, or
/// NaN if one of them is.
void MeansOfSurfaces(const std::array<const float*, kBlocks>& corners, size_t stride, float* means_m) {
  std::array<cv::v_float32x4, kBlocks> sum, lowest, highest;  // of a block, by columns
  for (int i = 0; i < kBlocks; ++i) {
    const float* corner = corners[i];
    const cv::v_float32x4 a = cv::v_load(corner), b = cv::v_load(corner + stride),
                          c = cv::v_load(corner + 2 * stride), d = cv::v_load(corner + 3 * stride);
    sum[i] = a + b + c + d;
    lowest[i] = cv::v_min(cv::v_min(a, b), cv::v_min(c, d));
    highest[i] = cv::v_max(cv::v_max(a, b), cv::v_max(c, d));
  }
  const auto of_blocks = [](const std::array<cv::v_float32x4, kBlocks>& x, const auto& join) {
    cv::v_float32x4 a, b, c, d;
    cv::v_transpose4x4(x[0], x[1], x[2], x[3], a, b, c, d);
    return join(join(a, c), join(b, d));
  };
  const cv::v_float32x4 sum_m = of_blocks(sum, [](const auto& a, const auto& b) { return a + b; });
  const cv::v_float32x4 lowest_m =
      of_blocks(lowest, [](const auto& a, const auto& b) { return cv::v_min(a, b); });
  const cv::v_float32x4 highest_m =
      of_blocks(highest, [](const auto& a, const auto& b) { return cv::v_max(a, b); });
  const cv::v_float32x4 max_step_m =
      cv::v_setall_f32(kSurfaceStepM) + cv::v_setall_f32(kSurfaceStepPerM) * lowest_m * lowest_m;
  const cv::v_float32x4 is_one = (lowest_m > cv::v_setzero_f32()) & (highest_m - lowest_m < max_step_m);
  cv::v_store(means_m, sum_m * cv::v_setall_f32(1.f / 16) & is_one);
}

/// The depth of a block of raw pixels: the mean of its larger group, if a depth edge splits it.
float BlockDepth(const float* corner, size_t stride, int step) {
  const BlockSums all = SumBlock(corner, stride, step);
  if (all.count * 4 < step * step)
    return 0;  // mostly unmeasured: edges and shadows, where values are unreliable
  if (all.highest_m - all.lowest_m < MaxSurfaceStepM(all.lowest_m))
    return all.sum_m / static_cast<float>(all.count);
  const float middle = (all.lowest_m + all.highest_m) / 2;
  float near_sum = 0;
  int near_count = 0;
  for (int y = 0; y < step; ++y)
    for (int x = 0; x < step; ++x) {
      const float z = corner[y * stride + x];
      const bool is_near = (z > 0) & (z < middle);  // without a branch, which nobody could predict
      near_sum += is_near ? z : 0.f, near_count += is_near;
    }
  if (near_count * 2 >= all.count) return near_sum / static_cast<float>(near_count);
  return (all.sum_m - near_sum) / static_cast<float>(all.count - near_count);
}

}  // namespace

WorkingGrids::WorkingGrids(const PinholeCamera& camera)
    : gray_step(std::max(1, static_cast<int>(std::lround(camera.width / 320.0)))),
      cell_step(2 * gray_step),
      gray(Reduced(camera, gray_step)),
      cell(Reduced(camera, cell_step)) {
  gray.width = 2 * cell.width, gray.height = 2 * cell.height;
}

FrameReducer::FrameReducer(const PinholeCamera& camera, const CornerOptions& corners)
    : grids_(camera),
      corners_(corners),
      cell_corner_(grids_.cell.height, grids_.cell.width),
      raw_to_cell_(camera.height, camera.width) {
  const int step = grids_.cell_step;
  for (int v = 0; v < grids_.cell.height; ++v)
    for (int u = 0; u < grids_.cell.width; ++u) {
      const Eigen::Vector2d raw = RawPixel(camera, step, u, v);
      const int x = static_cast<int>(std::lround(raw.x() - (step - 1) / 2.0));
      const int y = static_cast<int>(std::lround(raw.y() - (step - 1) / 2.0));
      const bool inside = x >= 0 && y >= 0 && x + step <= camera.width && y + step <= camera.height;
      cell_corner_(v, u) = inside ? cv::Point(x, y) : cv::Point(-1, 0);
    }

  std::vector<cv::Point2f> pixels;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) pixels.emplace_back(static_cast<float>(u), static_cast<float>(v));
  pixels = camera.Undistort(pixels);
  for (size_t i = 0; i < pixels.size(); ++i) {
    const int u =
        std::clamp(cvFloor((pixels[i].x + 0.5f) / static_cast<float>(step)), 0, grids_.cell.width - 1);
    const int v =
        std::clamp(cvFloor((pixels[i].y + 0.5f) / static_cast<float>(step)), 0, grids_.cell.height - 1);
    raw_to_cell_(static_cast<int>(i) / camera.width, static_cast<int>(i) % camera.width) =
        v * grids_.cell.width + u;
  }
  four_to_cell_ = cv::Mat1i(camera.height, camera.width / 4);
  for (int v = 0; v < four_to_cell_.rows; ++v)
    for (int i = 0; i < four_to_cell_.cols; ++i) {
      const int* four = raw_to_cell_[v] + 4 * i;
      four_to_cell_(v, i) = std::all_of(four, four + 4, [&](int cell) { return cell == *four; }) ? *four : -1;
    }
  for (int v = 0; v < camera.height; ++v)
    is_like_above_.push_back(
        v > 0 && std::equal(raw_to_cell_[v], raw_to_cell_[v] + camera.width, raw_to_cell_[v - 1]));

  if (!camera.IsDistorted()) return;
  cv::Mat2f map(grids_.gray.height, grids_.gray.width);
  const double half = grids_.gray_step, shift = (half - 1) / 2;
  for (int v = 0; v < map.rows; ++v)
    for (int u = 0; u < map.cols; ++u) {
      const Eigen::Vector2d raw = RawPixel(camera, grids_.gray_step, u, v);
      map(v, u) = {static_cast<float>((raw.x() - shift) / half),
                   static_cast<float>((raw.y() - shift) / half)};
    }
  cv::convertMaps(map, cv::noArray(), gray_map_, gray_map_fraction_, CV_16SC2);
}

WorkingFrame FrameReducer::Reduce(const RgbdImage& image) const {
  ORBSLAM_CHECK(image.gray.type() == CV_8UC1 && image.depth_m.type() == CV_32FC1);
  ORBSLAM_CHECK(image.gray.size() == raw_to_cell_.size() && image.depth_m.size() == raw_to_cell_.size());
  WorkingFrame frame;
  frame.timestamp_s = image.timestamp_s;
  const cv::Mat used =
      image.gray(cv::Rect(0, 0, grids_.gray.width * grids_.gray_step, grids_.gray.height * grids_.gray_step));
  cv::Mat halved;
  cv::resize(used, halved, {grids_.gray.width, grids_.gray.height}, 0, 0, cv::INTER_AREA);
  if (gray_map_.empty()) {
    frame.gray = halved;
  } else {
    cv::remap(halved, frame.gray, gray_map_, gray_map_fraction_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }
  frame.pyramid.resize(3);
  frame.gray.convertTo(frame.pyramid[0], CV_32F);
  for (int level = 1; level < 3; ++level) cv::pyrDown(frame.pyramid[level - 1], frame.pyramid[level]);
  frame.corners = SpreadCorners(frame.gray, corners_);

  frame.depth_m = ReduceDepth(image.depth_m);
  frame.num_depth_cells = cv::countNonZero(frame.depth_m);
  ComputeNormals(grids_.cell, &frame);
  return frame;
}

cv::Mat1f FrameReducer::ReduceDepth(const cv::Mat1f& raw) const {
  cv::Mat1f cells(cell_corner_.size(), 0.f);
  const size_t stride = raw.step1();
  const int step = grids_.cell_step;
  for (int v = 0; v < cells.rows; ++v) {
    const cv::Point* corners = cell_corner_[v];
    const auto block = [&](int u) { return raw[corners[u].y] + std::max(corners[u].x, 0); };
    float* out = cells[v];
    for (int u = 0; step == 4 && u + kBlocks <= cells.cols; u += kBlocks)
      MeansOfSurfaces({block(u), block(u + 1), block(u + 2), block(u + 3)}, stride, out + u);
    for (int u = 0; u < cells.cols; ++u) {
      if (corners[u].x < 0)
        out[u] = 0;
      else if (!(out[u] > 0))
        out[u] = BlockDepth(block(u), stride, step);
    }
  }
  return cells;
}

cv::Mat1b FrameReducer::ToRawMask(const cv::Mat1b& cell_mask) const {
  cv::Mat1b raw(raw_to_cell_.size());
  const uint8_t* cells = cell_mask.ptr();
  for (int v = 0; v < raw.rows; ++v) {
    const int* index = raw_to_cell_[v];
    uint8_t* out = raw[v];
    if (is_like_above_[v]) {
      std::copy_n(raw[v - 1], raw.cols, out);
      continue;
    }
    const auto mark = [&](int begin, int end) {
      for (int u = begin; u < end; ++u) out[u] = cells[index[u]] != 0 ? 255 : 0;
    };
    const int* four = four_to_cell_[v];
    for (int i = 0; i < four_to_cell_.cols; ++i)
      if (four[i] >= 0)
        std::fill_n(out + 4 * i, 4, static_cast<uint8_t>(cells[four[i]] != 0 ? 255 : 0));
      else
        mark(4 * i, 4 * i + 4);
    mark(4 * four_to_cell_.cols, raw.cols);
  }
  return raw;
}

}  // namespace orbslam
