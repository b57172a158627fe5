// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/paper_detector.h"

#include <utility>

#include "orbslam/dynamic/line_integral.h"
#include "orbslam/dynamic/motion_histogram.h"
#include "orbslam/dynamic/motion_vectors.h"
#include "orbslam/util/check.h"
#include "paper_cloud.h"
#include "paper_history.h"

namespace orbslam {

class PaperDetector::Implementation {
 public:
  explicit Implementation(const PaperDetectorOptions& options) : options_(options) {}

  PaperResult Process(const PaperFrame& frame, const Rigid3d& current_from_previous) {
    ORBSLAM_CHECK(frame.points_m.size() == frame.pixel_indices.size());
    const std::vector<Eigen::Vector3f> usable_m = UsablePoints(frame);
    const PaperClusters clusters = ExtractClusters(usable_m, CloudOptions());
    history_.Add(frame.timestamp_s, clusters, current_from_previous);
    PaperResult result;
    if (!history_.IsFull()) return result;
    for (size_t i = 0; i < clusters.clusters.size(); ++i) {
      result.objects.push_back(Judge(static_cast<int>(i)));
    }
    MarkPixels(frame, clusters, &result);
    return result;
  }

  void Reset() { history_.Clear(); }

 private:
  PaperCloudOptions CloudOptions() const {
    return {static_cast<float>(options_.voxel_m), options_.outlier_neighbors, options_.outlier_sigmas,
            options_.cluster_gap_m, options_.min_cluster_points};
  }

  std::vector<Eigen::Vector3f> UsablePoints(const PaperFrame& frame) const {
    std::vector<Eigen::Vector3f> usable_m;
    usable_m.reserve(frame.points_m.size());
    for (const Eigen::Vector3f& point : frame.points_m) {
      if (point.allFinite() && point.z() > 0 && point.z() < options_.max_range_m) usable_m.push_back(point);
    }
    return usable_m;
  }

  PaperObject Judge(int index) const {
    const std::vector<Eigen::Vector3f>& points_m = history_.current().clusters[index].points_m;
    PaperObject object;
    object.centroid_m = history_.current().clusters[index].centroid_m;
    object.num_points = static_cast<int>(points_m.size());
    const MotionBall ball = BallAtDistance(points_m);
    const auto direction =
        MotionDirection(MotionVectors(PointsInBall(points_m, ball), history_.PredecessorPoints(index)));
    if (!direction) return object;
    const SweptVolume volume{ball, *direction, static_cast<float>(options_.max_speed_mps)};
    const LineIntegral line = PublishedLineIntegral(Histogram(index, volume), object.num_points);
    object.line_integral_ratio = line.ratio / options_.tau;
    object.velocity_mps = static_cast<float>(line.velocity_mps) * *direction;
    return object;
  }

  MotionHistogram Histogram(int index, const SweptVolume& volume) const {
    if (!options_.associated_rows) return BuildMotionHistogram(history_.WholeRows(), volume);
    std::vector<HistogramCloud> clouds;
    const std::vector<HistogramRow> rows = history_.AncestorRows(index, &clouds);
    return BuildMotionHistogram(rows, volume);
  }

  void MarkPixels(const PaperFrame& frame, const PaperClusters& clusters, PaperResult* result) const {
    const std::vector<int> labels =
        ClusterOfSourcePoints(frame.points_m, clusters, static_cast<float>(options_.voxel_m));
    for (size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] < 0) continue;
      PaperObject& object = result->objects[labels[i]];
      ++object.num_pixels;
      if (object.IsDynamic()) result->dynamic_pixels.push_back(frame.pixel_indices[i]);
    }
  }

  PaperDetectorOptions options_;
  PaperHistory history_;
};

PaperDetector::PaperDetector(const PaperDetectorOptions& options)
    : implementation_(std::make_unique<Implementation>(options)) {}
PaperDetector::~PaperDetector() = default;
PaperDetector::PaperDetector(PaperDetector&&) noexcept = default;
PaperDetector& PaperDetector::operator=(PaperDetector&&) noexcept = default;

PaperResult PaperDetector::Process(const PaperFrame& frame, const Rigid3d& current_from_previous) {
  return implementation_->Process(frame, current_from_previous);
}

void PaperDetector::Reset() { implementation_->Reset(); }

}  // namespace orbslam
