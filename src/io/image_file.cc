// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/io/image_file.h"

#include <opencv2/imgproc.hpp>
#include <string_view>

#include "jpeg_codec.h"
#include "orbslam/util/file.h"
#include "png_codec.h"

namespace orbslam {
namespace {

constexpr size_t kMaxFileBytes = size_t{1} << 30;

cv::Mat Converted(const cv::Mat& image, int code) {
  cv::Mat converted;
  cv::cvtColor(image, converted, code);
  return converted;
}

Result<cv::Mat> DecodeGray(std::string_view bytes) {
  if (IsJpeg(bytes)) return DecodeJpeg(bytes, JpegPixels::kGray);
  Result<cv::Mat> stored = DecodePngColor(bytes);
  if (!stored || stored->channels() == 1) return stored;
  return Converted(*stored, cv::COLOR_RGB2GRAY);
}

Result<cv::Mat> DecodeAsStored(std::string_view bytes) {
  if (IsJpeg(bytes)) return DecodeJpeg(bytes, JpegPixels::kAsStored);
  Result<cv::Mat> stored = DecodePngColor(bytes);
  if (!stored || stored->channels() == 1) return stored;
  return Converted(*stored, cv::COLOR_RGB2BGR);
}

/// A JPEG is decoded twice: gray made of its colours would differ from ReadGray() by rounding, and with it
/// the features; whether somebody looks at the colours must not change where the camera is.
Result<GrayAndBgr> DecodeBoth(std::string_view bytes) {
  if (IsJpeg(bytes)) {
    const Result<cv::Mat> gray = DecodeJpeg(bytes, JpegPixels::kGray);
    if (!gray) return gray.error();
    const Result<cv::Mat> bgr = DecodeJpeg(bytes, JpegPixels::kBgr);
    if (!bgr) return bgr.error();
    return GrayAndBgr{*gray, *bgr};
  }
  const Result<cv::Mat> stored = DecodePngColor(bytes);
  if (!stored) return stored.error();
  if (stored->channels() == 1) return GrayAndBgr{*stored, Converted(*stored, cv::COLOR_GRAY2BGR)};
  return GrayAndBgr{Converted(*stored, cv::COLOR_RGB2GRAY), Converted(*stored, cv::COLOR_RGB2BGR)};
}

Result<cv::Mat> DecodeDepth(std::string_view bytes) {
  if (IsJpeg(bytes)) return Error{"a depth image must be a PNG of 16 bit, 1 channel; found a JPEG"};
  return DecodePngDepth(bytes);
}

/// Reads, checks what kind of file it is, decodes, and puts the path before whatever went wrong.
template <class T>
Result<T> ReadImage(const std::string& path, Result<T> (*decode)(std::string_view)) {
  const Result<std::string> bytes = ReadFile(path, kMaxFileBytes);
  if (!bytes) return bytes.error();
  if (bytes->empty()) return Error{path + ": the file is empty"};
  if (!IsPng(*bytes) && !IsJpeg(*bytes)) return Error{path + ": neither a PNG nor a JPEG file"};
  Result<T> image = decode(*bytes);
  if (!image) return Error{path + ": " + image.error().message};
  return image;
}

}  // namespace

Result<cv::Mat> ReadGray(const std::string& path) { return ReadImage(path, DecodeGray); }
Result<cv::Mat> ReadColorOrGray(const std::string& path) { return ReadImage(path, DecodeAsStored); }
Result<GrayAndBgr> ReadGrayAndBgr(const std::string& path) { return ReadImage(path, DecodeBoth); }
Result<cv::Mat> ReadDepth(const std::string& path) { return ReadImage(path, DecodeDepth); }

Status WritePng(const std::string& path, const cv::Mat& image, int compression_level) {
  const int type = image.type();
  ORBSLAM_CHECK(!image.empty() && (type == CV_8UC1 || type == CV_8UC3 || type == CV_16UC1));
  ORBSLAM_CHECK(compression_level >= 0 && compression_level <= 9);
  cv::Mat pixels = type == CV_8UC3 ? Converted(image, cv::COLOR_BGR2RGB) : image;
  if (!pixels.isContinuous()) pixels = pixels.clone();
  const Result<std::string> bytes = EncodePng(pixels, compression_level);
  if (!bytes) return Error{path + ": " + bytes.error().message};
  return WriteFileAtomically(path, *bytes);
}

}  // namespace orbslam
