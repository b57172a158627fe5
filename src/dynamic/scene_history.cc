// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_history.h"

#include <algorithm>
#include <limits>

#include "hindsight.h"
#include "orbslam/geometry/so3.h"

namespace orbslam {

const ReferenceView* SceneHistory::Back(int num_back) const {
  const auto index = static_cast<size_t>(num_back - 1);
  return index < recent_.size() ? &recent_[index] : nullptr;
}

void SceneHistory::Advance(const Rigid3d& depth_previous_from_current,
                           const Rigid3d& color_previous_from_current) {
  turn_rad_ = So3Log(Inverse(color_previous_from_current).rotation);
  for (auto* views : {&recent_, &keyframes_})
    for (ReferenceView& view : *views) {
      view.reference_from_current = view.reference_from_current * depth_previous_from_current;
      view.color_reference_from_current = view.color_reference_from_current * color_previous_from_current;
      ++view.age_frames;
    }
}

void SceneHistory::CorrectColor(const ReferenceView& view, const Rigid3d& color_reference_from_current) {
  Correct(&ReferenceView::color_reference_from_current, view, color_reference_from_current);
}

void SceneHistory::CorrectDepth(const ReferenceView& view, const Rigid3d& reference_from_current) {
  Correct(&ReferenceView::reference_from_current, view, reference_from_current);
}

void SceneHistory::Correct(Rigid3d ReferenceView::*pose, const ReferenceView& view,
                           const Rigid3d& corrected) {
  const Rigid3d correction = Inverse(view.*pose) * corrected;
  for (auto* views : {&recent_, &keyframes_})
    for (ReferenceView& other : *views) other.*pose = other.*pose * correction;
}

void SceneHistory::AlignKeyframes(const WorkingFrame& current, bool is_depth_misled) {
  if (const double interval_s = current.timestamp_s - recent_.front().frame->timestamp_s; interval_s > 0)
    angular_velocity_rad_s_ = turn_rad_ / interval_s;
  WeighByBend();
  frames_since_misled_ = is_depth_misled ? 0 : frames_since_misled_ + 1;
  IcpOptions icp;
  icp.stride = options_.stride, icp.iterations = options_.iterations;
  icp.prior_translation_m = options_.prior_translation_m,
  icp.prior_rotation_rad = options_.prior_rotation_rad;
  if (frames_since_misled_ < options_.doubtful_frames) icp.independent_share = options_.doubtful_share;
  for (ReferenceView& view : keyframes_) {
    const IcpTarget target{view.frame.get(), &view.moving, {}};
    const IcpResult result =
        AlignDepth(camera_, current, nullptr, {&target, 1}, view.reference_from_current,
                   IsotropicInformation(options_.prior_rotation_rad, options_.prior_translation_m), icp);
    view.is_aligned = result.num_pairs >= options_.min_pairs && result.FitShare() >= options_.min_fit_share;
    view.frames_unaligned = view.is_aligned ? 0 : view.frames_unaligned + 1;
    if (view.is_aligned) view.reference_from_current = result.base_from_source;
  }
  std::erase_if(keyframes_,
                [&](const ReferenceView& view) { return view.frames_unaligned > options_.max_unaligned; });
}

void SceneHistory::WeighByBend() {
  for (auto* views : {&recent_, &keyframes_})
    for (ReferenceView& view : *views) {
      const double difference_rad_s = (view.angular_velocity_rad_s - angular_velocity_rad_s_).norm();
      // By so much the first and the last line are off if those in the middle fit.
      const double bend_rad = difference_rad_s * readout_s_ / 2;
      view.half_votes = 2 - static_cast<int>(std::min(bend_rad / options_.max_bend_rad, 2.0));
    }
}

const ReferenceView* SceneHistory::KeyframeOfAge(int age_frames) const {
  const ReferenceView* nearest = nullptr;
  const auto distance = [&](const ReferenceView& view) { return std::abs(view.age_frames - age_frames); };
  for (const ReferenceView& view : keyframes_)
    if (view.is_aligned && 2 * view.age_frames >= age_frames &&
        (nearest == nullptr || distance(view) < distance(*nearest)))
      nearest = &view;
  return nearest;
}

std::vector<const ReferenceView*> SceneHistory::FreeSpaceReferences() const {
  std::vector<const ReferenceView*> references;
  for (const int num_back : {2, 4})
    if (const ReferenceView* view = Back(num_back)) references.push_back(view);
  for (const ReferenceView& view : keyframes_)
    if (view.age_frames > 4 && view.is_aligned) references.push_back(&view);
  return references;
}

void SceneHistory::Add(std::shared_ptr<const WorkingFrame> frame, const cv::Mat1b& moving,
                       std::shared_ptr<const HistogramCloud> cloud) {
  ReferenceView view;
  view.envelope_m = MakeEnvelope(frame->depth_m);
  view.filled_depth_m = FillHoles(frame->depth_m);
  view.frame = std::move(frame);
  view.moving = moving;
  view.angular_velocity_rad_s = angular_velocity_rad_s_;
  view.cloud = std::move(cloud);
  recent_.push_front(view);
  if (static_cast<int>(recent_.size()) > options_.num_recent) recent_.pop_back();
  if (options_.max_keyframes > 0 && ++frames_since_keyframe_ >= options_.keyframe_interval) {
    keyframes_.push_front(std::move(view));
    keyframes_.front().cloud = nullptr;
    if (static_cast<int>(keyframes_.size()) > options_.max_keyframes) ThinKeyframes();
    frames_since_keyframe_ = 0;
  }
}

void SceneHistory::LookBack(const FreeSpaceOptions& free_space, const SegmentationOptions& segmentation) {
  if (keyframes_.empty()) return;
  looked_back_at_ = (looked_back_at_ + 1) % keyframes_.size();
  ReferenceView& past = keyframes_[looked_back_at_];
  if (!past.is_aligned || past.age_frames == 0) return;
  past.moving = past.moving | GoneSince(camera_, past, recent_.front(), free_space, segmentation);
}

void SceneHistory::ThinKeyframes() {
  size_t dropped = keyframes_.size() - 1;
  if (keyframes_.back().age_frames < options_.max_age_frames) {
    double closest = std::numeric_limits<double>::infinity();
    for (size_t i = 1; i + 1 < keyframes_.size(); ++i) {
      const double ratio = (keyframes_[i + 1].age_frames + 1.0) / (keyframes_[i - 1].age_frames + 1.0);
      if (ratio < closest) closest = ratio, dropped = i;
    }
  }
  keyframes_.erase(keyframes_.begin() + static_cast<std::ptrdiff_t>(dropped));
}

void SceneHistory::Clear() {
  recent_.clear(), keyframes_.clear();
  frames_since_keyframe_ = 1 << 20;
  looked_back_at_ = 0;
  angular_velocity_rad_s_.setZero();
}

}  // namespace orbslam
