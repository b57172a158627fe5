// SPDX-License-Identifier: GPL-3.0-or-later
#include "whole_things.h"

#include <Eigen/Core>
#include <algorithm>
#include <utility>
#include <vector>

#include "cells.h"
#include "plane_split.h"

namespace orbslam {
namespace {

/// Connected surfaces on which enough moves; all others are taken out of the included cells.
std::vector<Cluster> ThatMove(const WorkingFrame& frame, const cv::Mat1b& moving,
                              const WholeThingOptions& options, cv::Mat1b* included) {
  std::vector<Cluster> things = SeededClusters(frame.depth_m, *included, moving, options.min_moving_cells);
  included->setTo(0);
  std::erase_if(things, [&](const Cluster& thing) {
    return std::ranges::count_if(thing.cells, [&](int cell) { return moving(cell) != 0; }) <
           options.min_moving_cells;
  });
  for (const Cluster& thing : things)
    for (const int cell : thing.cells) (*included)(cell) = 255;
  return things;
}

/// What is left of them when one large plane after the other has been taken off each.
std::vector<Cluster> WithoutFurniture(const GridCamera& camera, const WorkingFrame& frame,
                                      const cv::Mat1b& moving, cv::Mat1b included,
                                      const WholeThingOptions& options) {
  constexpr int kMaxRounds = 6;  // floor, three walls, a table and what stands on it
  std::vector<Cluster> things = ThatMove(frame, moving, options, &included);
  for (int round = 0; round < kMaxRounds; ++round) {
    if (TakePlanes(camera, frame, things, options.min_plane_m2, &included).empty()) break;
    things = ThatMove(frame, moving, options, &included);
  }
  return things;
}

class Thing {
 public:
  Thing(const GridCamera& camera, const cv::Mat1f& depth_m, const cv::Mat1b& moving, const Cluster& cluster)
      : camera_(camera), depth_m_(depth_m) {
    for (const int cell : cluster.cells) (moving(cell) != 0 ? moving_ : others_).push_back(cell);
  }

  bool Moves(const WholeThingOptions& options) const {
    const auto num_moving = static_cast<float>(moving_.size());
    return num_moving >= static_cast<float>(options.min_moving_cells) &&
           num_moving >= options.min_moving_share * (num_moving + static_cast<float>(others_.size()));
  }

  void MarkWithinReach(float reach_m, cv::Mat1b* marked) const {
    constexpr size_t kStep = 16;  // a few cells of a hand do for all of it
    std::vector<Eigen::Vector3f> seeds;
    for (size_t i = 0; i < moving_.size(); i += kStep) seeds.push_back(Point(moving_[i]));
    for (const int cell : others_) {
      const Eigen::Vector3f x = Point(cell);
      const auto is_near = [&](const auto& seed) { return (x - seed).squaredNorm() < reach_m * reach_m; };
      if (std::ranges::any_of(seeds, is_near)) (*marked)(cell) = 255;
    }
  }

 private:
  Eigen::Vector3f Point(int cell) const {
    const int u = cell % camera_.width, v = cell / camera_.width;
    return depth_m_(cell) * Eigen::Vector3f((static_cast<float>(u) - camera_.cx) / camera_.fx,
                                            (static_cast<float>(v) - camera_.cy) / camera_.fy, 1);
  }

  const GridCamera& camera_;
  const cv::Mat1f& depth_m_;
  std::vector<int> moving_, others_;
};

}  // namespace

SightingRules RootedRules(const WholeThingOptions& options) {
  SightingRules rules{{}, options.min_age_frames};
  rules.options.gate_sigma = options.gate_sigma, rules.options.margin_m = options.margin_m;
  rules.options.margin_per_metre = rules.options.drift_m = 0;
  return rules;
}

cv::Mat1b RootedCells(const Sightings& sightings) {
  cv::Mat1b rooted(sightings.num_static.size(), uint8_t{0});
  const auto is_rooted = Cells(rooted);
  const auto num_static = Cells(sightings.num_static), num_free = Cells(sightings.num_free);
  for (size_t i = 0; i < is_rooted.size(); ++i)  // free votes are halves: twice as many saw it there
    is_rooted[i] = num_static[i] > 0 && num_static[i] >= num_free[i] ? 255 : 0;
  return rooted;
}

cv::Mat1b WholeThings(const GridCamera& camera, const WorkingFrame& frame, const cv::Mat1b& moving,
                      const cv::Mat1b& rooted, const WholeThingOptions& options) {
  cv::Mat1b hanging_on(frame.depth_m.size(), uint8_t{0});
  cv::Mat1b included;
  cv::bitwise_not(rooted, included);
  included.setTo(255, moving);
  for (const Cluster& cluster : WithoutFurniture(camera, frame, moving, std::move(included), options)) {
    const Thing thing(camera, frame.depth_m, moving, cluster);
    if (thing.Moves(options)) thing.MarkWithinReach(options.reach_m, &hanging_on);
  }
  return hanging_on;
}

}  // namespace orbslam
