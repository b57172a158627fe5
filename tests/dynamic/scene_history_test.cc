// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_history.h"

#include <gmock/gmock.h>

#include "hindsight.h"
#include "normals.h"
#include "orbslam/camera/depth_model.h"
#include "orbslam/geometry/so3.h"
#include "orbslam/util/random.h"

namespace orbslam {
namespace {

constexpr GridCamera kCamera{160, 120, 130, 130, 79.5f, 59.5f};
constexpr float kWallM = 2.5f;
const cv::Rect kThing(60, 40, 30, 30);

/// A wall, and a thing before it at thing_m (0: none), with the sensor's noise. Nothing is measured in blind.
std::shared_ptr<const WorkingFrame> Frame(float thing_m, uint64_t seed, const cv::Rect& blind = {}) {
  auto frame = std::make_shared<WorkingFrame>();
  frame->depth_m = cv::Mat1f(kCamera.height, kCamera.width, kWallM);
  if (thing_m > 0) frame->depth_m(kThing).setTo(thing_m);
  Rng rng(seed);
  for (float& z : frame->depth_m) z += static_cast<float>(rng.Gaussian() * DepthModel::SigmaM(z));
  frame->depth_m(blind).setTo(0);
  return frame;
}

ReferenceView View(std::shared_ptr<const WorkingFrame> frame) {
  ReferenceView view;
  view.envelope_m = MakeEnvelope(frame->depth_m);
  view.moving = cv::Mat1b::zeros(frame->depth_m.size());
  view.frame = std::move(frame);
  return view;
}

double Share(const cv::Mat1b& cells, const cv::Rect& where) {
  return cv::countNonZero(cells(where)) / static_cast<double>(where.area());
}

cv::Mat1b Gone(const ReferenceView& past, std::shared_ptr<const WorkingFrame> present) {
  return GoneSince(kCamera, past, View(std::move(present)), {}, {});
}

TEST(GoneSince, IsWhatStoodWhereThePresentSeesThroughAndNothingElse) {
  const cv::Mat1b gone = Gone(View(Frame(1.5f, 1)), Frame(0, 2));
  EXPECT_GT(Share(gone, kThing), 0.97);
  const int around = 2;
  EXPECT_LE(cv::countNonZero(gone), (kThing.width + 2 * around) * (kThing.height + 2 * around));
}

TEST(GoneSince, IsNothingWhereAllIsAsItWas) {
  EXPECT_EQ(cv::countNonZero(Gone(View(Frame(1.5f, 1)), Frame(1.5f, 2))), 0);
  EXPECT_EQ(cv::countNonZero(Gone(View(Frame(0, 1)), Frame(0, 2))), 0);
}

TEST(GoneSince, IsNothingThatIsOnlyHiddenNow) {
  EXPECT_EQ(cv::countNonZero(Gone(View(Frame(0, 1)), Frame(1.5f, 2))), 0);
  EXPECT_EQ(cv::countNonZero(Gone(View(Frame(1.5f, 1)), Frame(0.8f, 2))), 0);
}

/// A person has stood half before a monitor, whose depth nobody measures.
TEST(GoneSince, TakesAlongWhatNobodyCanSeeThrough) {
  const cv::Rect monitor(kThing.x, kThing.y, kThing.width, kThing.height / 2);
  EXPECT_GT(Share(Gone(View(Frame(1.5f, 1)), Frame(0, 2, monitor)), kThing), 0.97);
}

TEST(GoneSince, FollowsTheCamera) {
  ReferenceView past = View(Frame(1.5f, 1));
  past.reference_from_current.translation.z() = 0.5;  // the camera has come half a metre nearer to the wall
  auto nearer = std::make_shared<WorkingFrame>();
  nearer->depth_m = cv::Mat1f(kCamera.height, kCamera.width, kWallM - 0.5f);
  EXPECT_GT(Share(Gone(past, nearer), kThing), 0.97);
}

class SceneHistoryTest : public testing::Test {
 protected:
  void Show(const std::shared_ptr<const WorkingFrame>& frame, int num_frames) {
    for (int i = 0; i < num_frames; ++i) {
      history_.Add(frame, cv::Mat1b(frame->depth_m.size(), uint8_t{0}), nullptr);
      history_.Advance({}, {});
    }
  }
  /// Of the keyframes, youngest first.
  std::vector<int> Ages() const {
    std::vector<int> ages;
    for (const ReferenceView* view : history_.FreeSpaceReferences())
      if (view != history_.Back(2) && view != history_.Back(4)) ages.push_back(view->age_frames);
    return ages;
  }

  ReferenceOptions options_;
  SceneHistory history_{kCamera, options_, 0};
};

TEST_F(SceneHistoryTest, KeepsFewKeyFramesWhoseAgesGrowInProportion) {
  const auto frame = Frame(0, 1);
  for (int i = 0; i < 100; ++i) {
    Show(frame, 10);
    const std::vector<int> ages = Ages();
    ASSERT_LE(std::ssize(ages), options_.max_keyframes);
    ASSERT_LE(ages.back(), options_.max_age_frames + options_.keyframe_interval);
    for (size_t k = 1; k < ages.size(); ++k) {
      ASSERT_LT(ages[k - 1], ages[k]);
      EXPECT_LE(ages[k], 3 * ages[k - 1]) << "after " << 10 * (i + 1) << " frames";
    }
    EXPECT_GE(ages.back(), std::min(10 * i, options_.max_age_frames / 2));
  }
}

TEST_F(SceneHistoryTest, LooksBackAtEachKeyFrameInTurn) {
  Show(Frame(1.5f, 1), 35);  // as keyframes are made: at once, then every ten frames
  Show(Frame(0, 2), 6);
  for (int i = 0; i < options_.max_keyframes; ++i) history_.LookBack({}, {});
  int num_marked = 0, num_others = 0;
  for (const ReferenceView* view : history_.FreeSpaceReferences()) {
    const bool shows_thing = view->frame->depth_m(kThing.y + 15, kThing.x + 15) < 2;
    const bool is_marked = Share(view->moving, kThing) > 0.97;
    EXPECT_EQ(shows_thing, is_marked) << view->age_frames;
    ++(is_marked ? num_marked : num_others);
  }
  EXPECT_EQ(num_marked, 4);
  EXPECT_GT(num_others, 0);
}

TEST_F(SceneHistoryTest, ForgetsHowTheCameraTurnedWithAllElse) {
  SceneHistory history(kCamera, options_, 0.026);
  const Eigen::Vector3d turn_rad(0.1, 0, 0);
  for (int i = 0; i < 2; ++i) {
    auto frame = std::make_shared<WorkingFrame>(*Frame(0, i));
    frame->timestamp_s = i / 30.0;
    ComputeNormals(kCamera, frame.get());
    if (i > 0) history.Advance({}, {So3Exp(turn_rad), Eigen::Vector3d::Zero()});
    if (i > 0) history.AlignKeyframes(*frame, false);
    history.Add(frame, cv::Mat1b(frame->depth_m.size(), uint8_t{0}), nullptr);
  }
  EXPECT_GT(history.Back(1)->angular_velocity_rad_s.norm(), 2);
  history.Clear();
  history.Add(Frame(0, 2), cv::Mat1b(kCamera.height, kCamera.width, uint8_t{0}), nullptr);
  EXPECT_EQ(history.Back(1)->angular_velocity_rad_s.norm(), 0);
}

/// Of a keyframe made while the camera turned at then_rad_s, against a frame at now_rad_s.
int HalfVotes(double readout_s, const Eigen::Vector3d& then_rad_s, const Eigen::Vector3d& now_rad_s) {
  constexpr double kIntervalS = 1 / 30.0;
  const ReferenceOptions options;
  SceneHistory history(kCamera, options, readout_s);
  const int age_frames = 6;
  for (int i = 0; i <= options.keyframe_interval + age_frames; ++i) {
    auto frame = std::make_shared<WorkingFrame>(*Frame(1.5f, i));
    frame->timestamp_s = i * kIntervalS;
    ComputeNormals(kCamera, frame.get());
    if (i > 0) {
      const Eigen::Vector3d rate_rad_s = i > options.keyframe_interval ? now_rad_s : then_rad_s;
      history.Advance({}, {So3Exp(rate_rad_s * kIntervalS), Eigen::Vector3d::Zero()});
      history.AlignKeyframes(*frame, false);
    }
    history.Add(frame, cv::Mat1b(frame->depth_m.size(), uint8_t{0}), nullptr);
  }
  for (const ReferenceView* view : history.FreeSpaceReferences())
    if (view->age_frames == age_frames) return view->half_votes;
  ADD_FAILURE() << "there is no keyframe of that age";
  return -1;
}

TEST(SceneHistory, AViewThatARollingShutterBentOtherwiseHasFewerVotes) {
  const Eigen::Vector3d down(1.2, 0, 0), left(0, 1.8, 0), still(0, 0, 0);
  const double kinect_s = 0.026;
  EXPECT_EQ(HalfVotes(kinect_s, down, down), 2);
  EXPECT_EQ(HalfVotes(kinect_s, down, still), 2);
  EXPECT_EQ(HalfVotes(kinect_s, down, -down), 1);
  EXPECT_EQ(HalfVotes(kinect_s, down, left), 1);
  EXPECT_EQ(HalfVotes(kinect_s, 2 * down, -2 * down), 0);
  EXPECT_EQ(HalfVotes(0, 2 * down, -2 * down), 2);
}

}  // namespace
}  // namespace orbslam
