// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "orbslam/features/descriptor.h"

namespace orbslam {

/// Index of the nearest of count descriptors, ties to the first; count > 0.
using NearestChildFunction = uint32_t (*)(const Descriptor& query, const Descriptor* children,
                                          uint32_t count);

/// The fastest that this processor can run.
NearestChildFunction BestNearestChild();

}  // namespace orbslam
