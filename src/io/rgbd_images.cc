// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/io/rgbd_images.h"

#include <opencv2/imgproc.hpp>

#include "orbslam/io/image_file.h"

namespace orbslam {
namespace {

std::string SizeText(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

Status CheckSize(const std::string& path, const cv::Mat& image, const PinholeCamera& camera,
                 const std::string& who_expects) {
  if (image.cols == camera.width && image.rows == camera.height) return OkStatus();
  return Error{path + ": the image is " + SizeText(image.cols, image.rows) + " px, but " + who_expects + " " +
               SizeText(camera.width, camera.height) + " px"};
}

Result<RgbdImages> LoadColor(const std::string& path, WithColor with_color) {
  if (with_color == WithColor::kYes) {
    const Result<GrayAndBgr> both = ReadGrayAndBgr(path);
    if (!both) return both.error();
    return RgbdImages{both->gray, both->bgr, {}};
  }
  const Result<cv::Mat> gray = ReadGray(path);
  if (!gray) return gray.error();
  return RgbdImages{*gray, {}, {}};
}

}  // namespace

Result<RgbdImages> LoadRgbd(const RgbdEntry& entry, const PinholeCamera& camera,
                            const DepthModel& depth_model, WithColor with_color) {
  Result<RgbdImages> color = LoadColor(entry.rgb_path, with_color);
  if (!color) return color;
  Status size =
      CheckSize(entry.rgb_path, color->gray, camera, "the settings (Camera.width, Camera.height) say");
  if (!size) return size.error();

  const Result<cv::Mat> raw_depth = ReadDepth(entry.depth_path);
  if (!raw_depth) return raw_depth.error();
  size = CheckSize(entry.depth_path, *raw_depth, camera, "its colour image and the settings have");
  if (!size) return size.error();

  RgbdImages images = *color;
  images.depth_m = DepthInMetres(*raw_depth, depth_model);
  return images;
}

cv::Mat DepthInMetres(const cv::Mat& raw, const DepthModel& depth_model) {
  ORBSLAM_CHECK(raw.type() == CV_16UC1 && depth_model.units_per_metre > 0);
  constexpr double kLargestMeasurement = 65534;
  cv::Mat measured, depth_m;
  cv::threshold(raw, measured, kLargestMeasurement, 0, cv::THRESH_TOZERO_INV);
  measured.convertTo(depth_m, CV_32F, 1.0 / depth_model.units_per_metre);
  return depth_m;
}

}  // namespace orbslam
