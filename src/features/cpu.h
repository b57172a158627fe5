// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace orbslam {

/// What this processor has; nothing, if the environment variable ORBSLAM_PORTABLE_CODE is set (to test the
/// code for older ones).
bool HasAvx2AndFma();
bool HasPopcnt();

}  // namespace orbslam
