// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>
#include <span>
#include <vector>

namespace orbslam {

/// The same points as a PCL cloud.
pcl::PointCloud<pcl::PointXYZ>::Ptr ToPcl(std::span<const Eigen::Vector3f> points_m);

/// How the published method cleans a cloud and takes it apart; metres.
struct PaperCloudOptions {
  float voxel_m = 0;
  int outlier_neighbors = 0;
  double outlier_sigmas = 0;
  double cluster_gap_m = 0;
  int min_cluster_points = 0;
};

/// A frame's cleaned cloud and its clusters, indices into `points_m`, each ascending.
struct PaperClusters {
  std::vector<Eigen::Vector3f> points_m;
  std::vector<std::vector<int>> clusters;
};

/// Voxel grid, removal of outliers, Euclidean clustering (steps 2 and 3), all three PCL's.
PaperClusters ExtractClusters(std::span<const Eigen::Vector3f> points_m, const PaperCloudOptions& options);

/// The cluster to whose voxels each source point belongs, -1: none. `num_points` values.
std::vector<int> ClusterOfSourcePoints(std::span<const Eigen::Vector3f> source_m,
                                       const PaperClusters& clusters, float voxel_m);

}  // namespace orbslam
