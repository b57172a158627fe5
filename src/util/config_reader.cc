// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/config_reader.h"

#include <algorithm>
#include <cctype>

#include "flat_yaml.h"
#include "orbslam/util/file.h"
#include "orbslam/util/text.h"

namespace orbslam {
namespace {

std::string Found(const ConfigEntry& entry) {
  switch (entry.kind) {
    case ConfigEntry::Kind::kPlain:
      return "'" + entry.text + "'";
    case ConfigEntry::Kind::kQuoted:
      return "the text \"" + entry.text + "\"";
    case ConfigEntry::Kind::kEmpty:
      return "nothing";
    case ConfigEntry::Kind::kList:
      return "a list";
    case ConfigEntry::Kind::kMatrix:
      return "a matrix";
  }
  return "";
}

std::optional<bool> ParseBool(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  if (text == "1" || text == "true") return true;
  if (text == "0" || text == "false") return false;
  return std::nullopt;
}

std::string Join(const std::vector<std::string>& parts, const std::string& separator) {
  std::string joined;
  for (const std::string& part : parts) joined += (joined.empty() ? "" : separator) + part;
  return joined;
}

/// The candidate that differs in fewest letters, if by so few that a slip of the pen is likely; else empty.
template <class Strings>
std::string NearestKey(const std::string& key, const Strings& candidates) {
  std::string nearest;
  int least = std::max(2, static_cast<int>(key.size()) / 3) + 1;
  for (const std::string& candidate : candidates) {
    const int distance = EditDistance(key, candidate);
    if (distance >= least) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

}  // namespace

std::string ConfigRange::Describe() const {
  const bool is_open_above = max == std::numeric_limits<double>::max();
  if (is_open_above && min == std::numeric_limits<double>::lowest()) return "any";
  if (is_open_above) return std::string(excludes_min ? "more than " : "at least ") + FormatDouble(min);
  return std::string(excludes_min ? "(" : "[") + FormatDouble(min) + ", " + FormatDouble(max) + "]";
}

Result<ConfigReader> ConfigReader::Open(const std::string& path) {
  constexpr size_t kMaxBytes = size_t{16} << 20;
  const Result<std::string> content = ReadFile(path, kMaxBytes);
  if (!content) return content.error();
  if (content->empty()) return Error{path + ": the file is empty"};
  return Parse(*content, path);
}

Result<ConfigReader> ConfigReader::Parse(std::string_view content, const std::string& name) {
  Result<std::map<std::string, ConfigEntry>> entries = ParseFlatYaml(content, name);
  if (!entries) return entries.error();
  ConfigReader reader;
  reader.name_ = name;
  reader.entries_ = *std::move(entries);
  return reader;
}

double ConfigReader::GetDouble(const std::string& key, const ConfigRange& range,
                               std::optional<double> default_value) {
  const std::string expected = "a number in " + range.Describe();
  const ConfigEntry* entry = Find(key, !default_value, expected);
  if (entry == nullptr) return default_value.value_or(0);
  const bool is_plain = entry->kind == ConfigEntry::Kind::kPlain;
  const std::optional<double> value = is_plain ? ParseDouble(entry->text) : std::nullopt;
  if (value && range.Contains(*value)) return *value;
  AddMismatch(key, expected);
  return default_value.value_or(0);
}

int ConfigReader::GetInt(const std::string& key, const ConfigRange& range, std::optional<int> default_value) {
  const std::string expected = "a whole number in " + range.Describe();
  const ConfigEntry* entry = Find(key, !default_value, expected);
  if (entry == nullptr) return default_value.value_or(0);
  const bool is_plain = entry->kind == ConfigEntry::Kind::kPlain;
  const std::optional<int> value = is_plain ? ParseInt(entry->text) : std::nullopt;
  if (value && range.Contains(*value)) return *value;
  AddMismatch(key, expected);
  return default_value.value_or(0);
}

bool ConfigReader::GetBool(const std::string& key, std::optional<bool> default_value) {
  const std::string expected = "true, false, 1 or 0";
  const ConfigEntry* entry = Find(key, !default_value, expected);
  if (entry == nullptr) return default_value.value_or(false);
  const bool is_plain = entry->kind == ConfigEntry::Kind::kPlain;
  if (const std::optional<bool> value = is_plain ? ParseBool(entry->text) : std::nullopt) return *value;
  AddMismatch(key, expected);
  return default_value.value_or(false);
}

std::string ConfigReader::GetString(const std::string& key, const std::vector<std::string>& choices,
                                    const std::optional<std::string>& default_value) {
  const std::string expected = choices.empty() ? "a text" : "one of " + Join(choices, ", ");
  const ConfigEntry* entry = Find(key, !default_value, expected);
  if (entry == nullptr) return default_value.value_or("");
  const bool is_text = entry->kind == ConfigEntry::Kind::kPlain || entry->kind == ConfigEntry::Kind::kQuoted;
  const bool is_choice =
      choices.empty() || std::find(choices.begin(), choices.end(), entry->text) != choices.end();
  if (is_text && is_choice) return entry->text;
  AddMismatch(key, expected);
  return default_value.value_or("");
}

void ConfigReader::AddError(const std::string& key, const std::string& message) {
  const auto entry = entries_.find(key);
  std::string place = name_;
  if (entry != entries_.end()) place += ':' + std::to_string(entry->second.line);
  errors_.push_back(place + ": " + key + ": " + message);
}

Status ConfigReader::Finish() const {
  std::vector<std::string> unknown;
  for (const auto& [key, entry] : entries_) {
    if (!IsKnown(key)) unknown.push_back(key);
  }
  std::vector<std::string> errors = errors_;
  for (const auto& [key, expected] : missing_) {
    const std::string similar = NearestKey(key, unknown);
    const std::string hint = similar.empty() ? ""
                                             : " (is '" + similar + "' in line " +
                                                   std::to_string(entries_.at(similar).line) + " meant?)";
    errors.push_back(name_ + ": " + key + " is missing, expected " + expected + hint);
  }
  if (errors.empty()) return OkStatus();
  return Error{Join(errors, "\n")};
}

std::vector<std::string> ConfigReader::Warnings() const {
  std::vector<std::string> warnings;
  for (const auto& [key, entry] : entries_) {
    if (IsKnown(key)) continue;
    const std::string similar = NearestKey(key, asked_);
    const std::string hint = similar.empty() ? "" : "; is " + similar + " meant?";
    warnings.push_back(name_ + ":" + std::to_string(entry.line) + ": unknown key " + key + " is ignored" +
                       hint);
  }
  return warnings;
}

const ConfigEntry* ConfigReader::Find(const std::string& key, bool required, const std::string& expected) {
  asked_.insert(key);
  const auto entry = entries_.find(key);
  if (entry != entries_.end()) return &entry->second;
  if (required) missing_.push_back({key, expected});
  return nullptr;
}

void ConfigReader::AddMismatch(const std::string& key, const std::string& expected) {
  AddError(key, "found " + Found(entries_.at(key)) + ", expected " + expected);
}

bool ConfigReader::IsKnown(const std::string& key) const {
  return asked_.contains(key) ||
         std::any_of(ignored_.begin(), ignored_.end(), [&](const std::string& ignored) {
           return ignored.ends_with('.') ? key.starts_with(ignored) : key == ignored;
         });
}

}  // namespace orbslam
