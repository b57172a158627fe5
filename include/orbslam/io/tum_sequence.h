// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "orbslam/util/result.h"

namespace orbslam {

/// One frame of a sequence in the layout of the TUM RGB-D benchmark (Sturm et al., IROS 2012).
struct RgbdEntry {
  double timestamp_s = 0;      // of the colour image
  std::string timestamp_text;  // the same as the file writes it; trajectories repeat it letter by letter
  std::string rgb_path;        // with the sequence's folder before it
  std::string depth_path;
  double depth_delay_s = 0;  // the depth image was taken this much after the colour image
};

struct TumSequence {
  std::vector<RgbdEntry> entries;  // time stamps strictly ascend
  std::vector<std::string>
      warnings;  // one line for each kind of skipped line, and where the first of them is
};

/// Reads an associations file, "t rgb t depth" a line; with no path for it, pairs the folder's rgb.txt and
/// depth.txt in time. Separators: blanks, tabs, commas; lines may end in CRLF, be empty, or begin with #.
/// Lines with another number of fields, with a time that is not a finite number or not after the last one are
/// skipped, with a warning. Error: a file that cannot be read or in which no line is usable.
Result<TumSequence> ReadTumSequence(const std::string& folder, const std::string& associations_path = {});

/// Index pairs (a, b) with |a - b| < max_difference_s: of all such pairs the closest first, each index used
/// once, as the benchmark's associate tool does. Both inputs strictly ascend, and so do the pairs.
std::vector<std::pair<int, int>> AssociateByTime(std::span<const double> a_s, std::span<const double> b_s,
                                                 double max_difference_s);

}  // namespace orbslam
