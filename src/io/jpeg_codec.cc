// SPDX-License-Identifier: GPL-3.0-or-later
#include "jpeg_codec.h"

#include <turbojpeg.h>

#include <memory>
#include <string>
#include <type_traits>

#include "image_limits.h"

namespace orbslam {
namespace {

using Decompressor = std::unique_ptr<std::remove_pointer_t<tjhandle>, decltype(&tjDestroy)>;

struct JpegHeader {
  int width = 0, height = 0, subsampling = 0, colorspace = 0;
};

const unsigned char* Data(std::string_view bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

/// The library says only in words which of its warnings it gave.
bool IsAboutExtraBytes(const std::string& warning) {
  return warning.find("extraneous bytes") != std::string::npos;
}

Error JpegError(std::string_view bytes, const std::string& reason) {
  constexpr std::string_view kEndOfImage = "\xFF\xD9";
  const bool cut = bytes.rfind(kEndOfImage) == std::string_view::npos;
  return {std::string(cut ? "truncated" : "corrupt") + " JPEG (" + reason + ")"};
}

Result<JpegHeader> ReadHeader(tjhandle decompressor, std::string_view bytes) {
  JpegHeader header;
  if (tjDecompressHeader3(decompressor, Data(bytes), bytes.size(), &header.width, &header.height,
                          &header.subsampling, &header.colorspace) != 0 &&
      (tjGetErrorCode(decompressor) != TJERR_WARNING || header.width <= 0)) {
    return JpegError(bytes, tjGetErrorStr2(decompressor));
  }
  if (header.width <= 0 || header.height <= 0) return JpegError(bytes, "it has no picture");
  if (const Status size = CheckImageSize(header.width, header.height); !size) return size.error();
  if (header.colorspace == TJCS_CMYK || header.colorspace == TJCS_YCCK) {
    return Error{"a JPEG must be gray or colour, found CMYK"};
  }
  return header;
}

/// Empty when all is well, else what is wrong. The library fills what it cannot decode with gray and merely
/// warns; for us such a picture is lost. Only bytes too many between two parts, which some cameras leave, do
/// no harm.
std::string Decompress(tjhandle decompressor, std::string_view bytes, int format, cv::Mat* image) {
  const auto run = [&](int flags) -> std::string {
    const int code = tjDecompress2(decompressor, Data(bytes), bytes.size(), image->data, image->cols,
                                   static_cast<int>(image->step), image->rows, format, flags);
    return code == 0 ? "" : tjGetErrorStr2(decompressor);
  };
  const std::string last_warning = run(0);
  const bool fatal = !last_warning.empty() && tjGetErrorCode(decompressor) != TJERR_WARNING;
  if (fatal || !IsAboutExtraBytes(last_warning)) return last_warning;
  // Only the last of several warnings is kept, and damaged data often ends in extra bytes: look at the first
  // too.
  const std::string first_warning = run(TJFLAG_STOPONWARNING);
  if (!IsAboutExtraBytes(first_warning)) return first_warning;
  run(0);
  return "";
}

}  // namespace

bool IsJpeg(std::string_view bytes) { return bytes.starts_with("\xFF\xD8\xFF"); }

Result<cv::Mat> DecodeJpeg(std::string_view bytes, JpegPixels pixels) {
  const Decompressor decompressor(tjInitDecompress(), tjDestroy);
  ORBSLAM_CHECK(decompressor != nullptr);
  const Result<JpegHeader> header = ReadHeader(decompressor.get(), bytes);
  if (!header) return header.error();

  const bool gray =
      pixels == JpegPixels::kGray || (pixels == JpegPixels::kAsStored && header->colorspace == TJCS_GRAY);
  cv::Mat image(header->height, header->width, gray ? CV_8UC1 : CV_8UC3);
  const std::string problem = Decompress(decompressor.get(), bytes, gray ? TJPF_GRAY : TJPF_BGR, &image);
  if (!problem.empty()) return JpegError(bytes, problem);
  return image;
}

}  // namespace orbslam
