// SPDX-License-Identifier: GPL-3.0-or-later
#include "object_tracker.h"

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>

#include "cells.h"

namespace orbslam {
namespace {

/// Connected parts of fewer cells are not reported as objects (they stay in the mask).
constexpr int kMinCells = 20;

}  // namespace

/// The id with the largest overlap, the largest overlaps first; new ids for the rest.
std::vector<int> ObjectTracker::InheritIds(const cv::Mat1i& parts, int num_parts, const cv::Mat2f& shift) {
  std::vector<int> ids(num_parts, 0);
  if (!previous_ids_.empty()) {
    std::map<std::pair<int, int>, int> overlap;  // part, id -> cells
    auto last = overlap.end();                   // most cells are like the one before
    for (int v = 0; v < parts.rows; ++v)
      for (int u = 0; u < parts.cols; ++u) {
        if (parts[v][u] == 0) continue;
        const int x = std::clamp(u + cvRound(shift(v, u)[0]), 0, parts.cols - 1);
        const int y = std::clamp(v + cvRound(shift(v, u)[1]), 0, parts.rows - 1);
        const std::pair pair(parts(v, u), previous_ids_(y, x));
        if (pair.second == 0) continue;
        if (last == overlap.end() || last->first != pair) last = overlap.try_emplace(pair, 0).first;
        ++last->second;
      }
    std::vector<std::pair<int, std::pair<int, int>>> ranked;
    for (const auto& [pair, cells] : overlap) ranked.push_back({-cells, pair});
    std::sort(ranked.begin(), ranked.end());
    std::set<int> taken;
    for (const auto& [cells, pair] : ranked)
      if (ids[pair.first] == 0 && taken.insert(pair.second).second) ids[pair.first] = pair.second;
  }
  return ids;
}

ObjectTracker::Labelled ObjectTracker::Update(const GridCamera& camera, int pixels_per_cell,
                                              const cv::Mat1b& moving, const WorkingFrame& frame,
                                              const cv::Mat1f& log_odds, const cv::Mat2f& shift) {
  Labelled result;
  cv::Mat1i parts;
  const int num_parts = cv::connectedComponents(moving, parts, 8, CV_32S);
  std::vector<int> ids = InheritIds(parts, num_parts, shift);
  struct Sums {
    int cells = 0, measured = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    double log_odds = 0;
  };
  std::vector<Sums> sums(num_parts);
  for (int v = 0; v < parts.rows; ++v) {
    const int* part = parts[v];
    const float *cell_log_odds = log_odds[v], *depth_m = frame.depth_m[v];
    for (int u = 0; u < parts.cols; ++u) {
      if (part[u] == 0) continue;
      Sums& sum = sums[part[u]];
      ++sum.cells;
      sum.log_odds += cell_log_odds[u];
      const double z = depth_m[u];
      if (z <= 0 || cell_log_odds[u] <= 0) continue;  // the rim of the mask lies on the background
      ++sum.measured;
      sum.position += z * Eigen::Vector3d((static_cast<float>(u) - camera.cx) / camera.fx,
                                          (static_cast<float>(v) - camera.cy) / camera.fy, 1);
    }
  }
  std::vector<int> index_of_part(num_parts, -1);
  for (int part = 1; part < num_parts; ++part) {
    const Sums& sum = sums[part];
    if (sum.cells < kMinCells) continue;
    if (ids[part] == 0) ids[part] = ++last_id_;
    index_of_part[part] = static_cast<int>(result.objects.size());
    DynamicObject object;
    object.id = ids[part];
    if (sum.measured > 0) object.centroid_m = sum.position / sum.measured;
    object.log_odds = sum.log_odds / sum.cells;
    object.num_pixels = sum.cells * pixels_per_cell;
    result.objects.push_back(object);
  }
  result.object_of_cell = cv::Mat1i(parts.size());
  previous_ids_.create(parts.size());
  const auto part_of_cell = Cells(parts), object_of_cell = Cells(result.object_of_cell);
  const auto previous_ids = Cells(previous_ids_);
  for (size_t i = 0; i < part_of_cell.size(); ++i) {
    const int part = part_of_cell[i];
    object_of_cell[i] = index_of_part[part];
    previous_ids[i] = index_of_part[part] >= 0 ? ids[part] : 0;
  }
  return result;
}

}  // namespace orbslam
