// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "orbslam/map/map.h"
#include "orbslam/pipeline/frame.h"
#include "orbslam/pipeline/place_index.h"
#include "orbslam/pipeline/sensor.h"

namespace orbslam {

struct RelocalizerOptions {
  double max_ratio = 0.75;      // of matches by appearance
  int min_first_inliers = 10;   // map points that agree on the first pose
  int min_inliers = 20;         // in the end. ORB-SLAM (2015, section V-C): 50; the local map confirms here
  double wide_radius_px = 10;   // looking again with the first pose, px of a point's level ...
  double narrow_radius_px = 3;  // ... and with the second
  int max_tries = 8;            // keyframes tried a frame
};

/// Finds a lost camera in the known map: keyframes that look alike, P3P with RANSAC, refinement, and a wider
/// search by projection. (ORB-SLAM, Mur-Artal et al. 2015, section V-C.) Without a vocabulary (places ==
/// nullptr) it tries all keyframes in turn, a few a frame.
class Relocalizer {
 public:
  Relocalizer(const Map& map, const PlaceIndex* places, const Sensor& sensor,
              const RelocalizerOptions& options)
      : map_(map), places_(places), sensor_(sensor), options_(options) {}

  /// On success fills the frame's pose and points.
  bool Relocalize(Frame* frame);

 private:
  std::vector<KeyFrameId> Candidates(const PlaceIndex::Words* words);
  bool TryKeyFrame(KeyFrameId keyframe, const PlaceIndex::Words* words, Frame* frame) const;
  int SearchAgain(KeyFrameId keyframe, double radius_px, Frame* frame) const;

  const Map& map_;
  const PlaceIndex* places_;
  const Sensor& sensor_;
  const RelocalizerOptions options_;
  KeyFrameId next_;  // to try, without a vocabulary
};

}  // namespace orbslam
