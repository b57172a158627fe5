// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "orbslam/util/result.h"
#include "orbslam/vocabulary/vocabulary.h"

namespace orbslam {

/// Reads a vocabulary, whichever of the two formats the content shows:
/// - ours, binary (see src/vocabulary/binary_format.h), checked against its checksum;
/// - the text format in which ORB-SLAM2's ORBvoc.txt comes: a line `k L scoring weighting`, then a line a
/// node
///   `parent leaf b0 .. b31 weight`, where nodes count up from 1 and 0 is the root.
/// A missing, truncated, foreign or damaged file is an Error of one line with the file and, for text, its
/// line.
Result<Vocabulary> ReadVocabulary(const std::string& path);

/// Writes the binary format, as WriteFileAtomically() does and with its errors: no reader ever sees half a
/// file.
Status WriteVocabulary(const Vocabulary& vocabulary, const std::string& path);

}  // namespace orbslam
