// SPDX-License-Identifier: GPL-3.0-or-later
#include "full_detector.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "cells.h"
#include "depthless_growth.h"
#include "motion_field.h"
#include "object_velocity.h"
#include "plane_split.h"
#include "sliding_surface.h"
#include "whole_things.h"

namespace orbslam {
namespace {

constexpr float kMinLogOdds = -2.f,
                kMaxLogOdds = 4.f;  // of what is carried on: a few frames must change a mind

}  // namespace

FullDetector::FullDetector(const PinholeCamera& camera, const DynamicDetectorOptions& options)
    : options_(options),
      reducer_(camera, options.corners),
      history_(reducer_.grids().cell, options.references, camera.readout_s),
      flow_judge_(reducer_.grids(), options),
      presence_(options.presence),
      cluster_judge_(options.fusion, options.histogram) {}

DynamicMask FullDetector::Process(const RgbdImage& image) {
  DynamicMask result;
  result.frame_id = image.id;
  const auto frame = std::make_shared<const WorkingFrame>(reducer_.Reduce(image));
  result.fail_open_reason = ReasonToBegin(frame->timestamp_s);
  if (!result.fail_open_reason.empty()) {
    Begin(frame);
    return result;
  }
  Judgement judgement = EstimateMotion(*frame, image.id.value);
  const auto references =
      judgement.motion.IsTrusted() ? history_.FreeSpaceReferences() : std::vector<const ReferenceView*>();
  Vote(*frame, references, &judgement);
  cv::Mat1b undecided;
  cv::compare(judgement.votes.confirmed_static, 0, undecided, cv::CMP_EQ);
  judgement.segmentation = SegmentSurfaces(reducer_.grids().cell, *frame, undecided, options_.segmentation);
  const HistogramWindow window(reducer_.grids().cell, history_, *frame, options_.histogram);
  JudgeClusters(*frame, window, &judgement);
  JudgeThings(*frame, &judgement);
  JudgeDepthless(*frame, references, &judgement);

  result.fail_open_reason = FailOpenReason(judgement);
  if (!result.fail_open_reason.empty()) judgement.moving.setTo(0), judgement.log_odds.setTo(0);
  Report(*frame, judgement, window, &result);
  log_odds_ = judgement.log_odds;
  history_.Add(frame, judgement.moving, window.current_cloud());
  if (options_.hindsight.use_hindsight && judgement.motion.IsSharp())
    history_.LookBack(options_.free_space, options_.segmentation);
  return result;
}

std::string FullDetector::ReasonToBegin(double timestamp_s) const {
  const ReferenceView* last = history_.Back(1);
  if (last == nullptr) return "there is no earlier frame to compare with";
  if (timestamp_s - last->frame->timestamp_s > options_.fail_open.max_gap_s)
    return "the frame before is too old to compare with";
  return {};
}

void FullDetector::Forget() {
  history_.Clear();
  flow_judge_.Reset();
  tracker_.Reset();
  untrusted_frames_ = covered_frames_ = 0;
}

void FullDetector::Begin(std::shared_ptr<const WorkingFrame> frame) {
  Forget();
  const cv::Mat1b nothing(frame->depth_m.size(), uint8_t{0});
  log_odds_ = cv::Mat1f::zeros(frame->depth_m.size());
  auto cloud = MakeHistogramCloud(reducer_.grids().cell, frame->depth_m, options_.histogram.stride);
  history_.Add(std::move(frame), nothing, std::move(cloud));
}

FullDetector::Judgement FullDetector::EstimateMotion(const WorkingFrame& frame, uint64_t seed) {
  Judgement judgement;
  judgement.motion = flow_judge_.Judge(frame, seed, &history_);
  untrusted_frames_ = judgement.motion.IsTrusted() ? 0 : untrusted_frames_ + 1;
  judgement.shift = BackwardMotion(frame.depth_m.size(), judgement.motion.camera.corners);
  judgement.carried = CarryOver(log_odds_, judgement.shift);
  return judgement;
}

void FullDetector::Vote(const WorkingFrame& frame, std::span<const ReferenceView* const> references,
                        Judgement* judgement) const {
  std::vector<SightingRules> rules{{options_.free_space}};
  if (options_.whole_things.use_whole_things && judgement->motion.IsSharp())
    rules.push_back(RootedRules(options_.whole_things));
  std::vector<Sightings> sightings = CountSightings(reducer_.grids().cell, frame.depth_m, references, rules);
  judgement->votes = VoteOnFreeSpace(std::move(sightings.front()), options_.free_space);
  if (sightings.size() > 1) judgement->for_roots = std::move(sightings.back());
  if (!options_.sliding.use_sliding || !judgement->motion.IsTrusted()) return;
  for (const Flow& flow : judgement->motion.flows) {
    if (!flow.gate.IsSharp() && !flow.far_alone_rests) continue;
    SlidingOptions options = options_.sliding;
    if (flow.far_alone_rests) {  // what is near moves: each of its corners speaks for the surface it is on
      options.min_neighbors = 1, options.min_likeness = 0;
      options.max_steps = options_.camera_motion.far.reach_cells;
    }
    WithdrawStatic(SlidingCells(frame.depth_m, flow, options), &judgement->votes);
  }
}

void FullDetector::JudgeClusters(const WorkingFrame& frame, const HistogramWindow& window,
                                 Judgement* judgement) const {
  const Segmentation& segmentation = judgement->segmentation;
  const bool can_ask = window.IsFull() && judgement->motion.IsTrusted();
  judgement->verdicts = cluster_judge_.Judge(
      segmentation,
      GatherFacts(segmentation, frame, judgement->votes, judgement->carried, judgement->motion.flows),
      can_ask ? &window : nullptr, judgement->motion.camera.corners);
  judgement->moving = cv::Mat1b::zeros(frame.depth_m.size());
  judgement->log_odds = cv::Mat1f(frame.depth_m.size(), -1.f);
  for (size_t c = 0; c < judgement->verdicts.size(); ++c)
    for (const int cell : segmentation.clusters[c].cells) {
      const float log_odds = judgement->verdicts[c].log_odds;
      judgement->log_odds(cell) = std::clamp(log_odds, kMinLogOdds, kMaxLogOdds);
      if (log_odds > 0) judgement->moving(cell) = 255;
    }
}

/// Blur and the rolling shutter join what is apart.
void FullDetector::JudgeThings(const WorkingFrame& frame, Judgement* judgement) const {
  const WholeThingOptions& options = options_.whole_things;
  if (judgement->for_roots.num_static.empty()) return;
  if (cv::countNonZero(judgement->moving) < options.min_moving_cells) return;
  const GridCamera& camera = reducer_.grids().cell;
  const cv::Mat1b rooted = RootedCells(judgement->for_roots);
  const cv::Mat1b hanging_on = WholeThings(camera, frame, judgement->moving, rooted, options);
  judgement->moving.setTo(255, hanging_on);
  cv::Mat1f at_least;
  cv::max(judgement->log_odds, options.log_odds, at_least);
  at_least.copyTo(judgement->log_odds, hanging_on);
}

void FullDetector::JudgeDepthless(const WorkingFrame& frame, std::span<const ReferenceView* const> references,
                                  Judgement* judgement) const {
  constexpr int kContactCells = 3;
  const cv::Mat rim = cv::Mat::ones(3, 3, CV_8U);
  if (!options_.growth.use_growth) {
    cv::dilate(judgement->moving, judgement->moving, rim);
    return;
  }
  BackgroundView background;
  if (options_.growth.use_background) background = RenderBackground(reducer_.grids().cell, frame, references);
  const std::vector<TrackedCorner> no_corners;
  const cv::Mat1f odds = DepthlessLogOdds(
      frame, judgement->carried, background,
      judgement->motion.IsTrusted() ? judgement->motion.camera.corners : no_corners, options_.growth);
  cv::Mat1b contact;
  cv::dilate(judgement->moving, contact, cv::Mat::ones(2 * kContactCells + 1, 2 * kContactCells + 1, CV_8U));
  const cv::Mat1b grown =
      GrowIntoDepthless(judgement->moving, frame, odds, judgement->carried, options_.growth);
  const auto depth_m = Cells(frame.depth_m), log_odds_here = Cells(odds);
  const auto is_grown = Cells(grown);
  const auto has_contact = Cells(contact);
  const auto log_odds = Cells(judgement->log_odds);
  for (size_t i = 0; i < depth_m.size(); ++i) {
    if (depth_m[i] > 0) continue;
    const float support = is_grown[i] != 0 && has_contact[i] != 0 ? options_.growth.contact : 0.f;
    // Positive only in the mask: what merely looks unexpected must not begin one.
    log_odds[i] = std::clamp(log_odds_here[i] + support, kMinLogOdds, is_grown[i] != 0 ? kMaxLogOdds : 0.f);
  }
  cv::dilate(grown, judgement->moving, rim);
}

std::string FullDetector::FailOpenReason(const Judgement& judgement) {
  if (untrusted_frames_ > options_.fail_open.max_untrusted_frames) {
    Forget();
    return "the camera's motion cannot be told: " + judgement.motion.camera.failure;
  }
  const double masked_share =
      static_cast<double>(cv::countNonZero(judgement.moving)) / static_cast<double>(judgement.moving.total());
  if (!judgement.motion.IsTrusted() && masked_share == 0) return judgement.motion.camera.failure;
  const bool is_early = history_.Back(options_.fail_open.early_frames) == nullptr;
  if (is_early && masked_share > options_.fail_open.max_early_share) {
    Forget();
    return "most of the first picture seems to move";
  }
  covered_frames_ = masked_share > options_.fail_open.max_masked_share ? covered_frames_ + 1 : 0;
  if (covered_frames_ > options_.fail_open.max_covered_frames) return "everything seems to move";
  return {};
}

void FullDetector::Report(const WorkingFrame& frame, const Judgement& judgement,
                          const HistogramWindow& window, DynamicMask* result) {
  const WorkingGrids& grids = reducer_.grids();
  ObjectTracker::Labelled labelled =
      tracker_.Update(grids.cell, grids.cell_step * grids.cell_step, judgement.moving, frame,
                      judgement.log_odds, judgement.shift);
  SetVelocities(judgement.segmentation, judgement.verdicts, judgement.log_odds, window,
                judgement.motion.camera.corners, &labelled);
  result->objects = std::move(labelled.objects);
  const int num_pixels = static_cast<int>(frame.depth_m.total()) * grids.cell_step * grids.cell_step;
  const bool is_believed = presence_.Update(result->objects, num_pixels, frame.timestamp_s);
  if (cv::countNonZero(judgement.moving) == 0) return;
  if (is_believed) {
    result->mask = reducer_.ToRawMask(judgement.moving);
  } else {
    result->fail_open_reason = "what may move is small and new";
  }
}

}  // namespace orbslam
