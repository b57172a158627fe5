// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/motion_model.h"

#include <gtest/gtest.h>

#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

#include "support/matchers.h"
#include "support/random.h"

namespace orbslam::test {
namespace {

/// Where a camera is after dt_s at constant angular and linear velocity in its own frame: exp of the twist,
/// by Eigen's general matrix exponential.
Rigid3d Travelled(const Eigen::Vector3d& angular, const Eigen::Vector3d& linear, double dt_s) {
  Eigen::Matrix4d twist = Eigen::Matrix4d::Zero();
  twist.topLeftCorner<3, 3>() = CrossMatrix(angular);
  twist.topRightCorner<3, 1>() = linear;
  const Eigen::Matrix4d motion = (dt_s * twist).exp();
  return {Eigen::Quaterniond(motion.topLeftCorner<3, 3>()), motion.topRightCorner<3, 1>()};
}

class MotionModelTest : public testing::Test {
 protected:
  Rng rng_{21};
  MotionModel model_;
};

TEST_F(MotionModelTest, ConstantTwistIsPredictedExactlyWhateverTheTimeStamps) {
  for (int run = 0; run < 20; ++run) {
    const Eigen::Vector3d angular = RandomVector(&rng_, 1), linear = RandomVector(&rng_, 1);
    const Rigid3d start = RandomMotion(&rng_);
    double last_s = 0, now_s = 0;
    const auto pose_at = [&](double t_s) { return Travelled(angular, linear, t_s) * start; };
    for (int i = 0; i < 20; ++i) {
      last_s = std::exchange(now_s, now_s + rng_.Uniform(0.01, 0.3));
      model_.Update(last_s, pose_at(last_s), now_s, pose_at(now_s));
      const double dt_s = rng_.Uniform(0.01, 0.3);
      EXPECT_THAT(model_.Predict(pose_at(now_s), dt_s), Rigid3dNear(pose_at(now_s + dt_s), 1e-11));
    }
  }
}

TEST_F(MotionModelTest, RestsUntilAVelocityIsKnownAndAfterItIsForgotten) {
  const Rigid3d pose = RandomMotion(&rng_);
  EXPECT_FALSE(model_.IsKnown());
  EXPECT_THAT(model_.Predict(pose, 0.1), Rigid3dNear(pose, 0.0));
  model_.Update(0, RandomMotion(&rng_), 0.1, pose);
  EXPECT_TRUE(model_.IsKnown());
  EXPECT_THAT(model_.Predict(pose, 0.1), testing::Not(Rigid3dNear(pose, 1e-3)));
  model_.Forget();
  EXPECT_THAT(model_.Predict(pose, 0.1), Rigid3dNear(pose, 0.0));
}

TEST_F(MotionModelTest, TimeThatStandsStillOrRunsBackForgetsTheVelocity) {
  for (const double now_s : {5.0, 4.9}) {
    model_.Update(0, RandomMotion(&rng_), 1, RandomMotion(&rng_));
    model_.Update(5, RandomMotion(&rng_), now_s, RandomMotion(&rng_));
    EXPECT_FALSE(model_.IsKnown()) << now_s;
  }
}

TEST_F(MotionModelTest, NoTimeNoMotion) {
  const Rigid3d pose = RandomMotion(&rng_);
  model_.Update(0, RandomMotion(&rng_), 0.1, pose);
  EXPECT_THAT(model_.Predict(pose, 0), Rigid3dNear(pose, 1e-14));
}

}  // namespace
}  // namespace orbslam::test
