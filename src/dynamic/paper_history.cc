// SPDX-License-Identifier: GPL-3.0-or-later
#include "paper_history.h"

#include <cmath>
#include <limits>

#include "orbslam/dynamic/motion_vectors.h"

namespace orbslam {
namespace {

Eigen::Vector3f Transformed(const Rigid3d& b_from_a, const Eigen::Vector3f& point_a) {
  return (b_from_a * point_a.cast<double>()).cast<float>();
}

PaperCluster MakeCluster(const PaperClusters& clusters, const std::vector<int>& indices) {
  PaperCluster cluster;
  cluster.points_m.reserve(indices.size());
  for (const int index : indices) cluster.points_m.push_back(clusters.points_m[index]);
  cluster.centroid_m = BallAtDistance(cluster.points_m).centre_m;
  return cluster;
}

HistogramCloud Counted(std::span<const Eigen::Vector3f> points_m) {
  return HistogramCloud(points_m, std::vector<float>(points_m.size(), 1.0F));
}

/// The published method does not define similarity. Here: the least squared sum of the distance of the
/// centroids, in radii of the motion ball, and of the logarithm of the ratio of sizes; centroids that are
/// more than two radii apart (balls that do not touch) are never the same thing.
int MostSimilar(const PaperCluster& cluster, const PaperView& previous) {
  constexpr float kMaxSquaredDistance = 4.0F;
  const float radius_m = MotionBallRadiusM(cluster.centroid_m.norm());
  float least = std::numeric_limits<float>::max();
  int best = -1;
  for (size_t i = 0; i < previous.clusters.size(); ++i) {
    const PaperCluster& other = previous.clusters[i];
    const Eigen::Vector3f centroid_m = Transformed(previous.current_from_view, other.centroid_m);
    const float distance = (centroid_m - cluster.centroid_m).squaredNorm() / (radius_m * radius_m);
    const float log_ratio =
        std::log(static_cast<float>(cluster.points_m.size()) / static_cast<float>(other.points_m.size()));
    const float difference = distance + log_ratio * log_ratio;
    if (distance > kMaxSquaredDistance || difference >= least) continue;
    least = difference;
    best = static_cast<int>(i);
  }
  return best;
}

}  // namespace

void PaperHistory::Add(double timestamp_s, const PaperClusters& clusters,
                       const Rigid3d& current_from_previous) {
  if (IsFull()) views_.pop_front();
  for (PaperView& view : views_) view.current_from_view = current_from_previous * view.current_from_view;
  PaperView view{.timestamp_s = timestamp_s, .cloud = Counted(clusters.points_m)};
  for (const std::vector<int>& indices : clusters.clusters) {
    PaperCluster cluster = MakeCluster(clusters, indices);
    if (!views_.empty()) cluster.predecessor = MostSimilar(cluster, views_.back());
    view.clusters.push_back(std::move(cluster));
  }
  views_.push_back(std::move(view));
}

std::vector<Eigen::Vector3f> PaperHistory::PredecessorPoints(int cluster) const {
  std::vector<Eigen::Vector3f> points_m;
  const int predecessor = current().clusters[cluster].predecessor;
  if (predecessor < 0) return points_m;
  const PaperView& previous = views_[views_.size() - 2];
  for (const Eigen::Vector3f& point : previous.clusters[predecessor].points_m) {
    points_m.push_back(Transformed(previous.current_from_view, point));
  }
  return points_m;
}

std::vector<HistogramRow> PaperHistory::WholeRows() const {
  std::vector<HistogramRow> rows;
  for (const PaperView& view : views_) rows.push_back({&view.cloud, view.current_from_view, AgeS(view)});
  return rows;
}

std::vector<HistogramRow> PaperHistory::AncestorRows(int cluster,
                                                     std::vector<HistogramCloud>* storage) const {
  storage->assign(views_.size(), {});
  std::vector<HistogramRow> rows(views_.size());
  int ancestor = cluster;
  for (size_t i = views_.size(); i-- > 0;) {
    const PaperView& view = views_[i];
    if (ancestor >= 0) {
      (*storage)[i] = Counted(view.clusters[ancestor].points_m);
      ancestor = view.clusters[ancestor].predecessor;
    }
    rows[i] = {&(*storage)[i], view.current_from_view, AgeS(view)};
  }
  return rows;
}

}  // namespace orbslam
