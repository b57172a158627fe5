// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <vector>

#include "icp.h"
#include "reference_view.h"

namespace orbslam {

struct ReferenceOptions {
  int num_recent = 8;             // frames kept one by one
  int keyframe_interval = 10;     // frames: a person walks his own width in a third of a second
  int max_keyframes = 8;          // of the last 2.7 s
  double prior_translation_m = 0.01;    // standard deviations of a carried pose,
  double prior_rotation_rad = 0.010;    // before its own alignment
  int stride = 4, iterations = 3;       // of that alignment
  double min_fit_share = 0.5;     // of the paired points within 3 sigma; below, the reference is dropped
  int min_pairs = 60;             // ten for each unknown
};

/// The frames of the past that the present one is judged against, each with its pose relative to the present:
/// the last few, and keyframes.
class SceneHistory {
 public:
  SceneHistory(const GridCamera& cell_camera, const ReferenceOptions& options)
      : camera_(cell_camera), options_(options) {}

  /// The frame num_back before the one that is being processed; null: none.
  const ReferenceView* Back(int num_back) const;
  /// Carries all poses over to the frame now processed.
  void Advance(const Rigid3d& previous_from_current);
  /// Aligns each keyframe with the present frame; those that do not fit, or no longer overlap, are forgotten.
  void AlignKeyframes(const WorkingFrame& current, const cv::Mat1b* ignored);
  /// t-2, t-4 and the keyframes.
  std::vector<const ReferenceView*> FreeSpaceReferences() const;
  void Add(std::shared_ptr<const WorkingFrame> frame, const cv::Mat1b& moving);
  void Clear();

 private:
  GridCamera camera_;
  ReferenceOptions options_;
  std::deque<ReferenceView> recent_;  // youngest first
  std::deque<ReferenceView> keyframes_;
  int frames_since_keyframe_ = 1 << 20;
};

}  // namespace orbslam
