// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/dynamic_detector.h"

#include <opencv2/imgproc.hpp>
#include <cstdlib>
#include <cstdio>
#include <ctime>

#include "camera_motion.h"
#include "free_space.h"
#include "background_view.h"
#include "cluster_fusion.h"
#include "depthless_growth.h"
#include "motion_field.h"
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
      belief_ = cv::Mat1f::zeros(frame->depth_m.size());
      return result;
    }
    const CameraMotion motion = motion_.Estimate(history_, *frame, image.id.value);
    double t2=Cpu();
    if (getenv("DET_POSE")) { const Rigid3d c = motion.color_current_from_previous, d = motion.depth_current_from_previous; 
      fprintf(stderr, "POSE %u %.6f %.6f %.6f %.6f %.6f %.6f  %.6f %.6f %.6f %.6f %.6f %.6f %d %.2f\n", image.id.value, 2*c.rotation.x(), 2*c.rotation.y(), 2*c.rotation.z(), c.translation.x(), c.translation.y(), c.translation.z(), 2*d.rotation.x(), 2*d.rotation.y(), 2*d.rotation.z(), d.translation.x(), d.translation.y(), d.translation.z(), motion.num_inliers, motion.fit_share); }
    history_.Advance(Inverse(motion.depth_current_from_previous));
    history_.AlignKeyframes(*frame, nullptr);
    double t3=Cpu();
    const auto references = history_.FreeSpaceReferences();
    const FreeSpaceVotes votes = VoteOnFreeSpace(reducer_.grids().cell, frame->depth_m, references, {});
    double t4=Cpu();
    const Segmentation segmentation = SegmentCells(frame->depth_m, ~votes.confirmed_static, 20);
    double t5=Cpu();
    const cv::Mat2f shift = BackwardMotion(frame->depth_m.size(), motion.corners);
    const cv::Mat1f carried = CarryOver(belief_, shift);
    const auto evidence = GatherEvidence(segmentation, *frame, votes, carried, motion.corners);
    cv::Mat1f belief = cv::Mat1f(frame->depth_m.size(), -1.f);
    for (size_t c = 0; c < evidence.size(); ++c) {
      const float log_odds = ClusterLogOdds(evidence[c], fusion_);
      for (const int cell : segmentation.clusters[c].cells) {
        belief(cell) = std::clamp(log_odds, -2.f, 4.f) * 0.95f;
        if (log_odds > 0) moving(cell) = 255;
      }
    }
    const BackgroundView background = RenderBackground(reducer_.grids().cell, *frame, references);
    const cv::Mat1f odds = DepthlessLogOdds(*frame, carried, background, motion.corners, growth_);
    cv::Mat1b contact; cv::dilate(moving, contact, cv::Mat::ones(7, 7, CV_8U));
    cv::Mat1b grown = GrowIntoDepthless(moving, *frame, odds, carried, growth_);
    for (int i = 0; i < (int)grown.total(); ++i)
      if (frame->depth_m(i) == 0) belief(i) = std::clamp(odds(i) + (grown(i) != 0 && contact(i) != 0 ? growth_.contact : 0.f), -2.f, 3.f);
    belief_ = belief;
    cv::dilate(grown, moving, cv::Mat::ones(3, 3, CV_8U));
    result.mask = reducer_.ToRawMask(moving);
    if (const char* dump = getenv("DET_DUMP")) {
      FILE* f = fopen((std::string(dump) + "/" + std::to_string(image.id.value) + ".bin").c_str(), "wb");
      const cv::Mat1f g = frame->pyramid[1].clone();
      cv::Mat1f dil = cv::Mat1f(moving); 
      fwrite(g.data, 4, g.total(), f); fwrite(frame->depth_m.data, 4, g.total(), f);
      fwrite(votes.num_free.data, 1, g.total(), f); fwrite(votes.num_static.data, 1, g.total(), f);
      fwrite(votes.suspicious.data, 1, g.total(), f); fwrite(votes.confirmed_static.data, 1, g.total(), f);
      fwrite(segmentation.labels.data, 4, g.total(), f); fwrite(moving.data, 1, g.total(), f); fclose(f);
    }
    history_.Add(frame, moving);
    double t6=Cpu();
    if (getenv("DET_DEBUG")) fprintf(stderr, "%u inl %d/%zu fit %.2f refs %zu clusters %zu fail '%s' ms %.1f %.1f %.1f %.1f %.1f %.1f\n", image.id.value, motion.num_inliers, motion.corners.size(), motion.fit_share, references.size(), segmentation.clusters.size(), motion.failure.c_str(), t1-t0,t2-t1,t3-t2,t4-t3,t5-t4,t6-t5);
    return result;
  }

 private:
  FrameReducer reducer_;
  SceneHistory history_;
  cv::Mat1f belief_;
  FusionOptions fusion_;
  GrowthOptions growth_;
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
