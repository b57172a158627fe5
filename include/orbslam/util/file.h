// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "orbslam/util/result.h"

namespace orbslam {

/// The bytes of a file. Error: missing, a directory, not readable, or more than max_bytes.
Result<std::string> ReadFile(const std::string& path, size_t max_bytes = size_t{1} << 30);

/// Writes a new file beside the target and renames it when it is complete, so that under the final name there
/// is the old content or all of the new one, never a part. A symbolic link keeps pointing to the file; a
/// device or pipe (/dev/stdout) is written to as it is. Error: no such folder, no permission, disk full.
Status WriteFileAtomically(const std::string& path, std::string_view content);

}  // namespace orbslam
