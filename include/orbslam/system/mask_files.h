// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/io/tum_sequence.h"
#include "orbslam/system/mask_supplier.h"
#include "orbslam/util/result.h"

namespace orbslam {

/// Ready-made masks: for each colour image of the sequence the PNG of the same name in `folder`, non-zero on
/// what may move. A mask that is missing, broken or of another size than the camera's is warned of and taken
/// as empty. Error: not a folder, or without a mask for any image of the sequence.
Result<UserMask> MasksFromFolder(const std::string& folder, const TumSequence& sequence,
                                 const PinholeCamera& camera);

/// Writes the masks of a run, each a PNG (255: moving) with the name of its colour image.
class MaskWriter {
 public:
  /// Makes the folder if it is not there yet. Empty: nothing is written.
  static Result<MaskWriter> Open(const std::string& folder, const PinholeCamera& camera);

  /// mask: CV_8UC1, or empty: nothing moves.
  void Write(const RgbdEntry& entry, const cv::Mat& mask);
  /// The first thing that went wrong, if any.
  const Status& status() const { return status_; }

 private:
  MaskWriter(std::string folder, cv::Size size) : folder_(std::move(folder)), size_(size) {}

  std::string folder_;
  cv::Size size_;
  Status status_ = OkStatus();
};

}  // namespace orbslam
