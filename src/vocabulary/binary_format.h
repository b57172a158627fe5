// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "orbslam/util/result.h"
#include "orbslam/vocabulary/vocabulary.h"

namespace orbslam {

/// The binary format, version 1, little endian, nothing compressed:
///
///   offset  size            what
///        0  8               magic (kBinaryMagic)
///        8  4 x uint32      version, k, L, bytes of a descriptor (32)
///       24  2 x uint64      number of nodes N, number of words W
///       40  uint64          checksum of everything else
///       48  32 N            descriptors, in breadth-first order of the nodes; the root's is zero
///       .   N x uint8       number of children of each node
///       .   W x float32     weight of each word (node without children), in the order of the nodes
///
/// The magic holds both kinds of line end, so that a transfer "as text" shows.
inline constexpr std::string_view kBinaryMagic{"ORBV\r\n\x1a\n", 8};

/// bytes: the whole file. Errors do not name it.
Result<VocabularyTree> ParseBinaryTree(std::string_view bytes);

std::string FormatBinaryTree(const VocabularyTree& tree);

}  // namespace orbslam
