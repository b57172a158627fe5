// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/features/feature_grid.h"

#include <algorithm>
#include <cmath>

namespace orbslam {
namespace {

// The cell of a coordinate; whatever lies outside (or is nan) belongs to a cell on the border.
int Cell(float x, float min, float max, int cells) {
  const float position = (x - min) / (max - min) * static_cast<float>(cells);
  return static_cast<int>(std::min(std::max(0.0f, position), static_cast<float>(cells - 1)));
}

}  // namespace

FeatureGrid::FeatureGrid(std::span<const cv::Point2f> pixels, const ImageBounds& bounds)
    : bounds_(bounds), cell_start_(kColumns * kRows + 1, 0), items_(pixels.size()) {
  std::vector<int> cells;
  cells.reserve(pixels.size());
  for (const auto& pixel : pixels) {
    cells.push_back(Row(pixel.y) * kColumns + Column(pixel.x));
    ++cell_start_[cells.back() + 1];
  }
  for (size_t cell = 1; cell < cell_start_.size(); ++cell) cell_start_[cell] += cell_start_[cell - 1];
  std::vector<int> next(cell_start_.begin(), cell_start_.end() - 1);
  for (size_t i = 0; i < cells.size(); ++i) items_[next[cells[i]]++] = static_cast<int>(i);
}

void FeatureGrid::Near(float u, float v, float radius_px, std::span<const cv::Point2f> pixels,
                       std::span<const int> levels, int min_level, int max_level,
                       std::vector<int>* out) const {
  out->clear();
  if (items_.empty()) return;
  const int first_column = Column(u - radius_px), last_column = Column(u + radius_px);
  const int first_row = Row(v - radius_px), last_row = Row(v + radius_px);
  for (int row = first_row; row <= last_row; ++row) {
    // The cells of one row are neighbours in items_.
    const int begin = cell_start_[row * kColumns + first_column];
    const int end = cell_start_[row * kColumns + last_column + 1];
    for (int k = begin; k < end; ++k) {
      const int i = items_[k];
      if (levels[i] < min_level || levels[i] > max_level) continue;
      if (std::abs(pixels[i].x - u) < radius_px && std::abs(pixels[i].y - v) < radius_px) out->push_back(i);
    }
  }
}

int FeatureGrid::Column(float u) const { return Cell(u, bounds_.min_u, bounds_.max_u, kColumns); }

int FeatureGrid::Row(float v) const { return Cell(v, bounds_.min_v, bounds_.max_v, kRows); }

}  // namespace orbslam
