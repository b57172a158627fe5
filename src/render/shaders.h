// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "osmesa_context.h"

namespace orbslam {

/// Attribute numbers of Vertex, in all programs.
enum VertexAttribute : GLuint { kPosition, kNormal, kUv, kLight };

/// Programs whose sources are this module's own, so that not to compile is a bug. The context must be
/// current.
GLuint MakeColorProgram();
GLuint MakeGeometryProgram();

}  // namespace orbslam
