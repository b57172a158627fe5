// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmenter.h"

#include <pcl/point_types.h>
#include <pcl/segmentation/comparator.h>
#include <pcl/segmentation/organized_connected_component_segmentation.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cells.h"

namespace orbslam {
namespace {

using Point = pcl::PointXYZ;

bool AreLinked(float za_m, float zb_m) {
  return std::abs(za_m - zb_m) < MaxSurfaceStepM(std::min(za_m, zb_m));
}

/// Links neighbouring cells of one surface; cells left out have z = NaN, for which no comparison holds.
class SurfaceComparator : public pcl::Comparator<Point> {
 public:
  bool compare(int a, int b) const override { return AreLinked((*input_)[a].z, (*input_)[b].z); }
};

/// The included cells, framed by one that is not, of which each is reached once.
class Flood {
 public:
  Flood(const cv::Mat1f& depth_m, const cv::Mat1b& included)
      : size_(depth_m.size()),
        unreached_m_(size_.height + 2, size_.width + 2, 0.f),
        parts_(unreached_m_.size(), -1) {
    depth_m.copyTo(unreached_m_(cv::Rect({1, 1}, size_)), included);
  }

  /// Numbers what hangs together with a cell, unless it was reached before.
  void From(int u, int v) {
    const auto depths_m = Cells(unreached_m_);
    const auto parts = Cells(parts_);
    const auto reach = [&](int cell) {
      front_.push_back({cell, depths_m[cell]});
      depths_m[cell] = 0;
      parts[cell] = num_parts_;
    };
    const int width = unreached_m_.cols, first = (v + 1) * width + u + 1;
    if (!(depths_m[first] > 0)) return;
    for (reach(first); !front_.empty();) {
      const auto [cell, depth_m] = front_.back();
      front_.pop_back();
      for (const int neighbor : {cell + 1, cell - 1, cell + width, cell - width})
        if (depths_m[neighbor] > 0 && AreLinked(depth_m, depths_m[neighbor])) reach(neighbor);
    }
    ++num_parts_;
  }

  std::vector<Cluster> Parts() const {
    std::vector<Cluster> parts(num_parts_);
    for (int v = 0; v < size_.height; ++v) {
      const int* row = parts_[v + 1] + 1;
      for (int u = 0; u < size_.width; ++u)
        if (row[u] >= 0) parts[row[u]].cells.push_back(v * size_.width + u);
    }
    return parts;
  }

 private:
  struct Reached {
    int cell;
    float depth_m;
  };

  cv::Size size_;
  cv::Mat1f unreached_m_;  // 0: reached, or not included
  cv::Mat1i parts_;        // -1: none
  int num_parts_ = 0;
  std::vector<Reached> front_;
};

}  // namespace

Segmentation SegmentCells(const cv::Mat1f& depth_m, const cv::Mat1b& included, int min_cells) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const auto cloud = pcl::make_shared<pcl::PointCloud<Point>>(depth_m.cols, depth_m.rows);
  cloud->is_dense = false;
  const auto depths_m = Cells(depth_m);
  const auto is_included = Cells(included);
  for (size_t i = 0; i < depths_m.size(); ++i) {
    Point& point = cloud->points[i];
    point.x = point.y = point.z = depths_m[i] > 0 && is_included[i] != 0 ? depths_m[i] : kNan;
  }

  const auto comparator = pcl::make_shared<SurfaceComparator>();
  comparator->setInputCloud(cloud);
  pcl::OrganizedConnectedComponentSegmentation<Point, pcl::Label> segmentation(comparator);
  segmentation.setInputCloud(cloud);
  pcl::PointCloud<pcl::Label> labels;
  std::vector<pcl::PointIndices> components;
  segmentation.segment(labels, components);

  Segmentation result;
  result.labels = cv::Mat1i(depth_m.size(), -1);
  for (pcl::PointIndices& component : components) {
    if (static_cast<int>(component.indices.size()) < min_cells) continue;
    for (const int cell : component.indices) result.labels(cell) = static_cast<int>(result.clusters.size());
    result.clusters.push_back({std::move(component.indices), false});
  }
  return result;
}

std::vector<Cluster> SeededClusters(const cv::Mat1f& depth_m, const cv::Mat1b& included,
                                    const cv::Mat1b& seeds, int min_cells) {
  Flood flood(depth_m, included);
  for (int v = 0; v < seeds.rows; ++v) {
    const uint8_t* is_seed = seeds[v];
    for (int u = 0; u < seeds.cols; ++u)
      if (is_seed[u] != 0) flood.From(u, v);
  }
  std::vector<Cluster> clusters = flood.Parts();
  std::erase_if(clusters, [&](const Cluster& c) { return static_cast<int>(c.cells.size()) < min_cells; });
  std::ranges::sort(clusters, {}, [](const Cluster& cluster) { return cluster.cells.front(); });
  return clusters;
}

}  // namespace orbslam
