// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "canvas.h"

namespace orbslam {

// What floors, walls and furniture are made of; each covers the whole canvas.

void PaintPlaster(const cv::Scalar& bgr, Canvas* canvas);
void PaintCarpet(const cv::Scalar& bgr, Canvas* canvas);
void PaintParquet(const cv::Scalar& bgr, Canvas* canvas);
/// Grain runs along x.
void PaintWood(const cv::Scalar& bgr, Canvas* canvas);
void PaintCeiling(Canvas* canvas);
void PaintFabric(const cv::Scalar& bgr, Canvas* canvas);
void PaintDoor(const cv::Scalar& bgr, Canvas* canvas);
/// Trees and houses under the sky.
void PaintOutdoors(Canvas* canvas);
/// A front of drawers.
void PaintDrawers(const cv::Scalar& bgr, int num_drawers, Canvas* canvas);

}  // namespace orbslam
