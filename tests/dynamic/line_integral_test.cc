// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/line_integral.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "moving_scene.h"

namespace orbslam {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

MotionHistogram RandomHistogram(uint64_t seed) {
  Rng rng(seed);
  MotionHistogram histogram{
      .weights = MotionHistogram::Matrix::Zero(9, 31), .bin_m = 0.02F, .first_m = -0.3F};
  histogram.max_speed_mps = 1.0F;
  for (int i = 0; i < 9; ++i) histogram.times_s.push_back((i - 8) / 30.0 + (i < 8 ? 0.003 * (i % 3) : 0));
  for (int i = 0; i < histogram.weights.size(); ++i) {
    histogram.weights.data()[i] = static_cast<float>(rng.Uniform());
  }
  return histogram;
}

/// Weight met in a row by a line that goes through `bin` in the last row, linearly between bins; 0 outside.
double WeightMet(const MotionHistogram& histogram, int row, double bin, double velocity_mps) {
  const double position = bin + velocity_mps * histogram.times_s[row] / histogram.bin_m;
  const auto at = [&](double column) {
    return column < 0 || column >= static_cast<double>(histogram.weights.cols())
               ? 0.0
               : histogram.weights(row, static_cast<int>(column));
  };
  const double low = std::floor(position);
  return at(low) + (position - low) * (at(low + 1) - at(low));
}

TEST(PublishedLineIntegral, IsTheLargestOfAllLines) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const MotionHistogram histogram = RandomHistogram(seed);
    const LineIntegral found = PublishedLineIntegral(histogram, 2.0);
    const double duration_s = histogram.DurationS();
    double largest = 0;
    for (int step = -200; step <= 200; ++step) {
      const double velocity_mps = step * 0.5 * 0.02 / duration_s;
      if (std::abs(step) < 2 || std::abs(velocity_mps) > 1.0) continue;
      for (int bin = 0; bin < 31; ++bin) {
        double sum = 0;
        for (int row = 0; row < 9; ++row) sum += WeightMet(histogram, row, bin, velocity_mps);
        largest = std::max(largest, sum);
      }
    }
    EXPECT_NEAR(found.integral, largest, 1e-3);
    EXPECT_NEAR(found.ratio, largest / 2, 1e-3);
  }
}

TEST(GainOverRest, IsTheLargestOverAllVelocities) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    MotionHistogram histogram = RandomHistogram(seed);
    const LineIntegral found = GainOverRest(histogram, {-0.1F, 0.1F}, 2.0);
    MotionHistogram smoothed = histogram;  // binomially, with a bin that catches what leaves to either side
    smoothed.weights = MotionHistogram::Matrix::Zero(9, 33);
    for (int bin = 0; bin < 33; ++bin) {
      for (int offset = -1; offset <= 1; ++offset) {
        const int from = bin - 1 + offset;
        if (from < 0 || from > 30) continue;
        smoothed.weights.col(bin) += (offset == 0 ? 0.5F : 0.25F) * histogram.weights.col(from);
      }
    }
    const auto persists = [&](double velocity_mps, double shift_bins) {
      double sum = 0;
      for (int bin = 11; bin <= 21; ++bin) {
        std::vector<double> met;
        for (int row = 0; row < 9; ++row)
          met.push_back(WeightMet(smoothed, row, bin + shift_bins, velocity_mps));
        std::sort(met.begin(), met.end());
        sum += met[1];
      }
      return sum;
    };
    double largest = 0;
    const double step_mps = 0.5 * 0.02 / histogram.DurationS();
    for (int step = -200; step <= 200; ++step) {
      const double velocity_mps = step * step_mps;
      if (std::abs(velocity_mps) > 1.0) continue;
      const double rest = std::max(persists(0, 0), persists(0, -velocity_mps * histogram.DurationS() / 0.02));
      largest = std::max(largest, persists(velocity_mps, 0) - rest);
    }
    EXPECT_NEAR(found.integral, largest, 1e-3);
  }
}

TEST(PersistentLineIntegral, IsTheLargestOfWhatIsNotAlwaysThere) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    MotionHistogram histogram = RandomHistogram(seed);
    const LineIntegral found = PersistentLineIntegral(histogram, {-0.1F, 0.1F}, 2.0);
    for (int bin = 0; bin < 31; ++bin) {
      std::vector<float> column;
      for (int row = 0; row < 9; ++row) column.push_back(histogram.weights(row, bin));
      std::sort(column.begin(), column.end());
      histogram.weights.col(bin).array() -= column[4];
    }
    double largest = 0;
    const double step_mps = 0.5 * 0.02 / histogram.DurationS();
    for (int step = -200; step <= 200; ++step) {
      if (std::abs(step * step_mps) > 1.0) continue;
      double sum = 0;
      for (int bin = 10; bin <= 20; ++bin) {
        std::vector<double> met;
        for (int row = 0; row < 9; ++row) met.push_back(WeightMet(histogram, row, bin, step * step_mps));
        std::sort(met.begin(), met.end());
        sum += met[3];
      }
      largest = std::max(largest, sum);
    }
    EXPECT_NEAR(found.integral, largest, 1e-3);
  }
}

TEST(PersistentLineIntegral, TellsMoversFromThingsAtRest) {
  for (const double distance_m : {1.5, 3.0}) {
    for (const double dropout : {0.05, 0.4}) {
      const auto ratio = [&](double speed_mps) {
        const SceneAt scene = PersonBefore({0, 0, distance_m}, {0, 0, -speed_mps});
        return JudgeFirstBox(scene, 1, {}, dropout).persistent.ratio;
      };
      EXPECT_LT(ratio(0), 0.5 * kPersistentTau);
      EXPECT_GT(ratio(0.6), 2 * kPersistentTau);
      EXPECT_GT(ratio(1.2), 2 * kPersistentTau);
    }
  }
}

TEST(FindClusterMotion, TakesTheDirectionInWhichTheClusterMoves) {
  const Vector3d velocity_mps(0, 0, -0.9);
  std::vector<HistogramCloud> clouds(kMotionHistogramRows);
  std::vector<HistogramRow> rows;
  std::vector<Vector3f> cluster;
  for (int i = 0; i < kMotionHistogramRows; ++i) {
    Rng rng(1, static_cast<uint64_t>(i));
    const double time_s = (i - kMotionHistogramRows + 1) * kFramePeriodS;
    const SceneCloud cloud = Observe(PersonBefore({0, 0, 2}, velocity_mps)(time_s), &rng);
    clouds[i] = HistogramCloud(cloud.points_m);
    rows.push_back({&clouds[i], {}, time_s});
    cluster = cloud.Of(0);
  }
  const std::vector<Vector3f> axes{Vector3f::UnitX(), Vector3f::UnitY(), Vector3f::UnitZ()};
  const ClusterMotion motion = FindClusterMotion(rows, cluster, axes);
  EXPECT_EQ(motion.direction, Vector3f::UnitZ());
  EXPECT_GT(motion.ratio, kPersistentTau);
  EXPECT_LT((motion.velocity_mps - velocity_mps.cast<float>()).norm(), 0.1);
  EXPECT_EQ(FindClusterMotion(rows, cluster, {}).ratio, 0);
}

/// A static thing is static whatever the direction, the distance and the flicker of its pixels.
TEST(GainOverRest, AStaticThingDoesNotMove) {
  for (const double distance_m : {1.5, 3.0, 5.0}) {
    for (const double dropout : {0.05, 0.4}) {
      for (const Vector3f& direction : {Vector3f(1, 0, 0), Vector3f(0, 0, 1), Vector3f(0.6F, 0, 0.8F)}) {
        const auto scene = PersonBefore({0.3, 0, distance_m}, {0, 0, 0});
        EXPECT_LT(JudgeFirstBox(scene, 1, direction, dropout).gain.ratio, 0.25 * kPersistentTau);
      }
      const auto own_direction = JudgeFirstBox(PersonBefore({0, 0, distance_m}, {0, 0, 0}), 2, {}, dropout);
      EXPECT_LT(own_direction.gain.ratio, 0.25 * kPersistentTau);
    }
  }
}

TEST(GainOverRest, MeasuresTheVelocityAlongTheDirection) {
  for (const double speed_mps : {-1.2, -0.6, -0.3, 0.3, 0.6, 0.9, 1.2}) {
    for (const double distance_m : {2.0, 3.0}) {
      for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0, 0, 1), Vector3d(0.6, 0, 0.8)}) {
        const auto scene = PersonBefore({0, 0, distance_m}, speed_mps * direction);
        const LineIntegral line = JudgeFirstBox(scene, 3, direction.cast<float>()).gain;
        EXPECT_GT(line.ratio, kPersistentTau) << speed_mps << " along " << direction.transpose();
        EXPECT_NEAR(line.velocity_mps, speed_mps, 0.1) << distance_m << " along " << direction.transpose();
      }
    }
  }
}

TEST(GainOverRest, SeesMotionAtFiveMetres) {
  for (const double speed_mps : {0.6, 1.2}) {
    for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0, 0, -1)}) {
      const auto scene = PersonBefore({0, 0, 5}, speed_mps * direction);
      const LineIntegral line = JudgeFirstBox(scene, 4, direction.cast<float>()).gain;
      EXPECT_GT(line.ratio, kPersistentTau);
      EXPECT_NEAR(line.velocity_mps, speed_mps, 0.15);
    }
  }
}

/// V sees motion along the optical axis by itself; across it, a surface slides along itself.
TEST(GainOverRest, FollowsTheSingularVectorAlongTheOpticalAxis) {
  const auto judgement = JudgeFirstBox(PersonBefore({0, 0, 2}, {0, 0, -0.6}), 5);
  EXPECT_GT(judgement.gain.ratio, kPersistentTau);
  EXPECT_LT((judgement.VelocityMps() - Vector3f(0, 0, -0.6F)).norm(), 0.1);
}

TEST(GainOverRest, SeesAMoverWhoseLowerHalfIsHidden) {
  const SceneAt scene = [](double time_s) {
    const SceneBox table{{0, 0.6, 1.5}, {2, 0.6, 0.1}};
    auto boxes = PersonBefore({0, 0, 2.2}, {0.6, 0, 0})(time_s);
    boxes.push_back(table);
    return boxes;
  };
  const LineIntegral line = JudgeFirstBox(scene, 6, Vector3f::UnitX()).gain;
  EXPECT_GT(line.ratio, kPersistentTau);
  EXPECT_NEAR(line.velocity_mps, 0.6, 0.1);
}

/// Someone in front walks off a static thing: more of it is seen in each frame, but it leaves no place.
TEST(GainOverRest, AThingThatIsUncoveredDoesNotMove) {
  for (const double half_width_m : {0.2, 0.35, 0.5, 1.0}) {
    const SceneAt scene = [=](double time_s) {
      const SceneBox walker{{0.3 + 0.9 * time_s, 0, 1.5}, {0.22, 0.6, 0.12}};
      return std::vector<SceneBox>{{{0, 0, 2.5}, {half_width_m, 0.6, 0.2}}, walker, {{0, 0, 4}, {6, 4, 0.1}}};
    };
    EXPECT_LT(JudgeFirstBox(scene, 1, Vector3f::UnitX()).gain.ratio, kPersistentTau) << half_width_m;
  }
}

/// The strip of a wall that has just come out from behind someone: news, and no motion.
TEST(GainOverRest, ANewlySeenPartOfAWallDoesNotMove) {
  const SceneAt scene = [](double time_s) {
    const SceneBox walker{{0.4 + 0.9 * time_s, 0, 1.5}, {0.22, 0.6, 0.12}};
    const SceneBox strip{{0.05, 0, 2.6}, {0.1, 0.6, 0.1}};  // flush with the wall beside it
    const SceneBox wall{{-1.55, 0, 2.6}, {1.5, 0.6, 0.1}};
    return std::vector<SceneBox>{strip, wall, walker, {{0, 0, 4}, {6, 4, 0.1}}};
  };
  EXPECT_LT(JudgeFirstBox(scene, 9, Vector3f::UnitX()).gain.ratio, kPersistentTau);
}

/// Someone who walks into the picture moves, as far as he could be seen throughout the window.
TEST(GainOverRest, SeesAMoverWhoEntersTheView) {
  for (const double x_m : {-1.0, -0.9, -0.8, -0.7}) {
    const LineIntegral line =
        JudgeFirstBox(PersonBefore({x_m, 0, 2}, {0.9, 0, 0}), 7, Vector3f::UnitX()).gain;
    EXPECT_GT(line.ratio, kPersistentTau) << x_m;
    EXPECT_NEAR(line.velocity_mps, 0.9, 0.1) << x_m;
  }
}

/// Turning on the spot is not a translation: no velocity fits, and the integral stays small.
TEST(GainOverRest, DoesNotTakeARotationForAFastTranslation) {
  for (const double turn_rad_s : {0.5, 1.0, 2.0}) {
    const auto judgement = JudgeFirstBox(PersonBefore({0, 0, 2}, {0, 0, 0}, turn_rad_s), 8);
    EXPECT_LT(judgement.VelocityMps().norm(), 0.3);
    EXPECT_LT(judgement.gain.ratio, 0.2);
  }
}

TEST(LineIntegrals, AreZeroWithoutAWindow) {
  const MotionHistogram histogram{
      .weights = MotionHistogram::Matrix::Ones(1, 31), .times_s = {0}, .bin_m = 0.02F};
  EXPECT_EQ(PublishedLineIntegral(histogram, 1).integral, 0);
  EXPECT_EQ(PersistentLineIntegral(histogram, {}, 1).integral, 0);
  EXPECT_EQ(GainOverRest(histogram, {}, 1).integral, 0);
}

}  // namespace
}  // namespace orbslam
