// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "working_frame.h"

namespace orbslam {

/// Fills the frame's normals from its depth: cross product of central differences over two cells either way;
/// none where a neighbour is missing or a depth edge lies between.
void ComputeNormals(const GridCamera& camera, WorkingFrame* frame);

}  // namespace orbslam
