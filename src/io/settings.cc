// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/io/settings.h"

#include "orbslam/util/config_reader.h"
#include "orbslam/util/config_table.h"

namespace orbslam {
namespace {

constexpr ConfigRange kSidePx{1, 16384};
constexpr ConfigRange kFocalPx{0, 1e5, true};
constexpr ConfigRange kCentrePx{-16384, 16384};  // of a cropped image it may lie outside
constexpr ConfigRange kDistortion{-1000, 1000};
constexpr ConfigRange kPositive{0, 1e6, true};
constexpr ConfigRange kGrey{1, 255};

/// Every key: where it is kept, whether it may be left out, what is allowed, and what it means.
std::vector<ConfigRow> Describe(Settings* settings) {
  constexpr auto kRequired = ConfigRow::kRequired;
  constexpr auto kOptional = ConfigRow::kOptional;
  auto& [camera, fps, depth, orb] = *settings;
  auto& [k1, k2, p1, p2, k3] = camera.distortion;
  return {
      {"Camera.width", &camera.width, kOptional, kSidePx, "px"},
      {"Camera.height", &camera.height, kOptional, kSidePx, "px"},
      {"Camera.fx", &camera.fx, kRequired, kFocalPx, "px, focal length"},
      {"Camera.fy", &camera.fy, kRequired, kFocalPx, "px"},
      {"Camera.cx", &camera.cx, kRequired, kCentrePx,
       "px, principal point; (0, 0) is the first pixel's centre"},
      {"Camera.cy", &camera.cy, kRequired, kCentrePx, "px"},
      {"Camera.k1", &k1, kOptional, kDistortion, "radial distortion, OpenCV's model"},
      {"Camera.k2", &k2, kOptional, kDistortion},
      {"Camera.p1", &p1, kOptional, kDistortion, "tangential distortion"},
      {"Camera.p2", &p2, kOptional, kDistortion},
      {"Camera.k3", &k3, kOptional, kDistortion, "radial distortion"},
      {"Camera.fps", &fps, kOptional, {0, 1000, true}, "frames a second"},
      {"Camera.bf", &depth.baseline_times_fx, kRequired, kPositive,
       "px * m, baseline of the virtual right camera * fx"},
      {"ThDepth", &depth.close_limit_baselines, kRequired, kPositive, "baselines; a nearer point is close"},
      {"DepthMapFactor", &depth.units_per_metre, kRequired, kPositive, "units of the depth image in a metre"},
      {"ORBextractor.nFeatures", &orb.num_features, kRequired, {50, 20000}, "wanted in an image"},
      {"ORBextractor.scaleFactor",
       &orb.scale_factor,
       kRequired,
       {1, 2, true},
       "between levels of the pyramid"},
      {"ORBextractor.nLevels", &orb.num_levels, kRequired, {1, 16}, "of the pyramid"},
      {"ORBextractor.iniThFAST", &orb.fast_threshold, kRequired, kGrey, "grey levels"},
      {"ORBextractor.minThFAST", &orb.min_fast_threshold, kRequired, kGrey,
       "grey levels, where the first finds nothing"},
  };
}

}  // namespace

Result<Settings> ReadSettings(const std::string& path, std::vector<std::string>* warnings) {
  Result<ConfigReader> opened = ConfigReader::Open(path);
  if (!opened) return opened.error();
  ConfigReader reader = *std::move(opened);

  Settings settings;
  ReadConfigRows(Describe(&settings), &reader);
  reader.Ignore("Camera.RGB");  // image files say themselves how their channels are ordered
  reader.Ignore("Viewer.");
  const Status status = reader.Finish();
  if (warnings != nullptr) *warnings = reader.Warnings();
  if (!status) return status.error();
  if (settings.orb.min_fast_threshold > settings.orb.fast_threshold) {
    reader.AddError("ORBextractor.minThFAST", "found " + std::to_string(settings.orb.min_fast_threshold) +
                                                  ", expected at most ORBextractor.iniThFAST, " +
                                                  std::to_string(settings.orb.fast_threshold));
    return reader.Finish().error();
  }
  return settings;
}

std::vector<SettingValue> EffectiveSettings(const Settings& settings) {
  Settings copy = settings;
  std::vector<SettingValue> values;
  for (const ConfigRow& row : Describe(&copy)) {
    std::visit([&](const auto* value) { values.push_back({row.key, *value}); }, row.value);
  }
  return values;
}

std::string EffectiveSettingsYaml(const Settings& settings) {
  Settings copy = settings;
  return WriteConfigRows(Describe(&copy));
}

}  // namespace orbslam
