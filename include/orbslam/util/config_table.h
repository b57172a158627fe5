// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "orbslam/util/config_reader.h"

namespace orbslam {

/// An enum of the caller's, seen as the number of its value: 0, 1, 2 ...
struct ConfigEnum {
  void* value;
  int (*get)(const void* value);
  void (*set)(void* value, int number);

  template <class Enum>
  explicit ConfigEnum(Enum* target)
      : value(target),
        get([](const void* v) { return static_cast<int>(*static_cast<const Enum*>(v)); }),
        set([](void* v, int number) { *static_cast<Enum*>(v) = static_cast<Enum>(number); }) {}
};

/// All there is to say about one setting. From a list of such rows settings are read, checked and written, so
/// that nothing about a key is said twice. A new key is a new row.
struct ConfigRow {
  enum Presence { kRequired, kOptional };

  std::string key;
  // Where it is kept; holds the default before reading.
  std::variant<double*, float*, int*, bool*, std::string*, ConfigEnum> value;
  Presence presence = kOptional;
  ConfigRange range = {};                 // of numbers
  std::string comment = {};               // unit and meaning
  std::vector<std::string> choices = {};  // of texts, empty: any; of an enum, its values' names in order
};

/// The value as it stands in a report.
std::variant<double, int, bool, std::string> ValueOf(const ConfigRow& row);

/// Asks reader for every row and stores what it gives.
void ReadConfigRows(std::span<const ConfigRow> rows, ConfigReader* reader);

/// YAML with all rows, their values and comments, a blank line between sections. Reads back equal.
std::string WriteConfigRows(std::span<const ConfigRow> rows);

}  // namespace orbslam
