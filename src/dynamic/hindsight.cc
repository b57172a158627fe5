// SPDX-License-Identifier: GPL-3.0-or-later
#include "hindsight.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "free_space.h"
#include "segmenter.h"

namespace orbslam {
namespace {

/// Most of what can be judged of it is seen through.
bool HasGone(const Cluster& cluster, const FreeSpaceVotes& votes) {
  int num_judged = 0, num_gone = 0;
  for (const int cell : cluster.cells) {
    num_judged += votes.num_free(cell) + votes.num_static(cell) > 0;
    num_gone += votes.suspicious(cell) != 0;
  }
  return 2 * num_gone > num_judged;
}

}  // namespace

cv::Mat1b GoneSince(const GridCamera& camera, const ReferenceView& past, ReferenceView present,
                    const FreeSpaceOptions& free_space, const SegmentationOptions& segmentation) {
  const cv::Mat1f& depth_m = past.frame->depth_m;
  present.reference_from_current = Inverse(past.reference_from_current);
  present.age_frames = past.age_frames;
  const ReferenceView* reference = &present;
  const FreeSpaceVotes votes = VoteOnFreeSpace(camera, depth_m, {&reference, 1}, free_space);
  cv::Mat1b gone(depth_m.size(), uint8_t{0}), undecided;
  if (cv::countNonZero(votes.suspicious) < segmentation.min_cells) return gone;
  cv::compare(votes.confirmed_static, 0, undecided, cv::CMP_EQ);
  for (const Cluster& cluster : SeededClusters(depth_m, undecided, votes.suspicious, segmentation.min_cells))
    if (HasGone(cluster, votes))
      for (const int cell : cluster.cells) gone(cell) = 255;
  cv::dilate(gone, gone, cv::Mat::ones(3, 3, CV_8U));
  return gone;
}

}  // namespace orbslam
