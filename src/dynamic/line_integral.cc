// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/line_integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
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

/// Takes each bin's median over the rows away.
Matrix WithoutMedians(const Matrix& rows) {
  Matrix residual = rows;
  std::vector<float> column(static_cast<size_t>(rows.rows()));
  for (Eigen::Index bin = 0; bin < rows.cols(); ++bin) {
    for (Eigen::Index row = 0; row < rows.rows(); ++row) column[row] = rows(row, bin);
    const auto middle = column.begin() + static_cast<std::ptrdiff_t>(column.size() / 2);
    std::nth_element(column.begin(), middle, column.end());
    residual.col(bin).array() -= *middle;
  }
  return residual;
}

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

int Margin(const MotionHistogram& histogram) {
  return static_cast<int>(std::ceil(histogram.max_speed_mps * histogram.DurationS() / histogram.bin_m)) + 2;
}

/// Follows the bins of an extent along lines, and sums over them the value of the given rank (0: the lowest)
/// among those that each meets in the rows.
template <int kRank>
class ExtentLines {
 public:
  /// `padded`: the histogram's rows, or what is made of them, with its Margin to either side.
  ExtentLines(const MotionHistogram& histogram, Matrix padded, const ClusterExtent& extent)
      : histogram_(histogram), padded_(std::move(padded)) {
    const auto last = static_cast<int>(histogram.weights.cols()) - 1;
    const auto bin_at = [&](float position_m) {
      const auto bin = static_cast<int>(std::lround((position_m - histogram.first_m) / histogram.bin_m));
      return std::clamp(bin, 0, last);
    };
    first_column_ = Margin(histogram) + bin_at(extent.low_m);
    for (auto& values : lowest_)
      values.resize(static_cast<size_t>(bin_at(extent.high_m) - bin_at(extent.low_m) + 1));
  }

  /// Back from where the extent is in the newest row, at a velocity.
  double Along(double velocity_mps) { return Sum(velocity_mps / histogram_.bin_m, 0); }
  /// At rest where the extent would have been in the oldest row at that velocity.
  double AtRest(double velocity_mps) {
    return Sum(0, -velocity_mps * histogram_.DurationS() / histogram_.bin_m);
  }

 private:
  double Sum(double bins_per_s, double shift_bins) {
    for (auto& values : lowest_) std::fill(values.begin(), values.end(), std::numeric_limits<float>::max());
    for (Eigen::Index row = 0; row < padded_.rows(); ++row) {
      const double age_s = histogram_.times_s[row] - histogram_.times_s.back();
      Insert(RowReader(padded_, row, first_column_, shift_bins + bins_per_s * age_s));
    }
    return std::accumulate(lowest_[kRank].begin(), lowest_[kRank].end(), 0.0F);
  }

  /// One step of an insertion sort that keeps the kRank + 1 lowest, for all bins side by side.
  void Insert(const RowReader& reader) {
    const int count = static_cast<int>(lowest_[0].size());
    std::array<float*, kRank + 1> lowest;
    for (int rank = 0; rank <= kRank; ++rank) lowest[rank] = lowest_[rank].data();
    for (int i = 0; i < count; ++i) {
      float value = reader[i];
      for (int rank = 0; rank <= kRank; ++rank) {
        const float other = lowest[rank][i];
        lowest[rank][i] = std::min(other, value);
        value = std::max(other, value);
      }
    }
  }

  const MotionHistogram& histogram_;
  Matrix padded_;
  int first_column_ = 0;
  std::array<std::vector<float>, kRank + 1> lowest_;
};

/// Where the parabola through three neighbouring values peaks, in steps from the middle one.
double ParabolaPeak(double left, double middle, double right) {
  const double curvature = left - 2 * middle + right;
  return curvature < 0 ? std::clamp(0.5 * (left - right) / curvature, -0.5, 0.5) : 0.0;
}

/// The largest of a function of the velocity over all slopes, if it is positive.
template <class Function>
LineIntegral Largest(const MotionHistogram& histogram, double cluster_weight, Function&& function) {
  const Slopes slopes(histogram);
  std::vector<double> values;
  for (int slope = -slopes.half_count; slope <= slopes.half_count; ++slope) {
    values.push_back(function(slope * slopes.step_mps));
  }
  const auto peak = std::max_element(values.begin(), values.end());
  if (!(*peak > 0)) return {};
  const auto index = static_cast<int>(peak - values.begin());
  double offset = 0;
  if (index > 0 && index < 2 * slopes.half_count) offset = ParabolaPeak(peak[-1], peak[0], peak[1]);
  return {*peak, *peak / cluster_weight, (index - slopes.half_count + offset) * slopes.step_mps};
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
  if (histogram.weights.rows() < kMotionHistogramRows || !(histogram.DurationS() > 0)) return {};
  ExtentLines<3> lines(histogram, Padded(WithoutMedians(histogram.weights), Margin(histogram)), extent);
  return Largest(histogram, cluster_weight, [&](double velocity_mps) { return lines.Along(velocity_mps); });
}

LineIntegral GainOverRest(const MotionHistogram& histogram, const ClusterExtent& extent,
                          double cluster_weight) {
  ORBSLAM_CHECK(cluster_weight > 0);
  if (histogram.weights.rows() < kMotionHistogramRows || !(histogram.DurationS() > 0)) return {};
  ExtentLines<1> lines(histogram, Smoothed(Padded(histogram.weights, Margin(histogram))), extent);
  const double rest_here = lines.AtRest(0);
  return Largest(histogram, cluster_weight, [&](double velocity_mps) {
    const double along = lines.Along(velocity_mps);
    return along <= rest_here ? along - rest_here : along - std::max(rest_here, lines.AtRest(velocity_mps));
  });
}

ClusterMotion FindClusterMotion(std::span<const HistogramRow> rows, std::span<const Eigen::Vector3f> points_m,
                                std::span<const Eigen::Vector3f> directions, float max_speed_mps) {
  ClusterMotion best;
  const double cluster_weight = SurfaceWeight(points_m);
  const MotionBall ball = BallAroundCluster(points_m);
  for (const Eigen::Vector3f& direction : directions) {
    const SweptVolume volume{ball, direction, max_speed_mps};
    const MotionHistogram histogram = BuildMotionHistogram(rows, volume);
    const ClusterExtent extent = ExtentAlong(points_m, volume);
    const LineIntegral line = PersistentLineIntegral(histogram, extent, cluster_weight);
    const LineIntegral gain = GainOverRest(histogram, extent, cluster_weight);
    if (std::pair(line.ratio, gain.ratio) <= std::pair(best.ratio, best.gain_ratio)) continue;
    const double velocity_mps = gain.ratio > 0 ? gain.velocity_mps : line.velocity_mps;
    best = {static_cast<float>(velocity_mps) * direction, direction, line.ratio, gain.ratio};
  }
  return best;
}

}  // namespace orbslam
