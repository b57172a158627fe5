// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "orbslam/pipeline/messages.h"
#include "orbslam/pipeline/sensor.h"
#include "orbslam/system/map_session.h"
#include "orbslam/system/mask_supplier.h"
#include "orbslam/system/settings.h"
#include "orbslam/util/result.h"
#include "orbslam/util/stage_timer.h"
#include "orbslam/vocabulary/vocabulary.h"

namespace orbslam {

struct SystemOptions {
  RunMode mode;
  std::shared_ptr<const Vocabulary> vocabulary;  // nullptr: loops are not closed, relocalisation is slower
  double max_lost_s = 2.0;      // a young map in which the camera was lost for so long is left for a new one
  int young_map_keyframes = 5;  // at most so many
  bool use_detector = true;     // look for moving objects, unless the settings say not to
  UserMask user_mask;           // masks of the user's own, united with the detector's
};

/// The whole SLAM system: give it RGB-D frames in order of time, get camera poses, save trajectories.
///
///   orbslam::System slam(*orbslam::ReadSettings("TUM1.yaml", &warnings), {.vocabulary = vocabulary});
///   orbslam::FrameReport report = slam.TrackRgbd(image);   // report.world_from_camera, report.state
///   slam.Shutdown();
///   slam.SaveTrajectory("CameraTrajectory.txt");
///
/// World frame: that of the first tracked camera of a map. To be used from one thread; LocalMapping,
/// LoopClosing, global bundle adjustment and the DynamicDetector run on threads of its own. The destructor
/// joins them.
class System {
 public:
  explicit System(const Settings& settings, SystemOptions options = {});
  ~System();

  /// Tracks the next frame: gray CV_8UC1 and depth_m CV_32FC1 of the settings' size. Its id is set here.
  FrameReport TrackRgbd(RgbdImage image);

  /// Works off what is under way and joins all threads, within two seconds. Trajectories can be saved before
  /// and after; no frame can be tracked after.
  void Shutdown();

  /// Bundle adjustment of all maps with new keyframes, in which frames between them take part, and then all
  /// frames' poses once more: for better trajectories and a better map to save. About two seconds for a
  /// minute of pictures at 30 Hz. To be called after Shutdown. Stopped, it leaves the map as it is.
  void AdjustMaps(std::stop_token stop = {});

  /// Forgets all maps and trajectories and starts again.
  void Reset();

  /// Localisation only: the map stays as it is, frames are tracked in it.
  void ActivateLocalizationMode();
  void DeactivateLocalizationMode();

  /// All tracked frames of the largest map, with the latest estimate of each, smoothed, to `path`; those of
  /// each further map, whose world frame is another, to path with _2, _3, ... before its extension. TUM
  /// format.
  Status SaveTrajectory(const std::string& path) const;
  /// The same for keyframes.
  Status SaveKeyFrameTrajectory(const std::string& path) const;

  /// The present map, versioned and with a checksum.
  Status SaveMap(const std::string& path) const;
  /// Replaces all maps by the saved one, in which the next frames are looked for. The settings must be those
  /// it was made with, as far as features are concerned.
  Status LoadMap(const std::string& path);

  struct Counts {
    int frames = 0;   // given
    int tracked = 0;  // with a pose, over all maps
    int maps = 0;
    int keyframes = 0;  // in the present map
    int map_points = 0;
    int loops = 0;  // closed, over all maps
  };
  Counts counts() const;
  /// The present map. Look at it through its guards at any time.
  const Map& map() const { return sessions_.back()->map(); }
  /// Durations of all stages' steps. To be called after Shutdown.
  std::map<std::string, StageTimer::Statistics> Timings() const;
  /// What an internal thread died of, if one did.
  std::optional<Error> failure() const;

 private:
  void StartMasks();
  void StartSession(MapData map);
  void StartNewMapIfLost(const FrameReport& report);
  std::vector<const MapSession*> SessionsLargestFirst() const;
  /// poses_of(session) -> the poses to be written for it.
  template <class PosesOf>
  Status SaveAll(const std::string& path, PosesOf poses_of) const;

  const Settings settings_;
  const SystemOptions options_;
  const Sensor sensor_;
  std::unique_ptr<MaskSupplier> masks_;
  std::vector<std::unique_ptr<MapSession>> sessions_;  // the present one last
  uint32_t num_frames_ = 0;
  std::optional<double> last_tracked_s_;  // or first given a frame, in the present map
  bool is_localizing_ = false;
};

}  // namespace orbslam
