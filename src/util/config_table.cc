// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/util/config_table.h"

#include <optional>
#include <string_view>

#include "orbslam/util/text.h"

namespace orbslam {
namespace {

struct ReadRow {
  const ConfigRow& row;
  ConfigReader* reader;

  template <class T>
  std::optional<T> Default(const T& value) const {
    return row.presence == ConfigRow::kRequired ? std::nullopt : std::optional<T>(value);
  }
  void operator()(double* value) const { *value = reader->GetDouble(row.key, row.range, Default(*value)); }
  void operator()(int* value) const { *value = reader->GetInt(row.key, row.range, Default(*value)); }
  void operator()(bool* value) const { *value = reader->GetBool(row.key, Default(*value)); }
  void operator()(std::string* value) const {
    *value = reader->GetString(row.key, row.choices, Default(*value));
  }
};

struct ValueText {
  std::string operator()(const double* value) const { return FormatDouble(*value); }
  std::string operator()(const int* value) const { return std::to_string(*value); }
  std::string operator()(const bool* value) const { return *value ? "1" : "0"; }
  std::string operator()(const std::string* value) const {
    std::string quoted = "\"";
    for (const char c : *value) quoted += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string{c};
    return quoted + '"';
  }
};

std::string_view SectionOf(std::string_view key) { return key.substr(0, key.find('.')); }

}  // namespace

void ReadConfigRows(std::span<const ConfigRow> rows, ConfigReader* reader) {
  for (const ConfigRow& row : rows) std::visit(ReadRow{row, reader}, row.value);
}

std::string WriteConfigRows(std::span<const ConfigRow> rows) {
  std::string yaml = "%YAML:1.0\n---\n";
  std::string_view section;
  for (const ConfigRow& row : rows) {
    if (SectionOf(row.key) != section) yaml += '\n';
    section = SectionOf(row.key);
    yaml += row.key + ": " + std::visit(ValueText(), row.value);
    yaml += row.comment.empty() ? "\n" : "  # " + row.comment + '\n';
  }
  return yaml;
}

}  // namespace orbslam
