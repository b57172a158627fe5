// SPDX-License-Identifier: GPL-3.0-or-later
#include "png_codec.h"

#include <spng.h>
#include <zlib.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <opencv2/core.hpp>

#include "image_limits.h"

namespace orbslam {
namespace {

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

struct Decoder {
  Context context{spng_ctx_new(0), spng_ctx_free};
  spng_ihdr header{};

  int channels() const {
    constexpr std::array<int, 7> kChannels = {1, 0, 3, 3, 2, 0, 4};  // by PNG's colour type
    return kChannels.at(header.color_type);
  }
};

Error PngError(int code) {
  const bool cut = code == SPNG_IO_EOF || code == SPNG_EOF || code == SPNG_EIDAT_TOO_SHORT;
  return {std::string(cut ? "truncated" : "corrupt") + " PNG (" + spng_strerror(code) + ")"};
}

Result<Decoder> ReadHeader(std::string_view bytes) {
  Decoder decoder;
  ORBSLAM_CHECK(decoder.context != nullptr);
  int code = spng_set_png_buffer(decoder.context.get(), bytes.data(), bytes.size());
  if (code == SPNG_OK) code = spng_get_ihdr(decoder.context.get(), &decoder.header);
  if (code != SPNG_OK) return PngError(code);
  if (const Status size = CheckImageSize(decoder.header.width, decoder.header.height); !size)
    return size.error();
  return decoder;
}

/// Decodes straight into the matrix, then reads on to the end of the file: libspng stops at the last pixel.
Result<cv::Mat> ReadPixels(const Decoder& decoder, int type, int format) {
  cv::Mat image(static_cast<int>(decoder.header.height), static_cast<int>(decoder.header.width), type);
  int code =
      spng_decode_image(decoder.context.get(), image.data, image.total() * image.elemSize(), format, 0);
  if (code == SPNG_OK) code = spng_decode_chunks(decoder.context.get());
  if (code != SPNG_OK) return PngError(code);
  return image;
}

std::string Found(const Decoder& decoder) {
  const char* const palette = decoder.header.color_type == SPNG_COLOR_TYPE_INDEXED ? ", with a palette" : "";
  return "found " + std::to_string(decoder.header.bit_depth) + " bit, " + std::to_string(decoder.channels()) +
         (decoder.channels() == 1 ? " channel" : " channels") + palette;
}

/// One row filter instead of the best of five: for noisy camera pictures three times as fast, and no larger.
/// Colours: what changes downwards, coded as runs (noise has no other repetitions); depth repeats as it is.
int ChooseFastFilters(spng_ctx* context, int bit_depth) {
  if (bit_depth == 16) return spng_set_option(context, SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_NONE);
  const int code = spng_set_option(context, SPNG_IMG_COMPRESSION_STRATEGY, Z_RLE);
  if (code != SPNG_OK) return code;
  return spng_set_option(context, SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_UP);
}

}  // namespace

bool IsPng(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1A\n"); }

Result<cv::Mat> DecodePngColor(std::string_view bytes) {
  const Result<Decoder> decoder = ReadHeader(bytes);
  if (!decoder) return decoder.error();
  if (decoder->header.bit_depth == 16) {
    return Error{"a colour or gray image must have 8 bit a channel, " + Found(*decoder) +
                 " (is it a depth image?)"};
  }
  switch (decoder->header.color_type) {
    case SPNG_COLOR_TYPE_GRAYSCALE:
      return ReadPixels(*decoder, CV_8UC1, SPNG_FMT_G8);
    case SPNG_COLOR_TYPE_GRAYSCALE_ALPHA: {
      const Result<cv::Mat> gray_alpha = ReadPixels(*decoder, CV_8UC2, SPNG_FMT_PNG);
      if (!gray_alpha) return gray_alpha.error();
      cv::Mat gray;
      cv::extractChannel(*gray_alpha, gray, 0);
      return gray;
    }
    default:
      return ReadPixels(*decoder, CV_8UC3, SPNG_FMT_RGB8);
  }
}

Result<cv::Mat> DecodePngDepth(std::string_view bytes) {
  const Result<Decoder> decoder = ReadHeader(bytes);
  if (!decoder) return decoder.error();
  if (decoder->header.bit_depth != 16 || decoder->channels() != 1) {
    return Error{"a depth image must have 16 bit, 1 channel; " + Found(*decoder)};
  }
  return ReadPixels(*decoder, CV_16UC1, SPNG_FMT_PNG);
}

Result<std::string> EncodePng(const cv::Mat& image, int compression_level) {
  const Context context(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
  ORBSLAM_CHECK(context != nullptr && image.isContinuous());
  spng_ihdr header{};
  header.width = static_cast<uint32_t>(image.cols);
  header.height = static_cast<uint32_t>(image.rows);
  header.bit_depth = image.depth() == CV_16U ? 16 : 8;
  header.color_type = image.channels() == 3 ? SPNG_COLOR_TYPE_TRUECOLOR : SPNG_COLOR_TYPE_GRAYSCALE;

  int code = spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  if (code == SPNG_OK) code = spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, compression_level);
  if (code == SPNG_OK && compression_level == 1) code = ChooseFastFilters(context.get(), header.bit_depth);
  if (code == SPNG_OK) code = spng_set_ihdr(context.get(), &header);
  if (code == SPNG_OK) {
    code = spng_encode_image(context.get(), image.data, image.total() * image.elemSize(), SPNG_FMT_PNG,
                             SPNG_ENCODE_FINALIZE);
  }
  size_t size = 0;
  const std::unique_ptr<void, decltype(&std::free)> buffer(
      code == SPNG_OK ? spng_get_png_buffer(context.get(), &size, &code) : nullptr, std::free);
  if (code != SPNG_OK) return Error{std::string("cannot encode PNG: ") + spng_strerror(code)};
  return std::string(static_cast<const char*>(buffer.get()), size);
}

}  // namespace orbslam
