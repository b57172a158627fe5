// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/dynamic/dynamic_detector.h"

#include "full_detector.h"
#include "paper_mode.h"

namespace orbslam {

class DynamicDetector::Implementation {
 public:
  Implementation(const PinholeCamera& camera, const DynamicDetectorOptions& options) {
    if (options.mode == DetectorMode::kFull) full_ = std::make_unique<FullDetector>(camera, options);
    if (options.mode == DetectorMode::kPaper) paper_ = std::make_unique<PaperMode>(camera, options);
  }

  DynamicMask Process(const RgbdImage& image) {
    return full_ != nullptr ? full_->Process(image) : paper_->Process(image);
  }

 private:
  std::unique_ptr<FullDetector> full_;  // one of the two
  std::unique_ptr<PaperMode> paper_;
};

DynamicDetector::DynamicDetector(const PinholeCamera& camera, const DepthModel& /*depth: in metres already*/,
                                 const DynamicDetectorOptions& options)
    : implementation_(std::make_unique<Implementation>(camera, options)) {}
DynamicDetector::~DynamicDetector() = default;
DynamicDetector::DynamicDetector(DynamicDetector&&) noexcept = default;
DynamicDetector& DynamicDetector::operator=(DynamicDetector&&) noexcept = default;

DynamicMask DynamicDetector::Process(const RgbdImage& image) { return implementation_->Process(image); }

}  // namespace orbslam
