// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/system/settings.h"

#include "orbslam/util/config_reader.h"
#include "settings_table.h"

namespace orbslam {

bool DoubtsNearPoints(const Settings& settings, bool use_detector, bool has_user_mask) {
  const bool detects = use_detector && settings.detects_motion;
  if (detects && settings.detector.mode == DetectorMode::kPaper) return false;
  return settings.doubts_near_points && (detects || has_user_mask);
}

Result<Settings> ReadSettings(const std::string& path, std::vector<std::string>* warnings) {
  Result<ConfigReader> opened = ConfigReader::Open(path);
  if (!opened) return opened.error();
  ConfigReader reader = *std::move(opened);

  Settings settings;
  ReadConfigRows(DescribeSettings(&settings), &reader);
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
  for (const ConfigRow& row : DescribeSettings(&copy)) {
    values.push_back({row.key, ValueOf(row)});
  }
  return values;
}

std::string EffectiveSettingsYaml(const Settings& settings) {
  Settings copy = settings;
  return WriteConfigRows(DescribeSettings(&copy));
}

}  // namespace orbslam
