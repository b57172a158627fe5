// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "orbslam/io/trajectory.h"
#include "orbslam/synthetic/synthetic_sequence.h"
#include "orbslam/system/system.h"
#include "orbslam/vocabulary/vocabulary_file.h"
#include "support/matchers.h"

namespace orbslam::test {

/// Part of a synthetic sequence, every `stride`-th frame, made once.
class Recording {
 public:
  Recording(Motion motion, int width, int num_frames, int stride = 1) : camera_(SyntheticCamera(width)) {
    const SyntheticSequence sequence({.motion = motion,
                                      .num_frames = num_frames * stride,
                                      .camera = camera_,
                                      .sensor = {.depth_noise = true, .image_noise = true},
                                      .texels_per_metre = width > 320 ? 256.0 : 128.0});
    for (int i = 0; i < sequence.size(); i += stride) frames_.push_back(sequence.Frame(i));
  }

  int size() const { return static_cast<int>(frames_.size()); }
  const PinholeCamera& camera() const { return camera_; }
  const SyntheticFrame& operator[](int i) const { return frames_.at(i); }
  RgbdImage Image(int i) const { return ImageAt(i, frames_.at(i).timestamp_s); }
  /// As if it had been taken at another time.
  RgbdImage ImageAt(int i, double timestamp_s) const {
    return {.timestamp_s = timestamp_s, .gray = frames_.at(i).gray, .depth_m = frames_.at(i).depth_m};
  }

 private:
  PinholeCamera camera_;
  std::vector<SyntheticFrame> frames_;
};

/// A black picture without depth.
inline RgbdImage BlackImage(const PinholeCamera& camera, double timestamp_s) {
  return {.timestamp_s = timestamp_s,
          .gray = cv::Mat::zeros(camera.height, camera.width, CV_8UC1),
          .depth_m = cv::Mat::zeros(camera.height, camera.width, CV_32FC1)};
}

inline Settings SettingsFor(const PinholeCamera& camera, int num_features) {
  Settings settings;
  settings.camera = camera;
  settings.depth.baseline_times_fx = 0.075 * camera.fx;
  settings.orb.num_features = num_features;
  return settings;
}

inline std::shared_ptr<const Vocabulary> ShippedVocabulary() {
  static const auto vocabulary =
      std::make_shared<const Vocabulary>(ReadVocabulary(ORBSLAM_SHIPPED_VOCABULARY).value());
  return vocabulary;
}

/// Root mean square distance of camera centres, metres, after the rigid motion that fits best.
inline double AteM(const std::vector<Rigid3d>& estimates, const std::vector<Rigid3d>& truths) {
  Eigen::Matrix3Xd from(3, estimates.size()), to(3, truths.size());
  for (Eigen::Index i = 0; i < from.cols(); ++i) {
    from.col(i) = estimates[i].translation;
    to.col(i) = truths[i].translation;
  }
  const Eigen::Matrix4d to_from = Eigen::umeyama(from, to, /*with_scaling=*/false);
  const Eigen::Matrix3Xd moved =
      (to_from.topLeftCorner<3, 3>() * from).colwise() + to_from.topRightCorner<3, 1>();
  return std::sqrt((moved - to).colwise().squaredNorm().mean());
}

/// A saved trajectory against the recording that it was made from; poses are matched by time.
inline double AteM(const std::string& path, const Recording& recording) {
  std::map<int64_t, Rigid3d> truth_at;  // by microseconds
  const auto microseconds = [](double s) { return std::llround(s * 1e6); };
  for (int i = 0; i < recording.size(); ++i) {
    truth_at[microseconds(recording[i].timestamp_s)] = recording[i].world_from_camera;
  }
  std::vector<Rigid3d> estimates, truths;
  const auto trajectory = ReadTrajectory(path);
  EXPECT_TRUE(trajectory.ok());
  for (const StampedPose& pose : *trajectory) {
    estimates.push_back(pose.world_from_camera);
    truths.push_back(truth_at.at(microseconds(std::stod(pose.timestamp_text))));
  }
  return AteM(estimates, truths);
}

/// Tracks frames first .. last-1; returns how many have a pose.
inline int TrackFrames(const Recording& recording, int first, int last, System* system) {
  int num_tracked = 0;
  for (int i = first; i < last; ++i) {
    num_tracked += system->TrackRgbd(recording.Image(i)).state == TrackingState::kOk;
  }
  return num_tracked;
}

}  // namespace orbslam::test
