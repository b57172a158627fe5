// SPDX-License-Identifier: GPL-3.0-or-later
#include "background_view.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "cells.h"
#include "projection.h"

namespace orbslam {
namespace {

constexpr float kFar = 1e6f;

struct Canvas {
  cv::Mat1f depth_m, gray;
};

/// Ratio of exposures, current over reference, from the cells where the two see the same surface.
float ExposureRatio(const GridCamera& camera, const WorkingFrame& current, const ReferenceView& reference) {
  constexpr int kStride = 8;  // rows; 2400 cells of 19200
  const auto moving = Cells(reference.moving);
  const auto depth_m = Cells(reference.frame->depth_m), gray = Cells(reference.frame->pyramid[1]);
  ProjectedRow row(camera.width);
  double now = 1, then = 1;
  for (int v = kStride / 2; v < camera.height; v += kStride) {
    ProjectRow(camera, reference.reference_from_current, v, current.depth_m[v], &row);
    const float* gray_now = current.pyramid[1][v];
    for (int u = 0; u < camera.width; ++u) {
      const int index = row.index[u];
      if (row.depth_m[u] == kNowhereM || moving[index] != 0) continue;
      if (std::abs(depth_m[index] - row.depth_m[u]) > MaxSurfaceStepM(row.depth_m[u])) continue;
      now += gray_now[u], then += gray[index];
    }
  }
  return std::clamp(static_cast<float>(now / then), 0.5f, 2.f);
}

void Splat(const GridCamera& camera, const WorkingFrame& current, const ReferenceView& reference,
           const cv::Mat1b& wanted, Canvas* canvas) {
  const Rigid3d current_from_reference = Inverse(reference.reference_from_current);
  const float exposure = ExposureRatio(camera, current, reference);
  ProjectedRow row(camera.width);
  std::vector<int> hits(camera.width);  // cells of a row that fall where something is wanted
  const auto nearest_m = Cells(canvas->depth_m), nearest_gray = Cells(canvas->gray);
  const auto is_wanted = Cells(wanted);
  for (int v = 0; v < camera.height; ++v) {
    ProjectRow(camera, current_from_reference, v, reference.filled_depth_m[v], &row);
    const uint8_t* moving = reference.moving[v];
    const float* gray = reference.frame->pyramid[1][v];
    int count = 0;
    for (int u = 0; u < camera.width; ++u) {  // without branches, which nobody could predict
      hits[count] = u;
      count += (is_wanted[row.index[u]] != 0) & (moving[u] == 0);
    }
    for (int i = 0; i < count; ++i) {
      const int u = hits[i], index = row.index[u];
      if (row.depth_m[u] >= nearest_m[index]) continue;
      nearest_m[index] = row.depth_m[u];
      nearest_gray[index] = gray[u] * exposure;
    }
  }
}

}  // namespace

BackgroundView RenderBackground(const GridCamera& camera, const WorkingFrame& current,
                                std::span<const ReferenceView* const> references) {
  Canvas canvas{cv::Mat1f(camera.height, camera.width, kFar), cv::Mat1f(camera.height, camera.width, 0.f)};
  const cv::Mat ones = cv::Mat::ones(3, 3, CV_8U);
  cv::Mat1b wanted;
  cv::compare(current.depth_m, 0, wanted, cv::CMP_EQ);
  cv::dilate(wanted, wanted, ones);
  if (cv::countNonZero(wanted) > 0)
    for (const ReferenceView* reference : references) Splat(camera, current, *reference, wanted, &canvas);

  BackgroundView view;
  cv::Mat1b empty;
  cv::compare(canvas.depth_m, kFar, empty, cv::CMP_GE);
  cv::erode(canvas.depth_m, view.depth_m, ones);  // the nearest of the 3 x 3: closes holes
  view.depth_m.setTo(0, view.depth_m >= kFar);
  cv::dilate(canvas.gray, view.brightest, ones);
  canvas.gray.setTo(kFar, empty);
  cv::erode(canvas.gray, view.darkest, ones);
  return view;
}

}  // namespace orbslam
