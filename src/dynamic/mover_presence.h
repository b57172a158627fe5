// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <map>
#include <span>

#include "orbslam/dynamic/dynamic_detector_options.h"
#include "orbslam/pipeline/dynamic_mask.h"

namespace orbslam {

/// Whether anything moves in the scene at all. In a room where all rests every mask is an error: a small one,
/// of little evidence, that soon passes. What moves before a camera is large, or certain, or there for long.
/// Until one of these has been seen, masks are held back; where one thing moves others may, and all are
/// believed.
class MoverPresence {
 public:
  explicit MoverPresence(const PresenceOptions& options) : options_(options) {}

  /// objects: those of the frame, with the ids by which they are followed; frames in order of time.
  bool Update(std::span<const DynamicObject> objects, int num_image_pixels, double timestamp_s);

 private:
  PresenceOptions options_;
  std::map<int, double> first_seen_s_;                            // of the objects of the last frame, by id
  double believed_s_ = -std::numeric_limits<double>::infinity();  // the last time that something surely moved
};

}  // namespace orbslam
