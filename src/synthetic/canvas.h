// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "orbslam/util/random.h"

namespace orbslam {

/// A surface being painted: metres from its top left corner, x right, y down. Whatever is random comes from
/// the canvas's own numbers, so that the picture is a pure function of (size, density, seed, strokes).
class Canvas {
 public:
  Canvas(double width_m, double height_m, double texels_per_metre, uint64_t seed);

  double width() const { return width_m_; }
  double height() const { return height_m_; }
  cv::Rect2d Whole() const { return {0, 0, width_m_, height_m_}; }
  Rng& rng() { return rng_; }
  /// CV_8UC3.
  cv::Mat& image() { return image_; }
  double texels_per_metre() const { return density_; }

  void Fill(const cv::Rect2d& area, const cv::Scalar& bgr);
  void Polygon(const std::vector<cv::Point2d>& corners, const cv::Scalar& bgr);
  void Disc(cv::Point2d middle, double radius, const cv::Scalar& bgr);
  void Ring(cv::Point2d middle, double radius, double stroke, const cv::Scalar& bgr);
  void Line(cv::Point2d from, cv::Point2d to, double stroke, const cv::Scalar& bgr);
  /// Letters of the given height from a base line's left end; returns the width.
  double Text(const std::string& text, cv::Point2d left_end, double letter_height, const cv::Scalar& bgr,
              bool bold = false);
  /// Lines of words, ragged on the right. Letters too small for the texels become dashes.
  void Paragraph(const cv::Rect2d& area, double letter_height, const cv::Scalar& bgr);
  /// Multiplies by 1 + strength * noise whose coarsest bumps have this length.
  void Roughen(double strength, double coarsest, double smoothness);
  /// A picture stretched over an area.
  void Paste(const cv::Mat& bgr, const cv::Rect2d& area);

 private:
  cv::Point2d ToTexel(cv::Point2d point) const { return {point.x * scale_x_, point.y * scale_y_}; }
  /// In OpenCV's fixed point, for its anti-aliased strokes.
  cv::Point ToFixed(cv::Point2d point) const;
  int StrokeTexels(double stroke) const;
  cv::Rect ToTexels(const cv::Rect2d& area) const;

  double width_m_, height_m_, density_;
  Rng rng_;
  cv::Mat image_;
  double scale_x_, scale_y_;
};

/// Of the hue (in [0, 1), 0 red, 1/3 green), saturation and brightness in [0, 1].
cv::Scalar FromHsv(double hue, double saturation, double value);
cv::Scalar RandomColor(double min_value, double max_value, double max_saturation, Rng* rng);
std::string RandomWord(Rng* rng);

}  // namespace orbslam
