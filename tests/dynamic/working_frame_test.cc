// SPDX-License-Identifier: GPL-3.0-or-later
#include "working_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "orbslam/util/random.h"

namespace orbslam::test {
namespace {

PinholeCamera CameraOfWidth(int width) {
  return {width, width * 3 / 4, 0.8 * width, 0.8 * width, (width - 1) / 2.0, (width * 3 / 4 - 1) / 2.0, {}};
}

WorkingFrame Reduce(const PinholeCamera& camera, const cv::Mat1f& depth_m) {
  RgbdImage image;
  image.gray = cv::Mat1b(camera.height, camera.width, uint8_t{128});
  image.depth_m = depth_m;
  return FrameReducer(camera).Reduce(image);
}

double Mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// A cell's depth in so many words: see ReduceDepth.
double ExpectedDepth(const std::vector<float>& measured, int num_pixels) {
  if (static_cast<int>(measured.size()) * 4 < num_pixels) return 0;
  const auto [low, high] = std::minmax_element(measured.begin(), measured.end());
  if (*high - *low < MaxSurfaceStepM(*low)) return Mean(measured);
  std::vector<float> near, far;
  for (const float z : measured) (z < (*low + *high) / 2 ? near : far).push_back(z);
  return Mean(near.size() >= far.size() ? near : far);
}

class EveryWidth : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(WorkingFrame, EveryWidth, testing::Values(320, 640, 960, 1280));  // 2 to 8 px a cell

/// Surfaces with noise, edges across cells, holes (none on the left), and what is no depth at all.
TEST_P(EveryWidth, CellShowsTheMeanOfItsLargerSurface) {
  const PinholeCamera camera = CameraOfWidth(GetParam());
  const int step = WorkingGrids(camera).cell_step;
  Rng rng(41);
  cv::Mat1f depth_m(camera.height, camera.width);
  for (int v = 0; v < depth_m.rows; ++v)
    for (int u = 0; u < depth_m.cols; ++u) {
      const double surface_m = (u + v / 3) / (7 * step / 3) % 2 == 0 ? 1.5 : 2.5;
      depth_m(v, u) = static_cast<float>(surface_m + rng.Uniform(-0.01, 0.01));
      if (rng.Uniform() < 1.2 * u / depth_m.cols - 0.3) depth_m(v, u) = 0;
      if (rng.Uniform() < 0.02) depth_m(v, u) = std::numeric_limits<float>::quiet_NaN();
      if (rng.Uniform() < 0.02) depth_m(v, u) = -1;
    }
  const WorkingFrame frame = Reduce(camera, depth_m);
  ASSERT_EQ(frame.depth_m.cols, camera.width / step);
  int num_empty = 0;
  for (int v = 0; v < frame.depth_m.rows; ++v)
    for (int u = 0; u < frame.depth_m.cols; ++u) {
      std::vector<float> measured;
      for (const float z : cv::Mat1f(depth_m(cv::Rect(u * step, v * step, step, step)).clone()))
        if (z > 0) measured.push_back(z);
      EXPECT_NEAR(frame.depth_m(v, u), ExpectedDepth(measured, step * step), 1e-5) << u << ", " << v;
      num_empty += frame.depth_m(v, u) == 0;
    }
  EXPECT_GT(num_empty, 100);
  EXPECT_EQ(frame.num_depth_cells, static_cast<int>(frame.depth_m.total()) - num_empty);
}

/// A step in depth, down the picture or across.
TEST(WorkingFrameNormals, FaceTheCameraAndEndTwoCellsBeforeAnEdge) {
  const PinholeCamera camera = CameraOfWidth(640);
  for (const bool is_across : {false, true}) {
    cv::Mat1f depth_m(camera.height, camera.width, 1.5f);
    const cv::Size half(is_across ? camera.width / 2 : camera.width,
                        is_across ? camera.height : camera.height / 2);
    depth_m(cv::Rect({0, 0}, half)).setTo(2.5f);
    const WorkingFrame frame = Reduce(camera, depth_m);
    for (int v = 2; v < frame.depth_m.rows - 2; ++v)
      for (int u = 2; u < frame.depth_m.cols - 2; ++u) {
        const int past_edge = is_across ? u - frame.depth_m.cols / 2 : v - frame.depth_m.rows / 2;
        const float expected = past_edge >= -2 && past_edge < 2 ? 0.f : -1.f;
        ASSERT_NEAR(frame.normal_z(v, u), expected, 1e-6) << u << " " << v;
        ASSERT_NEAR(frame.normal_x(v, u), 0, 1e-6) << u << " " << v;
        ASSERT_NEAR(frame.normal_y(v, u), 0, 1e-6) << u << " " << v;
      }
  }
}

TEST_P(EveryWidth, MaskOfCellsCoversTheirPixels) {
  const PinholeCamera camera = CameraOfWidth(GetParam());
  const FrameReducer reducer(camera);
  const int step = reducer.grids().cell_step;
  cv::Mat1b cells(reducer.grids().cell.height, reducer.grids().cell.width, uint8_t{0});
  cells(10, 20) = 1;
  const cv::Mat1b raw = reducer.ToRawMask(cells);
  EXPECT_EQ(cv::countNonZero(raw), step * step);
  EXPECT_EQ(cv::countNonZero(raw(cv::Rect(20 * step, 10 * step, step, step)) == 255), step * step);
}

}  // namespace
}  // namespace orbslam::test
