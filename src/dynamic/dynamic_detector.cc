// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/dynamic_detector.h"

#include <opencv2/imgproc.hpp>
#include <cstdlib>
#include <cstdio>
#include <ctime>

#include "camera_motion.h"
#include "free_space.h"
#include "mask_growth.h"
#include "scene_history.h"
#include "segmenter.h"
#include "working_frame.h"

namespace orbslam {
namespace {
double Cpu(){ timespec t; clock_gettime(CLOCK_THREAD_CPUTIME_ID,&t); return t.tv_sec*1e3+t.tv_nsec*1e-6; }
}

class DynamicDetector::Implementation {
 public:
  Implementation(const PinholeCamera& camera, const DynamicDetectorOptions&)
      : reducer_(camera), history_(reducer_.grids().cell, {}), motion_(reducer_.grids(), {}) {}

  DynamicMask Process(const RgbdImage& image) {
    DynamicMask result;
    result.frame_id = image.id;
    double t0=Cpu();
    auto frame = std::make_shared<const WorkingFrame>(reducer_.Reduce(image));
    double t1=Cpu();
    cv::Mat1b moving = cv::Mat1b::zeros(frame->depth_m.size());
    if (history_.Back(1) == nullptr) {
      result.fail_open_reason = "first frame";
      history_.Add(frame, moving);
      return result;
    }
    const CameraMotion motion = motion_.Estimate(history_, *frame, image.id.value);
    double t2=Cpu();
    history_.Advance(Inverse(motion.depth_current_from_previous));
    history_.AlignKeyframes(*frame, nullptr);
    double t3=Cpu();
    const auto references = history_.FreeSpaceReferences();
    const FreeSpaceVotes votes = VoteOnFreeSpace(reducer_.grids().cell, frame->depth_m, references, {});
    double t4=Cpu();
    const Segmentation segmentation = SegmentCells(frame->depth_m, ~votes.confirmed_static, 20);
    double t5=Cpu();
    for (const Cluster& cluster : segmentation.clusters) {
      int suspicious = 0;
      for (const int cell : cluster.cells) suspicious += votes.suspicious(cell);
      if (suspicious > 0.22 * cluster.cells.size())
        for (const int cell : cluster.cells) moving(cell) = 255;
    }
    cv::Mat1b grown = GrowMask(moving, frame->depth_m, frame->pyramid[1], {});
    cv::dilate(grown, moving, cv::Mat::ones(3, 3, CV_8U));
    result.mask = reducer_.ToRawMask(moving);
    history_.Add(frame, moving);
    double t6=Cpu();
    if (getenv("DET_DEBUG")) fprintf(stderr, "%u inl %d/%zu fit %.2f refs %zu clusters %zu fail '%s' ms %.1f %.1f %.1f %.1f %.1f %.1f\n", image.id.value, motion.num_inliers, motion.corners.size(), motion.fit_share, references.size(), segmentation.clusters.size(), motion.failure.c_str(), t1-t0,t2-t1,t3-t2,t4-t3,t5-t4,t6-t5);
    return result;
  }

 private:
  FrameReducer reducer_;
  SceneHistory history_;
  CameraMotionEstimator motion_;
};

DynamicDetector::DynamicDetector(const PinholeCamera& camera, const DepthModel&,
                                 const DynamicDetectorOptions& options)
    : implementation_(std::make_unique<Implementation>(camera, options)) {}
DynamicDetector::~DynamicDetector() = default;
DynamicDetector::DynamicDetector(DynamicDetector&&) noexcept = default;
DynamicDetector& DynamicDetector::operator=(DynamicDetector&&) noexcept = default;

DynamicMask DynamicDetector::Process(const RgbdImage& image) { return implementation_->Process(image); }

}  // namespace orbslam
