// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace orbslam {

// All parameters of DynamicDetector. A grey pixel is 1/320 of the image's width, a cell twice that. "sigma"
// is that of the quantity's own noise: depth after DepthModel::SigmaM. Log-odds are natural; + 1 makes
// "moves" 2.7 times as likely. Where a source is not named, the number follows from the reason given.

/// kPaper: the published algorithm alone, with ego-motion compensation. kFull: all evidence.
enum class DetectorMode { kFull, kPaper };

/// Corners that are followed from frame to frame.
struct CornerOptions {
  int columns = 16, rows = 12;  // cells of the grid over the image in which corners compete
  int per_cell = 2;             // strongest corners kept in each: 384 at most
  int fast_threshold = 10;      // grey levels: 3 sigma of the difference of two pixels of a reduced image
};

/// Lucas-Kanade on patches of 12 x 12 grey pixels.
struct FlowOptions {
  int max_iterations = 8;            // Gauss-Newton steps a level
  float min_step_px = 0.03f;         // converged: a tenth of the noise of the flow;
  float min_coarse_step_px = 0.1f;   // on coarser levels, which only lead the way
  float min_texture = 2.5f;          // smaller eigenvalue of the mean structure tensor, (grey levels / px)^2
  float max_difference_grey = 20.f;  // mean absolute difference of the patches in the end
};

/// The camera's motion from corners.
struct PoseFromCornersOptions {
  int num_draws = 80;      // at most: with 60 % outliers, 99 % certain to draw three inliers at least once
  double max_missed = 0.01;  // they end when, of inliers as many as the best pose has, this is the chance
                             // that no three were drawn together
  float inlier_px = 0.4f;  // grey px: 3 sigma of the flow where pictures blur. With 1 px, one who walks
                           // slowly passes for the room
  double sigma_px = 0.7;   // grey px, of a corner's place: flow, depth and rolling shutter
  int min_inliers = 12;    // twice the unknowns, each giving two equations
};

/// The depth camera's motion.
struct IcpOptions {
  int stride = 2;                      // cells between the points used, in the last iterations
  int iterations = 5;                  // the first two with twice the stride
  double prior_translation_m = 0.002;  // sigma of the initial pose: colour and depth are 15 ms apart, and
  double prior_rotation_rad =
      0.003;                     // a hand accelerates by 4 m/s^2 and 6 rad/s^2 in the 30 ms between frames
  float max_distance_m = 0.10f;  // of a pair along the normal: farther is another surface
  float gate_sigma = 3.f;        // what fits; the weights (Tukey's biweight) end at twice that
  double independent_share = 1;  // of the points, when their sum is weighed against the prior
};

/// The camera's motion by far things alone, over half a second: where near ones contradict it, they move.
struct FarMotionOptions {
  bool use_far_motion = true;
  int min_near = 8, min_far = 30;  // corners: a thing of some size; five for each unknown
  double min_far_share = 0.6;      // of the far corners, that agree: what is far is one, and so the room
  double min_deviation_px = 2;  // grey px, of a near corner: 1 cm at a distance of 1.3 m. In rooms where all
  double min_sigmas = 4;        // rests, half of them never reach both this and that many sigmas
  double clock_share = 0.15;    // of the motion between frames: sigma of what colour and depth see of it ...
  double least_clock = 0.0007;  // ... and of the rest; rad, m
  int stride = 4, iterations = 3;  // of the alignment, as of a keyframe's
  int min_pairs = 60;              // ten for each unknown
  double min_fit_share = 0.6;      // of them, within 3 sigma
  int reach_cells = 40;            // how far a corner speaks for the surface it is on: half a person's height
};

struct CameraMotionOptions {
  FlowOptions flow;
  // Its inlier_px is the largest; mostly it follows the last frame's noise, for in sharp pictures somebody
  // who starts to walk would fit together with the room.
  PoseFromCornersOptions pose;
  float inlier_quartiles = 3.f;  // of the resting corners' residuals: 2.3 sigma, were they Gaussian
  float min_inlier_px = 0.2f;  // grey px: 3 sigma of flow at its best; tighter, a board before the lens wins
  IcpOptions icp;
  FarMotionOptions far;
  // Depth follows a person who walks along a wall, which itself says nothing of that direction. It is
  // believed if it differs from the corners' motion by no more than sigmas of its prior and what the clocks
  // explain.
  double max_depth_sigmas = 2.5;
  double max_clock_share =
      0.25;            // of the motion: colour and depth are up to half an interval apart, and that varies
  int far_target = 8;  // frames back: second target of the alignment, against drift
  int min_inliers_with_depth = 6;  // corners, where the depth's motion is their prior: that is worth six others
  double min_fit_share = 0.5;  // of the paired depth within the gate; below, the motion is not trusted
};

/// Frames of the past against which the present one is judged.
struct ReferenceOptions {
  int num_recent = 8;                  // kept one by one: the histogram's rows
  int keyframe_interval = 10;          // frames: a person walks half a metre, more than his depth
  int max_keyframes = 8;               // their ages grow geometrically, ...
  int max_age_frames = 300;            // ... up to 10 s: how long one who stands still stays masked
  double prior_translation_m = 0.002;  // sigma of a carried pose before its own alignment: of one frame,
  double prior_rotation_rad = 0.002;   // since it was aligned to the last
  int stride = 4, iterations = 3;      // of that alignment
  double doubtful_share = 0.1;         // of its points count as independent, for as long as ...
  int doubtful_frames = 30;            // ... after depth was not believed: a person walks past in a second
  double min_fit_share = 0.6;          // of the paired points within 3 sigma; else it is not asked. With the
                                       // right pose 0.7 and more do, with any other a third
  int min_pairs = 60;                  // ten for each unknown
  double max_bend_rad = 0.025;         // three cells of a Kinect: bent by more, against the present one, by a
                                       // rolling shutter, a view loses half its vote; bent by twice that, all
  int max_unaligned = 30;              // frames after which it is forgotten: 1 s, someone walks past
};

/// Free space: what stands where a reference saw through, has moved there.
struct FreeSpaceOptions {
  float gate_sigma = 4.f;            // of the depth noise: one false vote in 30000
  float margin_m = 0.01f;            // systematic depth error between two views at 0 m ...
  float margin_per_metre = 0.3f;     // ... and its growth, share a metre of depth
  float drift_m = 0.0004f;           // growth of the margin a frame of age: what the alignment leaves
  float min_votes = 0.9f;            // free less half of the static votes
  int min_suspicious_neighbors = 4;  // of the 3 x 3 cells: noise and edges are thinner
};

/// What later frames show of earlier ones: what has gone since moved, though nobody knew then.
struct HindsightOptions {
  bool use_hindsight = true;
};

/// From which residual on a corner moves: as many times what those have that rested in the last mask.
struct CornerGateOptions {
  double quantile = 0.25;  // of the resting corners' residuals: who begins to move is among them, up to half
  float multiple = 15.f;   // of that quantile: nine sigma or more, for blur has long tails
  float min_px = 0.4f;     // grey px: what the camera's own motion is fitted with where pictures blur
  float max_px = 3.f;      // grey px, 3 sigma in the worst pictures
  float max_sharp_px = 1.2f;  // gate of a sharp picture: in others blur and the rolling shutter let static
                              // surfaces slide too
  int min_resting = 20;       // corners, for the quantile; with fewer the gate is the largest
};

/// Corners followed from a keyframe: who sways, breathes or sets off moves too little from one frame to the
/// next.
struct SlowFlowOptions {
  bool use_slow_flow = true;
  int age_frames = 15;  // of the keyframe, half a second: who sits sways by 1 cm in it, 2 grey px at 1.5 m
  int long_age_frames = 30;  // of another one, for who begins more slowly still
  // Four sigma, for half a second averages blur; but in it a rolling shutter bends the picture further.
  CornerGateOptions gate{.multiple = 5.f, .max_sharp_px = 0.65f};
  float min_sharpness = 0.5f;  // below 1 it only holds what moves already, for who sways may seem to rest
};

/// Surfaces that slide within themselves: what depth alone would confirm as static, but corners see moving.
struct SlidingOptions {
  bool use_sliding = true;
  float radius_px = 25.f;     // grey px, of the neighbours asked: one cell of the corners' grid around
  float depth_share = 0.15f;  // of the depth, by which neighbours on one thing may differ: half a person
  int min_neighbors = 5;      // that can be asked, itself included
  float min_likeness = 0.7f;  // length of the sum of their motions as share of the sum of lengths: 45 degrees
  int max_steps = 6;          // cells from a corner: half the distance between corners
};

struct SegmentationOptions {
  int min_cells = 20;         // the published 200 points are of a voxel grid; a hand at 2 m is 25 cells
  bool use_planes = true;     // large flat parts are judged by themselves
  float min_plane_m2 = 0.5f;  // what is as large and flat is a floor, a wall, a table, not a part of a person
};

/// What hangs together with something that moves.
struct WholeThingOptions {
  bool use_whole_things = true;
  int min_moving_cells = 100;     // a forearm at 2 m
  float min_moving_share = 0.1f;  // of the thing: an arm is a tenth of a person
  float reach_m = 1.f;            // from what moves: half a person's height
  float min_plane_m2 = 0.15f;     // what is as large and flat is furniture: a back is narrower, or rounder
  float log_odds = 0.5f;    // that such a cell moves: next time it needs evidence of its own, but little
  int min_age_frames = 15;  // of the references that root: half a second, in which who sways has moved
  float gate_sigma = 2.f;   // of what they root: the depth noise of most cells,
  float margin_m = 0.005f;  // and what the alignment leaves
};

/// Evidence about a cluster, log-odds.
struct FusionOptions {
  bool use_free_space = true, use_carry = true, use_klt_residual = true, use_attachment = true,
       use_thickness = true, use_histogram = true;
  float prior = -1.5f;             // that something moves of which no reference can say anything: one in five
  float free_share = 0.22f;        // of suspicious among judged cells: no evidence either way
  float free_gain = 10.f;          // a unit of that share
  float min_judged_share = 0.15f;  // of a cluster, that must be judged for the share to count in full
  float carry_gain = 0.6f;         // of the log-odds of what was there in the last frame
  float corner_gain = 0.5f;        // a moving corner; a resting one counts a fifth, against
  float max_resting = 1.5f;        // bound of that against: who pauses rests too
  float max_corner = 5.f;        // bound of that for, in a sharp picture: ten corners, which cannot all err;
                                 // else less by the square of the noise, for they can all share an error
  float attachment_gain = 3.f;   // against, a border that continues into static surfaces all round
  float free_attachment = 0.4f;  // share of such border that is normal: feet, a hand on the table
  float max_thin = 2.f;          // against, a cluster nowhere three cells wide,
  float thick_share = 0.2f;      // up to this share of interior cells (of a strip four cells wide: 0.5)
  float histogram_gain = 0.5f;   // a unit of (line integral / tau - 1)
  float max_histogram = 1.f;     // bound of the histogram's part
  float undecided = 2.f;         // log-odds within which the histogram is asked
};

/// Cells without depth, log-odds a frame.
struct GrowthOptions {
  bool use_growth = true;        // into cells without depth at all
  bool use_background = true;    // appearance against the static scene that references let expect
  bool use_corners = true;       // flow against the camera's motion
  int max_steps = 12;            // cells, how far from a moving cell: a tenth of the image's height
  int free_steps = 3;            // silhouettes that the sensor loses
  float similar_gray = 15.f;     // grey levels between neighbours of one thing
  float noise_gray = 12.f;       // grey levels: 3 sigma of noise and of what the reduction leaves
  float prior = -0.15f;          // without evidence: things rest
  float differs = 0.6f;          // looks other than the static scene there;
  float agrees = -0.6f;          // like it. Both small, for errors last from frame to frame
  float corner_moves = 0.8f;     // a corner nearby does not move as the static scene,
  float corner_rests = -0.5f;    // does
  float contact = 0.5f;          // connected to a moving cell that has depth; when growing, within free_steps of it,
  float memory = 0.9f;           // share of the last frame's that is kept: a third of a second
  float similar_contact = 0.3f;  // beyond it, of similar grey,
  float other_contact = -1.5f;   // not of similar grey
};

/// The 9-frame motion histogram (motion_histogram.h).
struct HistogramOptions {
  bool use_velocity = true;    // of the objects, for the report
  int max_clusters = 3;        // a frame, largest first: bounds the time
  int min_cells = 50;          // the published 200 points, at the cloud's stride
  int stride = 2;              // cells between the cloud's points
  float max_speed_mps = 1.5f;  // a brisk walk
};

/// Whether anything moves in the scene at all.
struct PresenceOptions {
  bool use_presence = true;
  double min_share = 0.03;    // of the image, of one object: a person at 5 m, where depth is still good;
  double min_log_odds = 2.2;  // or of it on average, with its rim: nine to one that it moves;
  double min_age_s = 1;       // or for so long in view: a reference that drifts is aligned anew by then
  double memory_s = 3;        // as long as the references go back: who was here may come again
};

/// When not to mask.
struct FailOpenOptions {
  double max_gap_s = 0.25;         // between two frames: over more, corners and ICP lose their way
  int max_untrusted_frames = 15;   // half a second on what was moving before; then nothing is masked
  double max_masked_share = 0.95;  // of the image: nothing is left to hold on to. Someone who passes closely
  int max_covered_frames = 15;     // does that for half a second; longer, it is our error
  // In the first frames there is little to compare with, and no motion to expect: what moves alike in most of
  // the picture is then the room.
  int early_frames = 4;
  double max_early_share = 0.5;
};

struct DynamicDetectorOptions {
  DetectorMode mode = DetectorMode::kFull;
  CornerOptions corners;
  CameraMotionOptions camera_motion;
  ReferenceOptions references;
  FreeSpaceOptions free_space;
  HindsightOptions hindsight;
  CornerGateOptions corner_gate;
  SlowFlowOptions slow_flow;
  SlidingOptions sliding;
  SegmentationOptions segmentation;
  WholeThingOptions whole_things;
  FusionOptions fusion;
  GrowthOptions growth;
  HistogramOptions histogram;
  PresenceOptions presence;
  FailOpenOptions fail_open;
};

}  // namespace orbslam
