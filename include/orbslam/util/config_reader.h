// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "orbslam/util/result.h"

namespace orbslam {

/// The values that a number in a settings file may have: [min, max], or (min, max] without the minimum
/// itself.
struct ConfigRange {
  double min = std::numeric_limits<double>::lowest();
  double max = std::numeric_limits<double>::max();
  bool excludes_min = false;

  bool Contains(double value) const { return (excludes_min ? value > min : value >= min) && value <= max; }
  /// As in "[1, 255]".
  std::string Describe() const;
};

/// One "key: value" of a settings file; nested maps are flattened, "Camera: {fx: 1}" is "Camera.fx: 1".
struct ConfigEntry {
  enum class Kind { kPlain, kQuoted, kEmpty, kList, kMatrix };
  Kind kind = Kind::kPlain;
  std::string text;
  int line = 0;
};

/// Reads settings strictly. Each getter asks for one key, and thereby makes it known; what is wrong with it
/// is noted and its default returned, so that all keys are looked at before Finish() tells. The file is YAML
/// as OpenCV writes it and ORB-SLAM2's users have it: "%YAML:1.0" or "---" or neither first, CRLF and a byte
/// order mark allowed.
class ConfigReader {
 public:
  /// Error, one line: missing, a directory, not readable, empty, not YAML (with the line), or a key given
  /// twice.
  static Result<ConfigReader> Open(const std::string& path);
  /// The same for a text; name stands for the path in messages.
  static Result<ConfigReader> Parse(std::string_view content, const std::string& name);

  /// Required: no default. Only finite numbers; only whole ones for an int.
  double GetDouble(const std::string& key, const ConfigRange& range,
                   std::optional<double> default_value = {});
  int GetInt(const std::string& key, const ConfigRange& range, std::optional<int> default_value = {});
  /// true, false, 1 or 0.
  bool GetBool(const std::string& key, std::optional<bool> default_value = {});
  /// One of choices, or any text if there are none.
  std::string GetString(const std::string& key, const std::vector<std::string>& choices = {},
                        const std::optional<std::string>& default_value = {});

  /// Makes known, without reading it, a key or, ending in a dot, all keys that begin so.
  void Ignore(const std::string& key) { ignored_.push_back(key); }
  /// Notes an error about the value of a key, such as that it does not fit another's.
  void AddError(const std::string& key, const std::string& message);

  /// Done, or all errors, a line each: file, line, key, what was found and what is allowed.
  Status Finish() const;
  /// A line for each key that nobody asked for, with the known key that it resembles.
  std::vector<std::string> Warnings() const;

 private:
  const ConfigEntry* Find(const std::string& key, bool required, const std::string& expected);
  void AddMismatch(const std::string& key, const std::string& expected);
  bool IsKnown(const std::string& key) const;

  std::string name_;
  std::map<std::string, ConfigEntry> entries_;
  std::set<std::string> asked_;
  std::vector<std::string> ignored_;
  struct MissingKey {
    std::string key, expected;
  };
  std::vector<MissingKey> missing_;
  std::vector<std::string> errors_;
};

}  // namespace orbslam
