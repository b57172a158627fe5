// SPDX-License-Identifier: GPL-3.0-or-later
#include "histogram_evidence.h"

#include <algorithm>
#include <array>

namespace orbslam {
namespace {

Eigen::Vector3f CellPoint(const GridCamera& camera, int u, int v, float depth_m) {
  return {(static_cast<float>(u) - camera.cx) / camera.fx * depth_m,
          (static_cast<float>(v) - camera.cy) / camera.fy * depth_m, depth_m};
}

/// Mean sideways shift of the corners on a cluster, against where static points would be; camera axes.
Eigen::Vector3f MeanShift(const cv::Mat1b& is_cluster, std::span<const TrackedCorner> corners) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const TrackedCorner& corner : corners) {
    const int u = cvFloor(corner.current.x / 2), v = cvFloor(corner.current.y / 2);
    if (u < 0 || v < 0 || u >= is_cluster.cols || v >= is_cluster.rows || is_cluster(v, u) == 0) continue;
    sum += Eigen::Vector3f(corner.excess.x, corner.excess.y, 0);
  }
  return sum;
}

}  // namespace

std::shared_ptr<const HistogramCloud> MakeHistogramCloud(const GridCamera& camera, const cv::Mat1f& depth_m,
                                                         int stride) {
  std::vector<Eigen::Vector3f> points;
  for (int v = stride / 2; v < depth_m.rows; v += stride)
    for (int u = stride / 2; u < depth_m.cols; u += stride)
      if (depth_m(v, u) > 0) points.push_back(CellPoint(camera, u, v, depth_m(v, u)));
  return std::make_shared<const HistogramCloud>(points);
}

HistogramWindow::HistogramWindow(const GridCamera& camera, const SceneHistory& history,
                                 const WorkingFrame& current, const HistogramOptions& options)
    : camera_(camera),
      options_(options),
      depth_m_(current.depth_m),
      current_cloud_(MakeHistogramCloud(camera, current.depth_m, options.stride)) {
  for (int num_back = kMotionHistogramRows - 1; num_back >= 1; --num_back) {
    const ReferenceView* view = history.Back(num_back);
    if (view == nullptr || view->cloud == nullptr) continue;
    rows_.push_back({view->cloud.get(), Inverse(view->reference_from_current),
                     view->frame->timestamp_s - current.timestamp_s});
  }
  rows_.push_back({current_cloud_.get(), {}, 0});
}

ClusterMotion HistogramWindow::Motion(const Cluster& cluster, std::span<const TrackedCorner> corners) const {
  std::vector<Eigen::Vector3f> points;
  cv::Mat1b is_cluster(depth_m_.size(), uint8_t{0});
  for (const int cell : cluster.cells) {
    is_cluster(cell) = 1;
    const int u = cell % depth_m_.cols, v = cell / depth_m_.cols;
    if (u % options_.stride == options_.stride / 2 && v % options_.stride == options_.stride / 2)
      points.push_back(CellPoint(camera_, u, v, depth_m_(cell)));
  }
  if (points.empty()) return {};
  std::vector<Eigen::Vector3f> directions{Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ()};
  const Eigen::Vector3f shift = MeanShift(is_cluster, corners);
  if (shift.norm() > 1.f) directions.push_back(shift.normalized());
  return FindClusterMotion(rows_, points, directions, options_.max_speed_mps);
}

}  // namespace orbslam
