// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "orbslam/synthetic/synthetic_sequence.h"

namespace orbslam {

constexpr int kUsageError = 2;

struct Arguments {
  std::string folder;
  std::string contact_sheet;  // path; empty: none
  SyntheticSequenceOptions options;
  int num_threads = 3;
  bool quiet = false;
};

/// Of the command line. exit_code: that of --help (0) or of an error (kUsageError), which has been told.
struct ParsedArguments {
  Arguments arguments;
  std::optional<int> exit_code;
};
ParsedArguments ParseArguments(int argc, char** argv);

}  // namespace orbslam
