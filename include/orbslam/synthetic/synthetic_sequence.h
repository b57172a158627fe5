// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/geometry/rigid3.h"
#include "orbslam/render/renderer.h"
#include "orbslam/synthetic/camera_path.h"
#include "orbslam/synthetic/room.h"
#include "orbslam/synthetic/script.h"
#include "orbslam/synthetic/sensor.h"
#include "orbslam/util/result.h"

namespace orbslam {

/// The camera of TUM's freiburg3 sequences without distortion (fx 535.4 at 640 x 480), scaled to another
/// width; 4 : 3.
PinholeCamera SyntheticCamera(int width = 640);

struct SyntheticSequenceOptions {
  uint64_t seed = 1;  // of the paint, the people, the tremor and the noise
  Motion motion = Motion::kXyz;
  ScriptKind script = ScriptKind::kStatic;
  int num_frames = 0;  // 0: as many as the motion lasts
  PinholeCamera camera = SyntheticCamera();
  SensorEffects sensor;           // none: exact depth, noiseless colour, one clock
  double texels_per_metre = 256;  // of the walls: 256 is about 60 MB; 128 does for 320 x 240

  /// The first option that is out of range.
  Status Check() const;
  /// num_frames, or those of the motion.
  int NumFrames() const;
};

struct SyntheticFrame {
  double timestamp_s = 0;        // of the colour image, the masks and the pose
  double depth_timestamp_s = 0;  // of the depth image
  cv::Mat gray;                  // CV_8UC1, of bgr
  cv::Mat bgr;                   // CV_8UC3
  cv::Mat depth_m;               // CV_32FC1, along the optical axis; 0: not measured
  cv::Mat mask;                  // CV_8UC1, 255: what can move (people, things of the script)
  cv::Mat mask_moving;           // CV_8UC1, 255: what moves at this moment
  Rigid3d world_from_camera;
};

/// A deterministic RGB-D sequence at 30 Hz through an office, with ground truth and without files. Frames are
/// pure functions of (options, index): made in any order, from any thread; rendering takes turns, the rest of
/// a frame runs beside it.
class SyntheticSequence {
 public:
  static constexpr double kFramesPerSecond = 30.0;

  /// options.Check() must hold. That no off-screen context can be had is a broken installation, and a check.
  explicit SyntheticSequence(const SyntheticSequenceOptions& options);

  int size() const { return num_frames_; }
  const SyntheticSequenceOptions& options() const { return options_; }

  /// index in [0, size()).
  SyntheticFrame Frame(int index) const;
  /// Everything that is there at a time: the room, and what the script puts in it.
  std::vector<SceneObject> SceneAt(double time_s) const;

 private:
  struct Clocks {
    double color_s = 0, depth_s = 0;
  };
  Clocks ClocksOf(int index) const;
  Lighting LightingAt(double time_s) const;
  cv::Mat Color(int index, double time_s) const;

  SyntheticSequenceOptions options_;
  int num_frames_;
  CameraPath path_;
  Script script_;
  Room room_;
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace orbslam
