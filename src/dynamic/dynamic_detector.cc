// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/dynamic_detector.h"

namespace orbslam {

class DynamicDetector::Implementation {};

DynamicDetector::DynamicDetector(const PinholeCamera&, const DepthModel&, const DynamicDetectorOptions&)
    : implementation_(std::make_unique<Implementation>()) {}
DynamicDetector::~DynamicDetector() = default;
DynamicDetector::DynamicDetector(DynamicDetector&&) noexcept = default;
DynamicDetector& DynamicDetector::operator=(DynamicDetector&&) noexcept = default;

DynamicMask DynamicDetector::Process(const RgbdImage& image) {
  DynamicMask mask;
  mask.frame_id = image.id;
  mask.fail_open_reason = "not implemented";
  return mask;
}

}  // namespace orbslam
