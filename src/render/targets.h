// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core/mat.hpp>

#include "orbslam/render/renderer.h"
#include "osmesa_context.h"

namespace orbslam {

/// Framebuffers of one size; row 0 is the top one. The context must be current.
class ColorTarget {
 public:
  static constexpr int kSamples = 4;

  explicit ColorTarget(cv::Size size);
  void BindAndClear() const;
  cv::Mat ReadBgr() const;

 private:
  cv::Size size_;
  GLuint many_samples_ = 0, resolved_ = 0;
};

class GeometryTarget {
 public:
  explicit GeometryTarget(cv::Size size);
  void BindAndClear() const;
  GeometryView Read() const;

 private:
  cv::Size size_;
  GLuint framebuffer_ = 0;
};

}  // namespace orbslam
