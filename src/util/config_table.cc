// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/config_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <type_traits>

#include "orbslam/util/text.h"

namespace orbslam {
namespace {

/// The double that the shortest decimal of a float names: 0.1, not 0.10000000149.
double Shortest(float value) {
  std::array<char, 32> text;
  const auto written = std::to_chars(text.begin(), text.end(), value);
  double result = value;
  std::from_chars(text.begin(), written.ptr, result);
  return result;
}

struct ReadRow {
  const ConfigRow& row;
  ConfigReader* reader;

  template <class T>
  std::optional<T> Default(const T& value) const {
    return row.presence == ConfigRow::kRequired ? std::nullopt : std::optional<T>(value);
  }
  void operator()(double* value) const { *value = reader->GetDouble(row.key, row.range, Default(*value)); }
  void operator()(float* value) const {
    *value = static_cast<float>(reader->GetDouble(row.key, row.range, Default(Shortest(*value))));
  }
  void operator()(const ConfigEnum& value) const {
    const std::string name = row.choices[value.get(value.value)];
    const std::string chosen = reader->GetString(row.key, row.choices, Default(name));
    const auto found = std::ranges::find(row.choices, chosen);
    if (found != row.choices.end()) value.set(value.value, static_cast<int>(found - row.choices.begin()));
  }
  void operator()(int* value) const { *value = reader->GetInt(row.key, row.range, Default(*value)); }
  void operator()(bool* value) const { *value = reader->GetBool(row.key, Default(*value)); }
  void operator()(std::string* value) const {
    *value = reader->GetString(row.key, row.choices, Default(*value));
  }
};

struct ValueText {
  std::string operator()(double value) const { return FormatDouble(value); }
  std::string operator()(int value) const { return std::to_string(value); }
  std::string operator()(bool value) const { return value ? "1" : "0"; }
  std::string operator()(const std::string& value) const {
    std::string quoted = "\"";
    for (const char c : value) quoted += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string{c};
    return quoted + '"';
  }
};

std::string_view SectionOf(std::string_view key) { return key.substr(0, key.find('.')); }

}  // namespace

std::variant<double, int, bool, std::string> ValueOf(const ConfigRow& row) {
  using Value = std::variant<double, int, bool, std::string>;
  return std::visit(
      [&]<class T>(const T& value) -> Value {
        if constexpr (std::is_same_v<T, ConfigEnum>) {
          return row.choices[value.get(value.value)];
        } else if constexpr (std::is_same_v<T, float*>) {
          return Shortest(*value);
        } else {
          return *value;
        }
      },
      row.value);
}

void ReadConfigRows(std::span<const ConfigRow> rows, ConfigReader* reader) {
  for (const ConfigRow& row : rows) std::visit(ReadRow{row, reader}, row.value);
}

std::string WriteConfigRows(std::span<const ConfigRow> rows) {
  std::string yaml = "%YAML:1.0\n---\n";
  std::string_view section;
  for (const ConfigRow& row : rows) {
    if (SectionOf(row.key) != section) yaml += '\n';
    section = SectionOf(row.key);
    yaml += row.key + ": " + std::visit(ValueText(), ValueOf(row));
    yaml += row.comment.empty() ? "\n" : "  # " + row.comment + '\n';
  }
  return yaml;
}

}  // namespace orbslam
