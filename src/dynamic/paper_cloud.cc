// SPDX-License-Identifier: GPL-3.0-or-later
#include "paper_cloud.h"

#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace orbslam {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Cloud::Ptr Cleaned(const Cloud::Ptr& cloud, const PaperCloudOptions& options) {
  const auto thinned = std::make_shared<Cloud>();
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(options.voxel_m, options.voxel_m, options.voxel_m);
  grid.filter(*thinned);
  const auto cleaned = std::make_shared<Cloud>();
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> outliers;
  outliers.setInputCloud(thinned);
  outliers.setMeanK(options.outlier_neighbors);
  outliers.setStddevMulThresh(options.outlier_sigmas);
  outliers.filter(*cleaned);
  return cleaned;
}

/// The voxel's place in PCL's grid, which is aligned with the origin; 21 bits an axis.
uint64_t VoxelKey(const Eigen::Vector3f& point_m, float voxel_m) {
  const float per_metre = 1.0F / voxel_m;
  const auto axis = [&](float value_m) {
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor(value_m * per_metre)) + (1 << 20)) &
           0x1FFFFFU;
  };
  return axis(point_m.x()) | axis(point_m.y()) << 21 | axis(point_m.z()) << 42;
}

}  // namespace

Cloud::Ptr ToPcl(std::span<const Eigen::Vector3f> points_m) {
  auto cloud = std::make_shared<Cloud>();
  cloud->reserve(points_m.size());
  for (const Eigen::Vector3f& p : points_m) cloud->push_back(pcl::PointXYZ(p.x(), p.y(), p.z()));
  return cloud;
}

PaperClusters ExtractClusters(std::span<const Eigen::Vector3f> points_m, const PaperCloudOptions& options) {
  PaperClusters result;
  // PCL's filters print a warning for an empty cloud.
  if (static_cast<int>(points_m.size()) < options.min_cluster_points) return result;
  const Cloud::Ptr cloud = Cleaned(ToPcl(points_m), options);
  for (const pcl::PointXYZ& point : *cloud) result.points_m.push_back(point.getVector3fMap());
  if (static_cast<int>(cloud->size()) < options.min_cluster_points) return result;

  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setInputCloud(cloud);
  extraction.setSearchMethod(std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>(false));
  extraction.setClusterTolerance(options.cluster_gap_m);
  extraction.setMinClusterSize(options.min_cluster_points);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  for (pcl::PointIndices& cluster : clusters) {
    std::sort(cluster.indices.begin(), cluster.indices.end());
    result.clusters.push_back(std::move(cluster.indices));
  }
  return result;
}

std::vector<int> ClusterOfSourcePoints(std::span<const Eigen::Vector3f> source_m,
                                       const PaperClusters& clusters, float voxel_m) {
  std::unordered_map<uint64_t, int> cluster_of_voxel;
  cluster_of_voxel.reserve(clusters.points_m.size());
  for (size_t i = 0; i < clusters.clusters.size(); ++i) {
    for (const int point : clusters.clusters[i]) {
      // The centroid of a voxel's points lies in the voxel.
      cluster_of_voxel.emplace(VoxelKey(clusters.points_m[point], voxel_m), static_cast<int>(i));
    }
  }
  std::vector<int> labels;
  labels.reserve(source_m.size());
  for (const Eigen::Vector3f& point : source_m) {
    const auto found =
        point.allFinite() ? cluster_of_voxel.find(VoxelKey(point, voxel_m)) : cluster_of_voxel.end();
    labels.push_back(found == cluster_of_voxel.end() ? -1 : found->second);
  }
  return labels;
}

}  // namespace orbslam
