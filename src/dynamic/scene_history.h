// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <vector>

#include "icp.h"
#include "orbslam/dynamic/dynamic_detector_options.h"
#include "reference_view.h"

namespace orbslam {

/// The frames of the past that the present one is judged against, each with its pose relative to the present:
/// the last few, and keyframes.
class SceneHistory {
 public:
  /// readout_s: of the camera's rolling shutter, see PinholeCamera.
  SceneHistory(const GridCamera& cell_camera, const ReferenceOptions& options, double readout_s)
      : camera_(cell_camera), options_(options), readout_s_(readout_s) {}

  /// The frame num_back before the one that is being processed; null: none.
  const ReferenceView* Back(int num_back) const;
  /// Carries all poses over to the frame now processed.
  void Advance(const Rigid3d& depth_previous_from_current, const Rigid3d& color_previous_from_current);
  /// Puts right what a view's pose is found to be, of the colour or the depth image, and the others' by as
  /// much.
  void CorrectColor(const ReferenceView& view, const Rigid3d& color_reference_from_current);
  void CorrectDepth(const ReferenceView& view, const Rigid3d& reference_from_current);
  /// Aligns each keyframe with the present frame; those that do not fit, or no longer overlap, are forgotten.
  /// is_depth_misled: something moves that depth takes for the room; its pull is made weak for a while.
  void AlignKeyframes(const WorkingFrame& current, bool is_depth_misled);
  /// The aligned keyframe whose age is nearest, and at least half of that; null: none.
  const ReferenceView* KeyframeOfAge(int age_frames) const;
  /// t-2, t-4 and the keyframes.
  std::vector<const ReferenceView*> FreeSpaceReferences() const;
  /// moving: its cells that were masked. cloud: for the motion histogram, may be null.
  void Add(std::shared_ptr<const WorkingFrame> frame, const cv::Mat1b& moving,
           std::shared_ptr<const HistogramCloud> cloud);
  /// Marks in one of the keyframes, each in its turn, what the last frame added shows to have gone since.
  void LookBack(const FreeSpaceOptions& free_space, const SegmentationOptions& segmentation);
  void Clear();

 private:
  void Correct(Rigid3d ReferenceView::*pose, const ReferenceView& view, const Rigid3d& corrected);
  /// Drops one: the oldest if it is too old, else that whose neighbours' ages are most alike, so that ages
  /// come to grow geometrically.
  void ThinKeyframes();
  /// Gives each view the fewer votes the more a rolling shutter bent it against the present frame.
  void WeighByBend();

  GridCamera camera_;
  ReferenceOptions options_;
  double readout_s_;
  std::deque<ReferenceView> recent_;  // youngest first
  std::deque<ReferenceView> keyframes_;
  int frames_since_misled_ = 1 << 20;
  int frames_since_keyframe_ = 1 << 20;
  size_t looked_back_at_ = 0;  // index of a keyframe
  Eigen::Vector3d turn_rad_ = Eigen::Vector3d::Zero();  // from the last frame to the present, in its frame
  Eigen::Vector3d angular_velocity_rad_s_ = Eigen::Vector3d::Zero();
};

}  // namespace orbslam
