// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/tracking/relocalizer.h"

#include <algorithm>

#include "orbslam/matching/word_search.h"
#include "orbslam/pipeline/point_view.h"
#include "orbslam/tracking/pose_refinement.h"

namespace orbslam {
namespace {

struct KeyFrameCopy {
  std::shared_ptr<const FrameFeatures> features;
  std::vector<MapPointId> points;
  std::vector<char> has_point;
};

std::optional<KeyFrameCopy> Copy(const Map& map, KeyFrameId id) {
  const auto guard = map.Read();
  const KeyFrame* keyframe = guard->Find(id);
  if (keyframe == nullptr) return std::nullopt;
  KeyFrameCopy copy{keyframe->features, keyframe->points, {}};
  std::ranges::transform(copy.points, std::back_inserter(copy.has_point), &MapPointId::IsValid);
  return copy;
}

std::vector<int> AllOf(const std::vector<char>& flags) {
  std::vector<int> indices;
  for (int i = 0; i < std::ssize(flags); ++i) {
    if (flags[i]) indices.push_back(i);
  }
  return indices;
}

/// frame keypoint -> map point, by appearance.
void MatchByAppearance(const KeyFrameCopy& keyframe, const PlaceIndex::Words* keyframe_words,
                       const PlaceIndex::Words* words, double max_ratio, Frame* frame) {
  const DescriptorSearchOptions search{.max_ratio = max_ratio};
  frame->ForgetPoints();
  if (words != nullptr && keyframe_words != nullptr) {
    const std::vector<int> match =
        SearchByWords(*keyframe.features, keyframe_words->direct_index, keyframe.has_point, *frame->features,
                      words->direct_index, {}, search);
    for (size_t i = 0; i < match.size(); ++i) {
      if (match[i] >= 0) frame->points[match[i]] = keyframe.points[i];
    }
    return;
  }
  const std::vector<int> from = AllOf(keyframe.has_point);
  const std::vector<int> to = AllOf(std::vector<char>(frame->points.size(), 1));
  const std::vector<int> match = SearchByDescriptor(*keyframe.features, from, *frame->features, to, search);
  for (size_t q = 0; q < match.size(); ++q) {
    if (match[q] >= 0) frame->points[match[q]] = keyframe.points[from[q]];
  }
}

}  // namespace

bool Relocalizer::Relocalize(Frame* frame) {
  const auto words = places_ != nullptr ? places_->Transform(*frame->features) : nullptr;
  for (const KeyFrameId candidate : Candidates(words.get())) {
    if (TryKeyFrame(candidate, words.get(), frame)) return true;
  }
  frame->ForgetPoints();
  return false;
}

std::vector<KeyFrameId> Relocalizer::Candidates(const PlaceIndex::Words* words) {
  std::vector<KeyFrameId> candidates;
  if (words != nullptr) {
    for (const auto& candidate : places_->Query(words->bow, {})) candidates.push_back(candidate.id);
  } else {
    const auto guard = map_.Read();
    for (const KeyFrame& keyframe : guard->KeyFrames()) candidates.push_back(keyframe.id);
    const auto first = std::ranges::lower_bound(candidates, next_.IsValid() ? next_ : KeyFrameId(0));
    std::ranges::rotate(candidates, first);
  }
  if (std::ssize(candidates) > options_.max_tries) {
    next_ = candidates[options_.max_tries];
    candidates.resize(options_.max_tries);
  }
  return candidates;
}

bool Relocalizer::TryKeyFrame(KeyFrameId id, const PlaceIndex::Words* words, Frame* frame) const {
  const auto keyframe = Copy(map_, id);
  if (!keyframe) return false;
  const auto keyframe_words = places_ != nullptr ? places_->Find(id) : nullptr;
  MatchByAppearance(*keyframe, keyframe_words.get(), words, options_.max_ratio, frame);
  if (frame->NumPoints() < options_.min_first_inliers) return false;

  int num_inliers = EstimatePose(map_, sensor_, frame);
  if (num_inliers < options_.min_first_inliers) return false;
  if (num_inliers < options_.min_inliers) {
    num_inliers = SearchAgain(id, options_.wide_radius_px, frame);
  }
  if (num_inliers < options_.min_inliers && num_inliers >= options_.min_inliers / 2) {
    num_inliers = SearchAgain(id, options_.narrow_radius_px, frame);
  }
  return num_inliers >= options_.min_inliers;
}

int Relocalizer::SearchAgain(KeyFrameId id, double radius_px, Frame* frame) const {
  PointQueries wanted;
  std::vector<char> is_taken(frame->points.size());
  std::ranges::transform(frame->points, is_taken.begin(), &MapPointId::IsValid);
  {
    const auto guard = map_.Read();
    const KeyFrame* keyframe = guard->Find(id);
    if (keyframe == nullptr) return 0;
    for (const MapPointId point_id : keyframe->points) {
      const MapPoint* point = guard->Find(point_id);
      if (point == nullptr || std::ranges::count(frame->points, point_id) > 0) continue;
      wanted.Add(*point, frame->camera_from_world, sensor_, radius_px);
    }
  }
  const std::vector<int> match =
      SearchByProjection(wanted.queries, *frame->features, is_taken, {.max_distance = kLooseMaxDistance});
  for (size_t q = 0; q < match.size(); ++q) {
    if (match[q] >= 0) frame->points[match[q]] = wanted.points[q];
  }
  return RefinePose(map_, sensor_, NearPoints::kTrusted, frame);
}

}  // namespace orbslam
