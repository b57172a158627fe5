// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

#include "system/synthetic_run.h"
#include "util/temp_dir.h"

namespace orbslam::test {

inline constexpr RunMode kDataset{}, kLive{.is_live = true};

/// Moves fast, so that keyframes come often; small, so that ThreadSanitizer is done in time.
inline const Recording& Walk() {
  static const Recording recording(Motion::kLoop, 320, 30, /*stride=*/5);
  return recording;
}

/// Once round the room and a quarter.
inline const Recording& Round() {
  static const Recording recording(Motion::kLoop, 320, 112, /*stride=*/8);
  return recording;
}

inline System MakeSystem(RunMode mode, int num_features = 300) {
  return System(SettingsFor(Walk().camera(), num_features), {.mode = mode, .vocabulary = ShippedVocabulary()});
}

inline int NumSavedPoses(const System& system) {
  const TempDir dir;
  EXPECT_TRUE(system.SaveTrajectory(dir.Path("camera.txt")).ok());
  return static_cast<int>(ReadTrajectory(dir.Path("camera.txt")).value().size());
}

/// Shutdown promises two seconds; a sanitizer may take several times as long for the same work.
inline std::chrono::duration<double> ShutdownLimit() {
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
  return std::chrono::seconds(10);
#else
  return std::chrono::seconds(2);
#endif
}

}  // namespace orbslam::test
