// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orbslam/synthetic/synthetic_sequence.h"
#include "orbslam/util/result.h"

namespace orbslam {

/// Writes the frames of a sequence into a folder in the layout of the TUM RGB-D benchmark (Sturm et al., IROS
/// 2012), with masks; frames in any order and from several threads.
class SequenceWriter {
 public:
  SequenceWriter(std::string folder, int num_frames) : folder_(std::move(folder)), lines_(num_frames) {}

  /// Error: a folder that cannot be made.
  Status MakeFolders() const;
  Status WriteFrame(int index, const SyntheticFrame& frame);
  /// When all frames are written: the lists, the ground truth, camera.yaml and sequence.json. num_figures:
  /// people and things that the script moves.
  Status WriteLists(const SyntheticSequenceOptions& options, int num_figures) const;

 private:
  /// What the lists say about a frame.
  struct Line {
    std::string color_time, depth_time;
    Rigid3d world_from_camera;
    double share_movable = 0, share_moving = 0;  // of the pixels
  };

  std::string SequenceJson(const SyntheticSequenceOptions& options, int num_figures) const;

  std::string folder_;
  std::vector<Line> lines_;
};

}  // namespace orbslam
