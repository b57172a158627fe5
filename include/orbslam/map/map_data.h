// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <ranges>
#include <vector>

#include "orbslam/features/scale_pyramid.h"
#include "orbslam/map/keyframe.h"
#include "orbslam/map/map_point.h"
#include "orbslam/util/result.h"

namespace orbslam {

struct MapState;

namespace internal {

/// References to what has not been erased. Vector may be const or not.
template <class Vector>
auto Living(Vector& all) {
  return all | std::views::filter([](const auto& item) { return item != nullptr; }) |
         std::views::transform([](auto& item) -> auto& {
           using Item = std::remove_reference_t<decltype(*item)>;
           return static_cast<std::conditional_t<std::is_const_v<Vector>, const Item&, Item&>>(*item);
         });
}

}  // namespace internal

/// Keyframes, map points and their cross references, all by id. Owns everything; knows nothing of threads
/// (see Map). Every edit keeps the invariants of invariants.h: observations are mutual, covisibility weights
/// are exact, the spanning tree is a tree.
class MapData {
 public:
  explicit MapData(const ScalePyramid& pyramid) : pyramid_(pyramid) {}

  /// A map that equals the one whose Export() this is, and goes on with the ids where that stopped. Error:
  /// the state contradicts itself; any content is safe to try, also one made up to do harm.
  static Result<MapData> FromState(MapState state);
  MapState Export() const;

  // --- Keyframes ---
  KeyFrameId AddKeyFrame(FrameId frame, double timestamp_s, const Rigid3d& camera_from_world,
                         std::shared_ptr<const FrameFeatures> features);
  /// nullptr: erased or never there.
  const KeyFrame* Find(KeyFrameId id) const;
  KeyFrame* Find(KeyFrameId id);
  /// Hangs it below the covisible it shares most points with; without any, below `fallback`.
  void ConnectToSpanningTree(KeyFrameId id, KeyFrameId fallback);
  /// Its children move to the best covisible that is no descendant of theirs. The root and keyframes with
  /// loop edges stay: false. Points that lose their last observation are erased.
  bool EraseKeyFrame(KeyFrameId id);
  void AddLoopEdge(KeyFrameId a, KeyFrameId b);
  /// The keyframe itself, or if it was erased its nearest living ancestor; invalid: never there.
  KeyFrameId Resolve(KeyFrameId id) const;
  /// Pose of any keyframe that ever was: erased ones follow their parent. nullopt: never there.
  std::optional<Rigid3d> CameraFromWorld(KeyFrameId id) const;

  // --- Points ---
  MapPointId AddMapPoint(const Eigen::Vector3d& position_world, KeyFrameId created_by);
  const MapPoint* Find(MapPointId id) const;
  MapPoint* Find(MapPointId id);
  /// The point that a fused id stands for today; invalid if it is gone.
  MapPointId Resolve(MapPointId id) const;
  void EraseMapPoint(MapPointId id);
  /// `from` becomes `into`: observations move over (where a keyframe sees both, into's keypoint stays).
  void FuseMapPoint(MapPointId from, MapPointId into);
  /// Recomputes normal, distance range and descriptor from the observations. To be called after they changed.
  void RefreshMapPoint(MapPointId id);

  // --- Observations ---
  /// Nothing happens if the keypoint is taken or the keyframe sees the point already: false.
  bool AddObservation(MapPointId point, KeyFrameId keyframe, int keypoint);
  /// Erases the point when nobody sees it any more.
  void RemoveObservation(MapPointId point, KeyFrameId keyframe);

  // --- Everything, ascending in id ---
  auto KeyFrames() const { return internal::Living(keyframes_); }
  auto MapPoints() const { return internal::Living(points_); }
  auto MutableKeyFrames() { return internal::Living(keyframes_); }
  auto MutableMapPoints() { return internal::Living(points_); }
  int num_keyframes() const { return num_keyframes_; }
  int num_points() const { return num_points_; }
  KeyFrameId last_keyframe_id() const { return KeyFrameId(static_cast<uint32_t>(keyframes_.size()) - 1); }
  const ScalePyramid& pyramid() const { return pyramid_; }

  /// Counts global corrections (loop closings, global bundle adjustments).
  uint64_t epoch() const { return epoch_; }
  void BumpEpoch() { ++epoch_; }

 private:
  void ChangeCovisibility(KeyFrameId a, KeyFrameId b, int delta);
  void RelinkKeyFrames();
  void RecountCovisibility();
  void ReparentChildren(KeyFrame& keyframe);
  bool IsAncestor(KeyFrameId ancestor, KeyFrameId descendant) const;

  ScalePyramid pyramid_;
  std::vector<std::unique_ptr<KeyFrame>> keyframes_;  // index: id
  std::vector<std::unique_ptr<MapPoint>> points_;     // index: id
  std::map<KeyFrameId, KeyFrameRemains> remains_;
  std::map<MapPointId, MapPointId> fused_into_;
  int num_keyframes_ = 0, num_points_ = 0;
  uint64_t epoch_ = 0;
};

}  // namespace orbslam
