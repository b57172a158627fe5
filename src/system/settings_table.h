// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "orbslam/system/settings.h"
#include "orbslam/util/config_table.h"

namespace orbslam {

/// Every key of a settings file: where it is kept, whether it may be left out, what is allowed, and what it
/// means.
std::vector<ConfigRow> DescribeSettings(Settings* settings);

}  // namespace orbslam
