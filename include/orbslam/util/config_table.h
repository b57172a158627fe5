// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "orbslam/util/config_reader.h"

namespace orbslam {

/// All there is to say about one setting. From a list of such rows settings are read, checked and written, so
/// that nothing about a key is said twice. A new key is a new row.
struct ConfigRow {
  enum Presence { kRequired, kOptional };

  std::string key;
  std::variant<double*, int*, bool*, std::string*>
      value;  // where it is kept; holds the default before reading
  Presence presence = kOptional;
  ConfigRange range = {};                 // of numbers
  std::string comment = {};               // unit and meaning
  std::vector<std::string> choices = {};  // of texts; empty: any
};

/// Asks reader for every row and stores what it gives.
void ReadConfigRows(std::span<const ConfigRow> rows, ConfigReader* reader);

/// YAML with all rows, their values and comments, a blank line between sections. Reads back equal.
std::string WriteConfigRows(std::span<const ConfigRow> rows);

}  // namespace orbslam
