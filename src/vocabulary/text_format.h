// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "orbslam/util/result.h"
#include "orbslam/vocabulary/vocabulary.h"

namespace orbslam {

/// Parses DBoW2's text format (vocabulary_file.h says what it is); only L1 scores and TF-IDF weights (header
/// `k L 0 0`). Nodes are renumbered breadth-first, siblings in the order of the file. name is what errors
/// call the file.
Result<VocabularyTree> ParseTextTree(std::string_view text, const std::string& name);

}  // namespace orbslam
