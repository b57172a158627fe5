// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/tracking.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "orbslam/map/invariants.h"
#include "orbslam/pipeline/map_correction.h"
#include "orbslam/synthetic/synthetic_sequence.h"
#include "support/matchers.h"
#include "support/random.h"

namespace orbslam::test {
namespace {

SyntheticSequenceOptions Walk() {
  SyntheticSequenceOptions options;
  options.motion = Motion::kLoop;
  options.camera = SyntheticCamera();
  options.sensor.image_noise = options.sensor.depth_noise = true;
  return options;
}

/// Rendering takes most of the time, so that the tests share the pictures.
const SyntheticFrame& Picture(int index) {
  static const SyntheticSequence sequence(Walk());
  static std::map<int, SyntheticFrame> pictures;
  const auto found = pictures.find(index);
  return found != pictures.end() ? found->second : pictures[index] = sequence.Frame(index);
}

/// Root mean square after alignment (Sturm et al., IROS 2012, section V-B).
double AbsoluteTrajectoryErrorM(const Eigen::Matrix3Xd& truth, const Eigen::Matrix3Xd& estimate) {
  const Rigid3d truth_from_estimate = AlignPoints(truth, estimate);
  double sum_m2 = 0;
  for (int i = 0; i < truth.cols(); ++i) {
    sum_m2 += (truth_from_estimate * Eigen::Vector3d(estimate.col(i)) - truth.col(i)).squaredNorm();
  }
  return std::sqrt(sum_m2 / static_cast<double>(truth.cols()));
}

class TrackingTest : public testing::Test {
 protected:
  static constexpr double kMaxErrorM = 0.025;  // of one frame, by noisy depth

  FrameReport Show(Tracking* tracking, const cv::Mat& gray, const cv::Mat& depth_m) {
    RgbdImage image;
    image.id = FrameId(num_shown_);
    image.timestamp_s = num_shown_++ / SyntheticSequence::kFramesPerSecond;
    image.gray = gray;
    image.depth_m = depth_m;
    return tracking->Process(image);
  }
  FrameReport Show(int index, Tracking* tracking) {
    return Show(tracking, Picture(index).gray, Picture(index).depth_m);
  }
  FrameReport Show(int index) { return Show(index, &tracking_); }
  FrameReport ShowBlack() {
    return Show(&tracking_, cv::Mat::zeros(480, 640, CV_8UC1), cv::Mat::zeros(480, 640, CV_32FC1));
  }

  /// In the world of a map that was begun with picture 0.
  static Rigid3d Truth(int index) {
    return Inverse(Picture(0).world_from_camera) * Picture(index).world_from_camera;
  }
  static double ErrorM(const FrameReport& report, int index) {
    return (report.world_from_camera.value().translation - Truth(index).translation).norm();
  }
  void ExpectSound() const { EXPECT_THAT(FindBrokenInvariants(*map_.Read()), testing::IsEmpty()); }
  Tracking MakeTracking() {
    return {sensor_, orb_, TrackingOptions(), KeyFramePolicyOptions(), nullptr, &map_};
  }

  uint32_t num_shown_ = 0;
  const OrbExtractorOptions orb_;
  const Sensor sensor_{SyntheticCamera(), DepthModel(), orb_, SyntheticSequence::kFramesPerSecond};
  Map map_{MapData(sensor_.pyramid)};
  Tracking tracking_ = MakeTracking();
};

TEST_F(TrackingTest, FollowsTheCamera) {
  constexpr int kFrames = 120;
  Eigen::Matrix3Xd truth(3, kFrames), estimate(3, kFrames);
  int num_keyframes = 0;
  for (int i = 0; i < kFrames; ++i) {
    const FrameReport report = Show(i);
    ASSERT_EQ(report.state, TrackingState::kOk) << i;
    truth.col(i) = Truth(i).translation;
    estimate.col(i) = report.world_from_camera->translation;
    num_keyframes += report.new_keyframe.has_value();
    // The same pose, as trajectories are written.
    const Rigid3d reference_from_world = *map_.Read()->CameraFromWorld(report.reference);
    EXPECT_THAT(Inverse(report.camera_from_reference * reference_from_world),
                Rigid3dNear(*report.world_from_camera, 1e-9));
  }
  EXPECT_GT(truth.col(kFrames - 1).norm(), 0.5) << "the camera hardly moved";
  EXPECT_LT(AbsoluteTrajectoryErrorM(truth, estimate), 0.01);
  EXPECT_GE(num_keyframes, 2);
  EXPECT_EQ(map_.Read()->num_keyframes(), num_keyframes);
  ExpectSound();
}

TEST_F(TrackingTest, BeginsWithTheFirstFrameThatHasDepth) {
  for (int i = 0; i < 2; ++i) {
    const FrameReport report = Show(&tracking_, Picture(i).gray, cv::Mat::zeros(480, 640, CV_32FC1));
    EXPECT_EQ(report.state, TrackingState::kNotInitialized);
    EXPECT_FALSE(report.world_from_camera);
  }
  const FrameReport report = Show(0);
  EXPECT_EQ(report.state, TrackingState::kOk);
  EXPECT_TRUE(report.new_keyframe);
  EXPECT_THAT(report.world_from_camera.value(), Rigid3dNear(Rigid3d(), 0));
}

// The first camera is the world; of the later ones it is known to less than a centimetre.
TEST_F(TrackingTest, SaysHowWellEachPoseIsKnown) {
  EXPECT_FALSE(Show(0).pose_information.allFinite());
  for (int i = 1; i < 6; ++i) {
    const FrameReport report = Show(i);
    ASSERT_TRUE(report.pose_information.allFinite());
    const Matrix6d covariance = report.pose_information.inverse();
    EXPECT_GT(covariance.diagonal().minCoeff(), 0);
    EXPECT_LT(covariance.diagonal().tail<3>().maxCoeff(), 1e-4);
  }
}

TEST_F(TrackingTest, IsLostInTheDarkAndRecovers) {
  for (int i = 0; i < 15; ++i) Show(i);
  for (int i = 0; i < 4; ++i) {
    const FrameReport report = ShowBlack();
    EXPECT_EQ(report.state, TrackingState::kLost);
    EXPECT_FALSE(report.world_from_camera);
    EXPECT_FALSE(report.new_keyframe);
  }
  for (int i = 18; i < 25; ++i) {
    const FrameReport report = Show(i);
    ASSERT_EQ(report.state, TrackingState::kOk) << i;
    EXPECT_LT(ErrorM(report, i), kMaxErrorM);
  }
  ExpectSound();
}

TEST_F(TrackingTest, APlaceIsBelievedOnceTheCameraCanHaveGotThere) {
  constexpr double kMaxSpeedMps = 2;
  Tracking tracking(sensor_, orb_, {.max_speed_mps = kMaxSpeedMps}, KeyFramePolicyOptions(), nullptr, &map_);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(Show(i, &tracking).state, TrackingState::kOk) << i;
  Show(&tracking, cv::Mat::zeros(480, 640, CV_8UC1), cv::Mat::zeros(480, 640, CV_32FC1));
  const double needed_s = (Truth(99).translation - Truth(0).translation).norm() / kMaxSpeedMps;
  double elapsed_s = 0;
  FrameReport report;
  do {
    report = Show(0, &tracking);
    elapsed_s = (num_shown_ - 100) / SyntheticSequence::kFramesPerSecond;
  } while (report.state != TrackingState::kOk && elapsed_s < 3);
  EXPECT_GT(needed_s, 0.2) << "the camera hardly moved";
  EXPECT_NEAR(elapsed_s, needed_s, 0.05);
  EXPECT_LT(ErrorM(report, 0), kMaxErrorM);
}

TEST_F(TrackingTest, ACorrectionOfTheMapChangesNothingButTheFrameOfReference) {
  Rng rng(4);
  for (int i = 0; i < 12; ++i) Show(i);
  const Rigid3d new_from_old = RandomMotion(&rng);
  MapCorrection correction;
  for (const KeyFrame& keyframe : map_.Read()->KeyFrames()) {
    correction.camera_from_world[keyframe.id] = keyframe.camera_from_world * Inverse(new_from_old);
  }
  CorrectMap(correction, &*map_.Write());
  for (int i = 12; i < 20; ++i) {
    const FrameReport report = Show(i);
    ASSERT_EQ(report.state, TrackingState::kOk) << i;
    EXPECT_THAT(*report.world_from_camera, Rigid3dNear(new_from_old * Truth(i), kMaxErrorM, 0.02));
  }
  ExpectSound();
}

TEST_F(TrackingTest, DroppedFramesAreBridged) {
  for (int i = 0; i < 10; ++i) Show(i);
  for (int i = 10; i < 40; i += 3) {
    num_shown_ = static_cast<uint32_t>(i);
    const FrameReport report = Show(i);
    ASSERT_EQ(report.state, TrackingState::kOk) << i;
    EXPECT_LT(ErrorM(report, i), kMaxErrorM);
  }
}

TEST_F(TrackingTest, NoKeyFrameIsMadeWhereNoneIsAccepted) {
  Show(0);
  MapperLoad full;
  full.accepts_keyframe = false;
  for (int i = 1; i < 40; i += 3) {
    RgbdImage image;
    image.id = FrameId(static_cast<uint32_t>(i));
    image.timestamp_s = i / SyntheticSequence::kFramesPerSecond;
    image.gray = Picture(i).gray;
    image.depth_m = Picture(i).depth_m;
    EXPECT_FALSE(tracking_.Process(image, full).new_keyframe);
  }
  EXPECT_EQ(map_.Read()->num_keyframes(), 1);
}

TEST_F(TrackingTest, AKnownMapIsFoundAgainAndStaysAsItIsInLocalizationMode) {
  for (int i = 0; i < 30; ++i) Show(i);
  const int num_keyframes = map_.Read()->num_keyframes(), num_points = map_.Read()->num_points();
  Tracking later = MakeTracking();
  later.SetLocalizationMode(true);
  for (int i = 20; i < 30; ++i) {
    const FrameReport report = Show(i, &later);
    ASSERT_EQ(report.state, TrackingState::kOk) << i;
    EXPECT_LT(ErrorM(report, i), kMaxErrorM);
  }
  EXPECT_EQ(map_.Read()->num_keyframes(), num_keyframes);
  EXPECT_EQ(map_.Read()->num_points(), num_points);
}

}  // namespace
}  // namespace orbslam::test
