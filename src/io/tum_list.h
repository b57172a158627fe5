// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orbslam/util/result.h"

namespace orbslam {

struct TumListRow {
  double timestamp_s = 0;
  std::vector<std::string> fields;
};

struct TumList {
  std::vector<TumListRow> rows;       // time stamps strictly ascend
  std::vector<std::string> warnings;  // about skipped lines
};

/// How the lines of a list look: the fields at even positions are times, which every list of TUM's keeps to.
struct TumListFormat {
  int num_fields;
  const char* description;
};
inline constexpr TumListFormat kImageList{2, "time image"};
inline constexpr TumListFormat kAssociations{4, "time rgb time depth"};

/// Error: the file cannot be read, or no line of it is usable.
Result<TumList> ReadTumList(const std::string& path, const TumListFormat& format);

}  // namespace orbslam
