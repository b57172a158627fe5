// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "orbslam/util/config_reader.h"
#include "orbslam/util/result.h"

namespace orbslam {

/// The entries of a YAML text by their dotted keys. name stands for the file in error messages.
Result<std::map<std::string, ConfigEntry>> ParseFlatYaml(std::string_view content, const std::string& name);

}  // namespace orbslam
