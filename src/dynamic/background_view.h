// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>
#include <span>

#include "reference_view.h"

namespace orbslam {

/// What the references let expect of the static scene where the present view has no depth.
struct BackgroundView {
  cv::Mat1f depth_m;             // cells; 0: no reference saw anything there, or it has
  cv::Mat1f darkest, brightest;  // grey levels of it, over the 3 x 3 cells around
};

/// Splats the cells that did not move of all references into the present view, the nearest in front; one-cell
/// holes are closed. Grey is corrected for the exposure: a common factor from the cells in which both agree.
BackgroundView RenderBackground(const GridCamera& camera, const WorkingFrame& current,
                                std::span<const ReferenceView* const> references);

}  // namespace orbslam
