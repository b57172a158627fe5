// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings_table.h"

#include <algorithm>
#include <iterator>

namespace orbslam {
namespace {

using Rows = std::vector<ConfigRow>;
constexpr auto kRequired = ConfigRow::kRequired;
constexpr auto kOptional = ConfigRow::kOptional;

constexpr ConfigRange kSidePx{1, 16384};
constexpr ConfigRange kFocalPx{0, 1e5, true};
constexpr ConfigRange kCentrePx{-16384, 16384};  // of a cropped image it may lie outside
constexpr ConfigRange kDistortion{-1000, 1000};
constexpr ConfigRange kPositive{0, 1e6, true};
constexpr ConfigRange kGrey{1, 255};
constexpr ConfigRange kShare{0, 1};
constexpr ConfigRange kCount{0, 100000};
constexpr ConfigRange kSome{1, 100000};

Rows CameraRows(PinholeCamera* camera, double* fps) {
  auto& [k1, k2, p1, p2, k3] = camera->distortion;
  return {
      {"Camera.width", &camera->width, kOptional, kSidePx, "px"},
      {"Camera.height", &camera->height, kOptional, kSidePx, "px"},
      {"Camera.fx", &camera->fx, kRequired, kFocalPx, "px, focal length"},
      {"Camera.fy", &camera->fy, kRequired, kFocalPx, "px"},
      {"Camera.cx", &camera->cx, kRequired, kCentrePx,
       "px, principal point; (0, 0) is the first pixel's centre"},
      {"Camera.cy", &camera->cy, kRequired, kCentrePx, "px"},
      {"Camera.k1", &k1, kOptional, kDistortion, "radial distortion, OpenCV's model"},
      {"Camera.k2", &k2, kOptional, kDistortion},
      {"Camera.p1", &p1, kOptional, kDistortion, "tangential distortion"},
      {"Camera.p2", &p2, kOptional, kDistortion},
      {"Camera.k3", &k3, kOptional, kDistortion, "radial distortion"},
      {"Camera.readout",
       &camera->readout_s,
       kOptional,
       {0, 1},
       "s, rolling shutter: first row to last; 0: none"},
      {"Camera.fps", fps, kOptional, {0, 1000, true}, "frames a second"},
  };
}

Rows DepthRows(DepthModel* depth) {
  return {
      {"Camera.bf", &depth->baseline_times_fx, kRequired, kPositive,
       "px * m, baseline of the virtual right camera * fx"},
      {"ThDepth", &depth->close_limit_baselines, kRequired, kPositive, "baselines; a nearer point is close"},
      {"DepthMapFactor", &depth->units_per_metre, kRequired, kPositive,
       "units of the depth image in a metre"},
  };
}

Rows OrbRows(OrbExtractorOptions* orb) {
  return {
      {"ORBextractor.nFeatures", &orb->num_features, kRequired, {50, 20000}, "wanted in an image"},
      {"ORBextractor.scaleFactor",
       &orb->scale_factor,
       kRequired,
       {1, 2, true},
       "between levels of the pyramid"},
      {"ORBextractor.nLevels", &orb->num_levels, kRequired, {1, 16}, "of the pyramid"},
      {"ORBextractor.iniThFAST", &orb->fast_threshold, kRequired, kGrey, "grey levels"},
      {"ORBextractor.minThFAST", &orb->min_fast_threshold, kRequired, kGrey,
       "grey levels, where the first finds nothing"},
  };
}

Rows TrackingRows(TrackingOptions* tracking, KeyFramePolicyOptions* keyframes) {
  return {
      {"Tracking.minInitialDepthPoints", &tracking->min_initial_depth_points, kOptional, kSome,
       "to start a map"},
      {"Tracking.minInliers", &tracking->min_local_inliers, kOptional, kSome,
       "map points; with fewer the camera is lost"},
      {"Tracking.minRelocalizedInliers", &tracking->min_relocalized_inliers, kOptional, kSome,
       "the same when it was lost before"},
      {"Tracking.maxSpeed", &tracking->max_speed_mps, kOptional, kPositive,
       "m/s, of the camera; a pose that is farther from the last one is wrong"},
      {"Tracking.maxLocalKeyFrames", &tracking->max_local_keyframes, kOptional, kSome,
       "whose points are looked for in a frame"},
      {"Tracking.revisionDelay",
       &tracking->revision_delay_s,
       kOptional,
       {0, 60},
       "s, after which a frame's pose is looked for again, for the trajectory; 0: never"},
      {"Tracking.maxKeyFrameInterval", &keyframes->max_interval_s, kOptional, kPositive,
       "s, between keyframes while something new is seen"},
      {"Tracking.minTrackedRatio", &keyframes->min_tracked_ratio, kOptional, kShare,
       "of the reference keyframe's points; below, a keyframe is made"},
      {"Tracking.minTrackedRatioAll", &keyframes->min_tracked_ratio_all, kOptional, kShare,
       "of all of them, those too that no other keyframe has seen yet; likewise"},
      {"Tracking.minDepthPoints", &keyframes->min_depth_points, kOptional, kCount,
       "made at a keyframe, nearest first, even beyond ThDepth"},
  };
}

Rows MappingRows(MappingOptions* mapping) {
  return {
      {"LocalMapping.minFoundRatio", &mapping->min_found_ratio, kOptional, kShare,
       "of the frames that should see a young point; below, it is erased"},
      {"LocalMapping.triangulationNeighbors", &mapping->triangulation_neighbors, kOptional, kCount,
       "keyframes that new points are made with"},
      {"LocalMapping.maxBundleKeyFrames", &mapping->max_bundle_keyframes, kOptional, kSome,
       "that move in a local bundle adjustment"},
      {"LocalMapping.maxBundleFixed", &mapping->max_bundle_fixed, kOptional, kSome,
       "that hold them in place"},
      {"LocalMapping.redundantRatio", &mapping->redundant_ratio, kOptional, kShare,
       "of a keyframe's points seen by others, to erase it"},
      {"LocalMapping.adjustAtEnd",
       &mapping->adjust_at_end,
       kOptional,
       {},
       "all keyframes at once when a sequence ends"},
  };
}

Rows MotionRows(MotionPrior* motion) {
  return {
      {"Trajectory.acceleration",
       &motion->acceleration_mps2,
       kOptional,
       {0, 1000},
       "m/s^2, as the camera's usually is, by which trajectories are smoothed; 0: they are not"},
      {"Trajectory.angularAcceleration",
       &motion->angular_acceleration_radps2,
       kOptional,
       {0, 1000},
       "rad/s^2, likewise"},
  };
}

Rows LoopRows(bool* closes_loops, LoopOptions* loops) {
  return {
      {"LoopClosing.enabled", closes_loops, kOptional, {}, "needs a vocabulary"},
      {"LoopClosing.minKeyFramesBetween", &loops->min_keyframes_between, kOptional, kCount, "two loops"},
      {"LoopClosing.minConsistency", &loops->min_consistency, kOptional, kSome,
       "keyframes in a row that see the same place"},
      {"LoopClosing.minInliers", &loops->min_inliers, kOptional, kSome, "matches that agree with the motion"},
      {"LoopClosing.minTotalMatches", &loops->min_total_matches, kOptional, kSome,
       "those of the place's neighbours included"},
  };
}

Rows DetectorRows(bool* detects_motion, bool* doubts_near_points, DynamicDetectorOptions* options) {
  return {
      {"DynamicDetector.enabled", detects_motion, kOptional, {}, "look for moving objects"},
      {"DynamicDetector.useFarPoints",
       doubts_near_points,
       kOptional,
       {},
       "far map points contradict near ones; full mode"},
      {"DynamicDetector.mode",
       ConfigEnum(&options->mode),
       kOptional,
       {},
       "all evidence, or the published method alone",
       {"full", "paper"}},
      {"DynamicDetector.keyFrameInterval",
       &options->references.keyframe_interval,
       kOptional,
       {1, 1000},
       "frames, between the past views that the present one is held against"},
      {"DynamicDetector.maxKeyFrames",
       &options->references.max_keyframes,
       kOptional,
       {1, 100},
       "of these views, fewer the older they are"},
      {"DynamicDetector.maxKeyFrameAge",
       &options->references.max_age_frames,
       kOptional,
       {1, 100000},
       "frames, of the oldest: how long one who pauses stays masked"},
      {"DynamicDetector.minCells", &options->segmentation.min_cells, kOptional, kSome,
       "of 4 x 4 px, that an object must have"},
      {"DynamicDetector.maxSpeed",
       &options->histogram.max_speed_mps,
       kOptional,
       {0, 100, true},
       "m/s, of objects in the motion histogram"},
      {"DynamicDetector.maxMaskedShare", &options->fail_open.max_masked_share, kOptional, kShare,
       "of the image; with more for long, the mask is taken for an error"},
  };
}

Rows MaskRows(int* margin_px) {
  return {{"Masks.margin",
           margin_px,
           kOptional,
           {0, 100},
           "px, by which ready-made masks are widened: corners on a silhouette move along"}};
}

/// Each source of evidence can be left out, to see what it is worth: what speaks for or against a cluster,
Rows EvidenceRows(FusionOptions* fusion) {
  return {
      {"DynamicDetector.useFreeSpace",
       &fusion->use_free_space,
       kOptional,
       {},
       "stands where a past view saw through"},
      {"DynamicDetector.useCarry", &fusion->use_carry, kOptional, {}, "moved in the last frame"},
      {"DynamicDetector.useFlow",
       &fusion->use_klt_residual,
       kOptional,
       {},
       "corners do not move as the camera says"},
      {"DynamicDetector.useAttachment",
       &fusion->use_attachment,
       kOptional,
       {},
       "continues into what is static"},
      {"DynamicDetector.useThickness", &fusion->use_thickness, kOptional, {}, "is thin, as edges are"},
      {"DynamicDetector.useHistogram",
       &fusion->use_histogram,
       kOptional,
       {},
       "nine frames show it displaced"},
  };
}

/// and what decides which cells are asked, or belong to it.
Rows SurfaceRows(DynamicDetectorOptions* options) {
  return {
      {"DynamicDetector.useSliding",
       &options->sliding.use_sliding,
       kOptional,
       {},
       "texture slides where depth rests"},
      {"DynamicDetector.useSlowFlow",
       &options->slow_flow.use_slow_flow,
       kOptional,
       {},
       "corners of half a second ago do not rest"},
      {"DynamicDetector.useFarMotion",
       &options->camera_motion.far.use_far_motion,
       kOptional,
       {},
       "what is far, alone, contradicts what is near"},
      {"DynamicDetector.usePlanes",
       &options->segmentation.use_planes,
       kOptional,
       {},
       "large flat parts are judged by themselves"},
      {"DynamicDetector.useWholeThings",
       &options->whole_things.use_whole_things,
       kOptional,
       {},
       "hangs together with what moves"},
      {"DynamicDetector.useHindsight",
       &options->hindsight.use_hindsight,
       kOptional,
       {},
       "later frames see through where it stood"},
      {"DynamicDetector.usePresence",
       &options->presence.use_presence,
       kOptional,
       {},
       "small masks wait until something has surely moved"},
      {"DynamicDetector.useVelocity",
       &options->histogram.use_velocity,
       kOptional,
       {},
       "speeds of objects, for the report"},
  };
}

Rows GrowthRows(GrowthOptions* growth) {
  return {
      {"DynamicDetector.useGrowth", &growth->use_growth, kOptional, {}, "into pixels without depth"},
      {"DynamicDetector.useBackground",
       &growth->use_background,
       kOptional,
       {},
       "there: looks unlike the static scene"},
      {"DynamicDetector.useCorners",
       &growth->use_corners,
       kOptional,
       {},
       "there: flow against the camera's motion"},
  };
}

}  // namespace

std::vector<ConfigRow> DescribeSettings(Settings* settings) {
  Rows all;
  const auto add = [&](Rows rows) { std::ranges::move(rows, std::back_inserter(all)); };
  add(CameraRows(&settings->camera, &settings->fps));
  add(DepthRows(&settings->depth));
  add(OrbRows(&settings->orb));
  add(TrackingRows(&settings->tracking, &settings->keyframes));
  add(MappingRows(&settings->mapping));
  add(MotionRows(&settings->motion));
  add(LoopRows(&settings->closes_loops, &settings->loops));
  DynamicDetectorOptions& detector = settings->detector;
  add(DetectorRows(&settings->detects_motion, &settings->doubts_near_points, &detector));
  add(EvidenceRows(&detector.fusion));
  add(SurfaceRows(&detector));
  add(GrowthRows(&detector.growth));
  add(MaskRows(&settings->user_mask_margin_px));
  return all;
}

}  // namespace orbslam
