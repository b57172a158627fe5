// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/map/invariants.h"

#include <algorithm>
#include <map>

namespace orbslam {
namespace {

class Inspector {
 public:
  explicit Inspector(const MapData& map) : map_(map) {}

  std::vector<std::string> Run() {
    for (const MapPoint& point : map_.MapPoints()) InspectPoint(point);
    for (const KeyFrame& keyframe : map_.KeyFrames()) InspectKeyFrame(keyframe);
    InspectTree();
    Expect(std::ranges::distance(map_.KeyFrames()) == map_.num_keyframes(), "keyframes are miscounted");
    Expect(std::ranges::distance(map_.MapPoints()) == map_.num_points(), "points are miscounted");
    return std::move(broken_);
  }

 private:
  void Expect(bool holds, const std::string& what) {
    if (!holds) broken_.push_back(what);
  }
  static std::string Name(KeyFrameId id) { return "keyframe " + std::to_string(id.value); }
  static std::string Name(MapPointId id) { return "point " + std::to_string(id.value); }

  void InspectPoint(const MapPoint& point) {
    Expect(!point.observations.empty(), Name(point.id) + " is seen by nobody");
    Expect(std::ranges::is_sorted(point.observations, std::ranges::less_equal{}, &Observation::keyframe) ||
               point.observations.size() < 2,
           Name(point.id) + " has unsorted observations");
    for (const auto& [keyframe_id, keypoint] : point.observations) {
      const KeyFrame* keyframe = map_.Find(keyframe_id);
      Expect(keyframe != nullptr && keyframe->points[keypoint] == point.id,
             Name(point.id) + " claims an observation that " + Name(keyframe_id) + " does not know");
      for (const Observation& other : point.observations) {
        if (other.keyframe != keyframe_id) ++shared_[keyframe_id][other.keyframe];
      }
    }
  }

  void InspectKeyFrame(const KeyFrame& keyframe) {
    for (const MapPointId id : keyframe.points) {
      if (!id.IsValid()) continue;
      const MapPoint* point = map_.Find(id);
      Expect(point != nullptr, Name(keyframe.id) + " sees erased " + Name(id));
      if (point == nullptr) continue;
      Expect(std::ranges::count(point->observations, keyframe.id, &Observation::keyframe) == 1,
             Name(keyframe.id) + " and " + Name(id) + " disagree");
      Expect(std::ranges::count(keyframe.points, id) == 1,
             Name(keyframe.id) + " sees " + Name(id) + " twice");
    }
    std::vector<Covisible> recounted;
    for (const auto& [other, count] : shared_[keyframe.id]) recounted.push_back({other, count});
    Expect(recounted == keyframe.covisibles, Name(keyframe.id) + " has wrong covisibility");
    for (const KeyFrameId other : keyframe.loop_edges) {
      const KeyFrame* partner = map_.Find(other);
      Expect(partner != nullptr && partner->loop_edges.contains(keyframe.id),
             Name(keyframe.id) + " has a one-sided loop edge");
    }
  }

  void InspectTree() {
    int num_roots = 0;
    for (const KeyFrame& keyframe : map_.KeyFrames()) {
      num_roots += !keyframe.parent.IsValid();
      const KeyFrame* parent = map_.Find(keyframe.parent);
      Expect(!keyframe.parent.IsValid() || (parent != nullptr && parent->children.contains(keyframe.id)),
             Name(keyframe.id) + " is no child of its parent");
      for (const KeyFrameId child : keyframe.children) {
        Expect(map_.Find(child) != nullptr && map_.Find(child)->parent == keyframe.id,
               Name(keyframe.id) + " is no parent of its child");
      }
      int depth = 0;
      for (const KeyFrame* k = &keyframe; k != nullptr && depth <= map_.num_keyframes(); ++depth) {
        k = map_.Find(k->parent);
      }
      Expect(depth <= map_.num_keyframes(), Name(keyframe.id) + " is its own ancestor");
    }
    Expect(num_roots <= 1, "the spanning tree has several roots");
  }

  const MapData& map_;
  std::map<KeyFrameId, std::map<KeyFrameId, int>> shared_;
  std::vector<std::string> broken_;
};

}  // namespace

std::vector<std::string> FindBrokenInvariants(const MapData& map) { return Inspector(map).Run(); }

}  // namespace orbslam
