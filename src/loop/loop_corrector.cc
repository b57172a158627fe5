// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/loop/loop_corrector.h"

#include <limits>
#include <map>
#include <set>

#include "orbslam/optimization/pose_graph.h"
#include "orbslam/pipeline/map_correction.h"
#include "orbslam/pipeline/point_fusion.h"

namespace orbslam {
namespace {

/// Along the way several covisibility edges run side by side; the one edge of a loop would give way to them
/// and leave a sixth of the gap open.
constexpr double kLoopEdgeWeight = 30;

/// The essential graph, and which keyframe each node is.
struct EssentialGraph {
  PoseGraph graph;
  std::vector<KeyFrameId> keyframes;
};

/// Keyframes that move rigidly with the current one before the drift is spread.
std::set<KeyFrameId> Surroundings(const MapData& map, const LoopOptions& options, KeyFrameId current) {
  const auto neighbors =
      map.Find(current)->BestCovisibles(std::numeric_limits<int>::max(), options.min_shared_points);
  std::set<KeyFrameId> group(neighbors.begin(), neighbors.end());
  group.insert(current);
  return group;
}

/// Edges: spanning tree, earlier loops, strong covisibility, all as they are now; and the new loop.
EssentialGraph MakeEssentialGraph(const MapData& map, const LoopOptions& options, const Loop& loop) {
  EssentialGraph essential;
  std::map<KeyFrameId, int> node_of;
  const std::set<KeyFrameId> moved = Surroundings(map, options, loop.current);
  const Rigid3d& current_from_world = map.Find(loop.current)->camera_from_world;
  const Rigid3d corrected_current = loop.current_from_old * map.Find(loop.old)->camera_from_world;
  for (const KeyFrame& keyframe : map.KeyFrames()) {
    node_of[keyframe.id] = static_cast<int>(essential.keyframes.size());
    essential.keyframes.push_back(keyframe.id);
    const Rigid3d self_from_current = keyframe.camera_from_world * Inverse(current_from_world);
    const Rigid3d start =
        moved.contains(keyframe.id) ? self_from_current * corrected_current : keyframe.camera_from_world;
    essential.graph.nodes.push_back({start, !keyframe.parent.IsValid()});
  }
  std::set<std::pair<int, int>> present;
  const auto add = [&](KeyFrameId a, KeyFrameId b, const Rigid3d& b_from_a, double weight) {
    const int node_a = node_of.at(a), node_b = node_of.at(b);
    if (present.insert(std::minmax(node_a, node_b)).second) {
      essential.graph.edges.push_back({node_a, node_b, b_from_a, weight});
    }
  };
  add(loop.old, loop.current, loop.current_from_old, kLoopEdgeWeight);
  const auto add_measured = [&](const KeyFrame& a, KeyFrameId b, double weight = 1) {
    add(a.id, b, map.Find(b)->camera_from_world * Inverse(a.camera_from_world), weight);
  };
  for (const KeyFrame& keyframe : map.KeyFrames()) {
    if (keyframe.parent.IsValid()) add_measured(keyframe, keyframe.parent);
    for (const KeyFrameId other : keyframe.loop_edges) add_measured(keyframe, other, kLoopEdgeWeight);
    for (const Covisible& other : keyframe.covisibles) {
      if (other.num_shared_points >= options.min_edge_weight) add_measured(keyframe, other.keyframe);
    }
  }
  return essential;
}

/// The matches that confirmed the loop become observations; then the neighbourhood of the old place is looked
/// for in every keyframe that moved along.
void FuseBothSides(const LoopOptions& options, const Sensor& sensor, const Loop& loop, Map* map) {
  std::set<KeyFrameId> group;
  std::set<MapPointId> points;
  {
    const auto guard = map->Write();
    for (const auto& [keypoint, point] : loop.points) {
      const MapPointId id = guard->Resolve(point);
      const MapPointId present = guard->Find(loop.current)->points[keypoint];
      if (!id.IsValid() || present == id) continue;
      if (present.IsValid()) {
        guard->FuseMapPoint(present, id);
      } else if (guard->AddObservation(id, loop.current, keypoint)) {
        guard->RefreshMapPoint(id);
      }
    }
    group = Surroundings(*guard, options, loop.current);
    for (const KeyFrameId id : Surroundings(*guard, options, loop.old)) {
      for (const MapPointId point : guard->Find(id)->points) {
        if (point.IsValid()) points.insert(point);
      }
    }
  }
  const std::vector<MapPointId> list(points.begin(), points.end());
  for (const KeyFrameId id : group) FusePoints(sensor, id, list, options.fusion_radius_px, map);
}

}  // namespace

bool CloseLoop(const LoopOptions& options, const Sensor& sensor, const Loop& loop, EditTurn* turn, Map* map) {
  const auto held = turn->Take();
  EssentialGraph essential;
  {
    const auto guard = map->Read();
    if (guard->Find(loop.current) == nullptr || guard->Find(loop.old) == nullptr) return false;
    essential = MakeEssentialGraph(*guard, options, loop);
  }
  if (!SolvePoseGraph(PoseGraphOptions(), {}, &essential.graph).is_usable) return false;
  MapCorrection correction;
  for (size_t i = 0; i < essential.keyframes.size(); ++i) {
    correction.camera_from_world[essential.keyframes[i]] = essential.graph.nodes[i].camera_from_world;
  }
  {
    const auto guard = map->Write();
    CorrectMap(correction, &*guard);
    guard->AddLoopEdge(loop.current, loop.old);
  }
  FuseBothSides(options, sensor, loop, map);
  return true;
}

}  // namespace orbslam
