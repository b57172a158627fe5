// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "background_view.h"
#include "cluster_judge.h"
#include "flow_judge.h"
#include "free_space.h"
#include "histogram_evidence.h"
#include "mover_presence.h"
#include "object_tracker.h"
#include "orbslam/pipeline/dynamic_mask.h"
#include "scene_history.h"
#include "segmenter.h"
#include "working_frame.h"

namespace orbslam {

/// Mode kFull of DynamicDetector.
class FullDetector {
 public:
  FullDetector(const PinholeCamera& camera, const DynamicDetectorOptions& options);

  DynamicMask Process(const RgbdImage& image);

 private:
  /// What one frame's judgement passes from step to step; grids of cells.
  struct Judgement {
    FrameMotion motion;  // the references are to be trusted as far as it is
    cv::Mat2f shift;     // where moving things were in the last frame
    cv::Mat1f carried;   // log-odds of the last frame, there
    FreeSpaceVotes votes;
    Sightings for_roots;  // empty: not asked
    Segmentation segmentation;
    std::vector<ClusterVerdict> verdicts;  // of each cluster
    cv::Mat1f log_odds;                    // of each cell: it moves
    cv::Mat1b moving;                      // the mask, with its rim
  };

  /// Why there is nothing to compare with a frame of that time; empty if there is.
  std::string ReasonToBegin(double timestamp_s) const;
  void Forget();
  void Begin(std::shared_ptr<const WorkingFrame> frame);
  Judgement EstimateMotion(const WorkingFrame& frame, uint64_t seed);
  void Vote(const WorkingFrame& frame, std::span<const ReferenceView* const> references,
            Judgement* judgement) const;
  void JudgeClusters(const WorkingFrame& frame, const HistogramWindow& window, Judgement* judgement) const;
  void JudgeThings(const WorkingFrame& frame, Judgement* judgement) const;
  void JudgeDepthless(const WorkingFrame& frame, std::span<const ReferenceView* const> references,
                      Judgement* judgement) const;
  void Report(const WorkingFrame& frame, const Judgement& judgement, const HistogramWindow& window,
              DynamicMask* result);
  std::string FailOpenReason(const Judgement& judgement);

  DynamicDetectorOptions options_;
  FrameReducer reducer_;
  SceneHistory history_;
  FlowJudge flow_judge_;
  ObjectTracker tracker_;
  MoverPresence presence_;
  ClusterJudge cluster_judge_;
  cv::Mat1f log_odds_;                             // of the last frame's cells
  int untrusted_frames_ = 0, covered_frames_ = 0;  // in a row
};

}  // namespace orbslam
