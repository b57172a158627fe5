// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/synthetic/synthetic_sequence.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "orbslam/synthetic/ray_caster.h"
#include "orbslam/synthetic/sensor_noise.h"
#include "orbslam/util/check.h"

namespace orbslam {

PinholeCamera SyntheticCamera(int width) {
  const double scale = width / 640.0;
  PinholeCamera camera;
  camera.width = width;
  camera.height = width * 3 / 4;
  camera.fx = 535.4 * scale;
  camera.fy = 539.2 * scale;
  camera.cx = (320.1 + 0.5) * scale - 0.5;  // pixel centres are whole numbers
  camera.cy = (247.6 + 0.5) * scale - 0.5;
  return camera;
}

Status SyntheticSequenceOptions::Check() const {
  if (num_frames < 0) return Error{"the number of frames must not be negative"};
  if (camera.width < 1 || camera.height < 1) return Error{"the camera's image is empty"};
  if (!(camera.fx > 0 && camera.fy > 0)) return Error{"the camera's focal lengths must be positive"};
  if (camera.IsDistorted()) return Error{"a synthetic camera cannot be distorted"};
  if (num_threads < 1) return Error{"at least one thread is needed"};
  if (!(texels_per_metre >= 16 && texels_per_metre <= 1024)) {
    return Error{"texels_per_metre must be between 16 and 1024"};
  }
  return OkStatus();
}

SyntheticSequence::SyntheticSequence(const SyntheticSequenceOptions& options)
    : options_(options),
      num_frames_(options.num_frames > 0
                      ? options.num_frames
                      : static_cast<int>(std::lround(MotionDurationS(options.motion) * kFramesPerSecond))),
      path_(options.motion, options.seed) {
  ORBSLAM_CHECK(options.Check().ok());
  room_ = MakeRoom(options.seed, options.texels_per_metre);
}

SyntheticFrame SyntheticSequence::Frame(int index) const {
  ORBSLAM_CHECK(index >= 0 && index < num_frames_);
  enum : uint64_t { kDepthPurpose = 0x64657074, kImagePurpose = 0x696D6167 };
  SyntheticFrame frame;
  frame.timestamp_s = index / kFramesPerSecond;
  frame.world_from_camera = path_.WorldFromCamera(frame.timestamp_s);
  View view = CastRays(room_, options_.camera, frame.world_from_camera, options_.num_threads);
  if (options_.depth_noise) {
    Rng rng(options_.seed, index, kDepthPurpose);
    AddKinectNoise(&rng, &view.depth_m);
  }
  if (options_.image_noise) {
    Rng rng(options_.seed, index, kImagePurpose);
    AddImageNoise(SyntheticSequenceOptions::kImageNoiseSigma, &rng, &view.bgr);
  }
  frame.bgr = view.bgr;
  frame.depth_m = view.depth_m;
  cv::cvtColor(frame.bgr, frame.gray, cv::COLOR_BGR2GRAY);
  return frame;
}

}  // namespace orbslam
