// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "orbslam/loop/loop_closing.h"
#include "orbslam/mapping/local_mapping.h"
#include "orbslam/pipeline/edit_turn.h"
#include "orbslam/system/run_mode.h"
#include "orbslam/system/settings.h"
#include "orbslam/system/trajectory_log.h"
#include "orbslam/tracking/tracking.h"
#include "orbslam/util/stage.h"

namespace orbslam {

/// One map and everything that works on it: Tracking on the caller's thread, LocalMapping and LoopClosing as
/// stages behind it, global bundle adjustment beside them.
class MapSession {
 public:
  /// vocabulary may be nullptr: then no loops are closed. A map that is not empty is known already.
  MapSession(const Sensor& sensor, const Settings& settings, RunMode mode,
             std::shared_ptr<const Vocabulary> vocabulary, MapData map);

  FrameReport Track(const RgbdImage& image, const MaskOfFrame& mask_of_frame);

  /// Waits until all that was handed over is worked into the map, a global bundle adjustment included.
  void WaitUntilIdle();
  /// Finishes what is queued and joins. A global bundle adjustment gets max_wait to finish, then is given up.
  void Stop(std::chrono::milliseconds max_wait = std::chrono::milliseconds(1000));
  /// Bundle adjustment of all keyframes, if there are new ones; to be called when stopped.
  void AdjustWholeMap(std::stop_token stop);

  /// In localisation mode the map stays as it is.
  void SetLocalizationMode(bool is_on);

  const Map& map() const { return map_; }
  const TrajectoryLog& trajectory() const { return trajectory_; }
  int num_loops() const { return loop_closing_ ? loop_closing_->num_loops() : 0; }
  /// What a stage died of, if one did.
  std::optional<Error> failure() const;
  /// To be called when idle or stopped.
  std::map<std::string, StageTimer::Statistics> Timings() const;

 private:
  MapperLoad Load() const;
  void HandOver(KeyFrameReady message);
  void RunMapping(const KeyFrameReady& message);

  const Sensor& sensor_;
  const RunMode mode_;
  const LoopOptions loop_options_;
  Map map_;
  EditTurn turn_;
  std::optional<PlaceIndex> places_;
  Tracking tracking_;
  LocalMapping mapping_;
  std::optional<LoopClosing> loop_closing_;
  TrajectoryLog trajectory_;
  bool has_grown_ = false;  // written by local mapping alone, read when that has been joined
  StageTimer timer_;
  // Last, so that they are joined before what they work on goes away; LoopClosing's first, since mapping
  // feeds it.
  Stage<KeyFrameMapped> loop_stage_;
  Stage<KeyFrameReady> mapping_stage_;
};

}  // namespace orbslam
