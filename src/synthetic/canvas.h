// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>

#include "orbslam/util/random.h"

namespace orbslam {

/// What a surface of the synthetic room is made of.
enum class Material {
  kPlaster,
  kBrick,
  kFloorboards,
  kCeiling,
  kWood,
  kDesktop,
  kBooks,
  kScreen,
  kCarton,
  kDoors
};

/// A surface being painted: metres from its top left corner, x right, y down. Every stroke is drawn from the
/// canvas's own random numbers, so the picture is a pure function of (size, density, seed, strokes).
class Canvas {
 public:
  Canvas(double width_m, double height_m, double texels_per_metre, uint64_t seed);

  double width_m() const { return width_m_; }
  double height_m() const { return height_m_; }
  Rng& rng() { return rng_; }

  /// CV_8UC4, sides as Texture wants them.
  const cv::Mat& image() const { return image_; }

  void Fill(const cv::Rect2d& area_m, const cv::Scalar& bgr);
  /// Words of letter-like strokes in lines, ragged on the right.
  void Write(const cv::Rect2d& area_m, double letter_height_m, const cv::Scalar& ink_bgr);
  /// Paper with a heading, pictures of rectangles and small print; paper may be dark.
  void Poster(const cv::Rect2d& area_m);
  /// Multiplies by 1 + noise of three scales; strength in grey levels of 255.
  void Roughen(double strength);
  /// Light that falls on the surface: a factor, and a darkening towards the edges (corners of a room).
  void Shade(double factor, double edge_darkening);

 private:
  cv::Rect ToTexels(const cv::Rect2d& area_m) const;

  double width_m_, height_m_;
  Rng rng_;
  cv::Mat image_;
};

/// A random colour of medium saturation; lightness in [0, 255].
cv::Scalar RandomColor(double lightness, Rng* rng);

/// Covers the whole canvas.
void Paint(Material material, Canvas* canvas);

}  // namespace orbslam
