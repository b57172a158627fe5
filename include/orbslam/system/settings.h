// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "orbslam/camera/depth_model.h"
#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/dynamic/dynamic_detector_options.h"
#include "orbslam/features/orb_extractor.h"
#include "orbslam/loop/loop_options.h"
#include "orbslam/mapping/mapping_options.h"
#include "orbslam/optimization/trajectory_smoother.h"
#include "orbslam/tracking/tracking_options.h"
#include "orbslam/util/result.h"

namespace orbslam {

/// What a settings file says: ORB-SLAM2's keys for camera, depth and features, and a section for each stage.
/// All are listed once, in settings_table.cc.
struct Settings {
  PinholeCamera camera;
  double fps = 30;  // Camera.fps, frames a second
  DepthModel depth;
  OrbExtractorOptions orb;
  TrackingOptions tracking;
  KeyFramePolicyOptions keyframes;
  MappingOptions mapping;
  MotionPrior motion;
  bool closes_loops = true;
  LoopOptions loops;
  bool detects_motion = true;
  DynamicDetectorOptions detector;
  bool doubts_near_points = true;  // DynamicDetector.useFarPoints; see DoubtsNearPoints
  int user_mask_margin_px = 8;     // Masks.margin: by which masks of others are widened

  Settings() { camera.width = 640, camera.height = 480; }
};

/// Whether what is near may be contradicted by what is far (TrackingOptions::doubt_near_points): where
/// something is meant to move, because it is looked for or others say so, but not by the published method.
bool DoubtsNearPoints(const Settings& settings, bool use_detector, bool has_user_mask);

/// Reads and checks a settings file. warnings, if not null, gets a line for each unknown key. Error: whatever
/// is missing, of the wrong kind or out of range, a line each with file, line and key; or why the file cannot
/// be read.
Result<Settings> ReadSettings(const std::string& path, std::vector<std::string>* warnings);

/// A key and its value in use.
struct SettingValue {
  std::string key;
  std::variant<double, int, bool, std::string> value;
};
std::vector<SettingValue> EffectiveSettings(const Settings& settings);

/// All keys with the values in use, defaults included, and their units; as a file, it reads back equal.
std::string EffectiveSettingsYaml(const Settings& settings);

}  // namespace orbslam
