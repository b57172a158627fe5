// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "orbslam/system/sequence_runner.h"

namespace orbslam {

/// Everything that rgbd_tum was asked to do.
struct DatasetJob {
  std::string vocabulary_path;  // "-": none
  std::string settings_path;
  std::string sequence_folder;
  std::string associations_path;  // empty: rgb.txt and depth.txt are associated
  std::string output_folder = ".";
  std::string load_map_path;  // empty: none; as next
  std::string save_map_path;
  std::string mask_folder;  // ready-made masks
  std::string save_masks_folder;
  bool localize_only = false;
  bool sequential = false;
  bool use_detector = true;
  RunOptions run;
  std::vector<std::string> command_line;  // for the report
};

/// The version of the library, such as "0.1.0".
const char* Version();

/// Exit codes of the programs.
inline constexpr int kExitOk = 0, kExitError = 2, kExitInterrupted = 130;

/// Runs the sequence and writes CameraTrajectory.txt, KeyFrameTrajectory.txt, settings.yaml and run.json into
/// the output folder. Bad input is explained in one line in the log; what could be computed is written in
/// every case.
int RunDataset(const DatasetJob& job, const std::atomic<bool>& is_interrupted);

}  // namespace orbslam
