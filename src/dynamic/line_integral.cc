// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/line_integral.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "orbslam/util/check.h"

namespace orbslam {
namespace {

/// Neighbouring slopes part by this share of a bin at the window's far end: finer ones only interpolate.
constexpr double kSlopeStepBins = 0.5;
constexpr double kMinSlopeBins = 1.0;

using Matrix = MotionHistogram::Matrix;

/// Slopes symmetric round zero, as multiples of a step.
struct Slopes {
  double step_mps = 0;
  int half_count = 0;  // slopes -half_count..half_count

  explicit Slopes(const MotionHistogram& histogram)
      : step_mps(kSlopeStepBins * histogram.bin_m / histogram.DurationS()),
        half_count(static_cast<int>(std::floor(histogram.max_speed_mps / step_mps))) {}
};

/// Zeros to either side, as wide as the longest line may leave the histogram.
Matrix Padded(const Matrix& rows, int margin) {
  Matrix padded = Matrix::Zero(rows.rows(), rows.cols() + 2 * margin);
  padded.middleCols(margin, rows.cols()) = rows;
  return padded;
}

/// Each row read at `shift_bins(time)` to the right of where it is, linearly between bins.
struct RowReader {
  const float* low = nullptr;
  float fraction = 0;

  RowReader(const Matrix& padded, Eigen::Index row, int first_column, double shift_bins) {
    const double floor = std::floor(shift_bins);
    low = padded.row(row).data() + first_column + static_cast<int>(floor);
    fraction = static_cast<float>(shift_bins - floor);
  }
  float operator[](int i) const { return low[i] + fraction * (low[i + 1] - low[i]); }
};

/// Binomial average of each bin and its neighbours; the outermost bins are zero and stay so. Reading between
/// bins then smooths noise hardly more than reading on them, so that no slope is favoured for falling
/// between.
Matrix Smoothed(const Matrix& rows) {
  Matrix smoothed = rows;
  const Eigen::Index inner = rows.cols() - 2;
  smoothed.middleCols(1, inner) =
      0.25F * (rows.leftCols(inner) + rows.rightCols(inner)) + 0.5F * rows.middleCols(1, inner);
  return smoothed;
}

/// Sums, over the bins of the extent, of the second-lowest weight that a velocity meets in the rows.
class PersistentSums {
 public:
  PersistentSums(const MotionHistogram& histogram, const ClusterExtent& extent)
      : histogram_(histogram), margin_(Margin(histogram)) {
    const auto last = static_cast<int>(histogram.weights.cols()) - 1;
    const auto bin_at = [&](float position_m) {
      return std::clamp(static_cast<int>(std::lround((position_m - histogram.first_m) / histogram.bin_m)), 0,
                        last);
    };
    first_bin_ = bin_at(extent.low_m);
    const auto count = static_cast<size_t>(bin_at(extent.high_m) - first_bin_ + 1);
    padded_ = Smoothed(Padded(histogram.weights, margin_));
    lowest_.resize(count);
    second_.resize(count);
  }

  /// What persists at a velocity, of what the extent holds in the current row.
  double Along(double velocity_mps) { return Sum(velocity_mps / histogram_.bin_m, 0); }
  /// What persists at rest where the extent was in the oldest row at that velocity.
  double AtRest(double velocity_mps) {
    return Sum(0, -velocity_mps * histogram_.DurationS() / histogram_.bin_m);
  }

 private:
  double Sum(double bins_per_s, double shift_bins) {
    std::fill(lowest_.begin(), lowest_.end(), std::numeric_limits<float>::max());
    std::fill(second_.begin(), second_.end(), std::numeric_limits<float>::max());
    for (Eigen::Index row = 0; row < padded_.rows(); ++row) {
      const double age_s = histogram_.times_s[row] - histogram_.times_s.back();
      KeepTwoLowest(RowReader(padded_, row, margin_ + first_bin_, shift_bins + bins_per_s * age_s));
    }
    float sum = 0;
    for (const float value : second_) sum += value;
    return sum;
  }

  static int Margin(const MotionHistogram& histogram) {
    return static_cast<int>(std::ceil(histogram.max_speed_mps * histogram.DurationS() / histogram.bin_m)) + 2;
  }

  void KeepTwoLowest(const RowReader& reader) {
    float* lowest = lowest_.data();
    float* second = second_.data();
    const int count = static_cast<int>(lowest_.size());
    for (int i = 0; i < count; ++i) {
      const float value = reader[i];
      second[i] = std::min(second[i], std::max(lowest[i], value));
      lowest[i] = std::min(lowest[i], value);
    }
  }

  const MotionHistogram& histogram_;
  int margin_;
  int first_bin_ = 0;
  Matrix padded_;
  std::vector<float> lowest_;
  std::vector<float> second_;
};

/// Where the parabola through three neighbouring values peaks, in steps from the middle one.
double ParabolaPeak(double left, double middle, double right) {
  const double curvature = left - 2 * middle + right;
  return curvature < 0 ? std::clamp(0.5 * (left - right) / curvature, -0.5, 0.5) : 0.0;
}

}  // namespace

LineIntegral PublishedLineIntegral(const MotionHistogram& histogram, double cluster_weight) {
  ORBSLAM_CHECK(cluster_weight > 0);
  LineIntegral best;
  if (histogram.weights.rows() < 2 || !(histogram.DurationS() > 0)) return best;
  const Slopes slopes(histogram);
  const auto num_bins = static_cast<int>(histogram.weights.cols());
  const int margin = static_cast<int>(std::ceil(slopes.half_count * kSlopeStepBins)) + 2;
  const Matrix padded = Padded(histogram.weights, margin);
  std::vector<float> sums(static_cast<size_t>(num_bins));
  for (int slope = -slopes.half_count; slope <= slopes.half_count; ++slope) {
    if (std::abs(slope) * kSlopeStepBins < kMinSlopeBins) continue;
    const double velocity_mps = slope * slopes.step_mps;
    std::fill(sums.begin(), sums.end(), 0.0F);
    for (Eigen::Index row = 0; row < padded.rows(); ++row) {
      const double age_s = histogram.times_s[row] - histogram.times_s.back();
      const RowReader reader(padded, row, margin, velocity_mps * age_s / histogram.bin_m);
      for (int bin = 0; bin < num_bins; ++bin) sums[bin] += reader[bin];
    }
    const double largest = *std::max_element(sums.begin(), sums.end());
    if (largest > best.integral) best = {largest, largest / cluster_weight, velocity_mps};
  }
  return best;
}

LineIntegral PersistentLineIntegral(const MotionHistogram& histogram, const ClusterExtent& extent,
                                    double cluster_weight) {
  ORBSLAM_CHECK(cluster_weight > 0);
  if (histogram.weights.rows() < 3 || !(histogram.DurationS() > 0)) return {};
  const Slopes slopes(histogram);
  PersistentSums sums(histogram, extent);
  const double rest_here = sums.AtRest(0);
  std::vector<double> gains;
  for (int slope = -slopes.half_count; slope <= slopes.half_count; ++slope) {
    const double velocity_mps = slope * slopes.step_mps;
    gains.push_back(sums.Along(velocity_mps) - std::max(rest_here, sums.AtRest(velocity_mps)));
  }
  const auto peak = std::max_element(gains.begin(), gains.end());
  if (!(*peak > 0)) return {};
  const auto index = static_cast<int>(peak - gains.begin());
  double offset = 0;
  if (index > 0 && index < 2 * slopes.half_count) offset = ParabolaPeak(peak[-1], peak[0], peak[1]);
  return {*peak, *peak / cluster_weight, (index - slopes.half_count + offset) * slopes.step_mps};
}

ClusterMotion FindClusterMotion(std::span<const HistogramRow> rows, std::span<const Eigen::Vector3f> points_m,
                                std::span<const Eigen::Vector3f> directions, float max_speed_mps) {
  ClusterMotion best;
  const double cluster_weight = SurfaceWeight(points_m);
  const MotionBall ball = BallAroundCluster(points_m);
  for (const Eigen::Vector3f& direction : directions) {
    const SweptVolume volume{ball, direction, max_speed_mps};
    const LineIntegral line = PersistentLineIntegral(BuildMotionHistogram(rows, volume),
                                                     ExtentAlong(points_m, volume), cluster_weight);
    if (line.ratio <= best.ratio) continue;
    best = {static_cast<float>(line.velocity_mps) * direction, direction, line.ratio};
  }
  return best;
}

}  // namespace orbslam
