// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/geometry/rigid3.h"
#include "orbslam/synthetic/camera_path.h"
#include "orbslam/synthetic/room.h"
#include "orbslam/util/result.h"

namespace orbslam {

/// The camera of TUM's freiburg3 sequences without distortion (fx 535.4 at 640 x 480), scaled to another
/// width; 4 : 3.
PinholeCamera SyntheticCamera(int width = 640);

struct SyntheticSequenceOptions {
  uint64_t seed = 1;  // of the paint, the tremor and the noise
  Motion motion = Motion::kXyz;
  int num_frames = 0;  // 0: as many as the motion lasts
  PinholeCamera camera = SyntheticCamera();
  bool depth_noise = false;       // a Kinect's: see AddKinectNoise
  bool image_noise = false;       // sigma of kImageNoiseSigma grey levels
  int num_threads = 2;            // of one Frame() call; never changes the result
  double texels_per_metre = 256;  // of the paint: 256 is about 90 MB; 128 does for 320 x 240

  static constexpr double kImageNoiseSigma = 2.0;

  /// The first option that is out of range.
  Status Check() const;
};

struct SyntheticFrame {
  double timestamp_s = 0;
  cv::Mat gray;     // CV_8UC1, of bgr
  cv::Mat bgr;      // CV_8UC3
  cv::Mat depth_m;  // CV_32FC1, along the optical axis; 0: not measured
  Rigid3d world_from_camera;
};

/// A deterministic RGB-D sequence at 30 Hz through a furnished room, with ground truth and without files.
/// Frames are pure functions of (options, index): made in any order, from any thread.
class SyntheticSequence {
 public:
  static constexpr double kFramesPerSecond = 30.0;

  /// options.Check() must hold.
  explicit SyntheticSequence(const SyntheticSequenceOptions& options);

  int size() const { return num_frames_; }
  const SyntheticSequenceOptions& options() const { return options_; }

  /// index in [0, size()).
  SyntheticFrame Frame(int index) const;

 private:
  SyntheticSequenceOptions options_;
  int num_frames_;
  CameraPath path_;
  std::vector<Surface> room_;
};

}  // namespace orbslam
