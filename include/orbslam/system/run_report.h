// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orbslam/system/sequence_runner.h"

namespace orbslam {

/// The text of run.json: version, command line, settings, counts, coverage, timing percentiles (seconds),
/// memory.
std::string FormatRunReport(const std::vector<std::string>& command_line, const Settings& settings,
                            const std::vector<std::string>& warnings, const RunSummary& summary,
                            const System& system);

/// "median tracking time" and "mean tracking time" in seconds, as ORB-SLAM2's programs print them.
std::string FormatTrackingTimes(const std::vector<FrameReport>& frames);

}  // namespace orbslam
