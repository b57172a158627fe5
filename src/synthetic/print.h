// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "canvas.h"

namespace orbslam {

// What is printed, written or shown; each covers an area of the canvas.

/// Sky, hills and water of coloured noise, with the statistics of photographs.
void PaintPhoto(const cv::Rect2d& area, Canvas* canvas);
/// A sheet of text, perhaps with a figure.
void PaintPage(const cv::Rect2d& area, Canvas* canvas);
/// One of several kinds: photograph with caption, conference poster, big letters, diagram.
void PaintPoster(const cv::Rect2d& area, Canvas* canvas);
void PaintChart(const cv::Rect2d& area, Canvas* canvas);
void PaintCalendar(const cv::Rect2d& area, Canvas* canvas);
/// Hand-drawn boxes, arrows and formulas on white.
void PaintWhiteboard(Canvas* canvas);
/// What a monitor shows: windows with code, a plot, a bar below.
void PaintScreen(Canvas* canvas);
void PaintKeyboard(Canvas* canvas);
/// A row of book backs from edge to edge, standing on the lower edge; the gaps show `dark`.
void PaintBookBacks(Canvas* canvas);
/// The front or side of a cardboard box.
void PaintCarton(Canvas* canvas);

}  // namespace orbslam
