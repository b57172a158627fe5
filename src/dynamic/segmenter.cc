// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmenter.h"

#include <pcl/point_types.h>
#include <pcl/segmentation/comparator.h>
#include <pcl/segmentation/organized_connected_component_segmentation.h>

#include <cmath>
#include <limits>

#include "cells.h"

namespace orbslam {
namespace {

using Point = pcl::PointXYZ;

/// Links neighbouring cells of one surface; cells left out have z = NaN, for which no comparison holds.
class SurfaceComparator : public pcl::Comparator<Point> {
 public:
  bool compare(int a, int b) const override {
    const float za = (*input_)[a].z, zb = (*input_)[b].z;
    return std::abs(za - zb) < MaxSurfaceStepM(std::min(za, zb));
  }
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

}  // namespace orbslam
