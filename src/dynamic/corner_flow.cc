// SPDX-License-Identifier: GPL-3.0-or-later
#include "corner_flow.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/hal/intrin.hpp>

#include "orbslam/features/fast_corners.h"
#include "wide_vectors.h"

namespace orbslam {
namespace {

constexpr int kSize = 12;  // px, side of a patch
constexpr int kPixels = kSize * kSize;
constexpr float kHalf = 5.5f;  // from a patch's first pixel to its centre

/// A wide vector, or two narrow ones; may be anywhere.
constexpr int kLanes = 8;
using Lanes [[gnu::vector_size(4 * kLanes), gnu::aligned(4), gnu::may_alias]] = float;
static_assert(kPixels % kLanes == 0);

const Lanes& LanesAt(const float* first) { return *reinterpret_cast<const Lanes*>(first); }
Lanes& LanesAt(float* first) { return *reinterpret_cast<Lanes*>(first); }

struct Patch {
  float value[kPixels], slope_x[kPixels], slope_y[kPixels];
  float inverse_xx = 0, inverse_xy = 0, inverse_yy = 0;  // of the summed structure tensor
};

/// Bilinear samples of a rectangle of w x h pixels: here between columns, At(k) also between rows.
template <int w, int h>
struct Samples {
  float between[(h + 1) * w];
  float ay = 0;

  /// The first is at (x, y); false: not inside.
  bool Take(const cv::Mat1f& image, float x, float y) {
    const int x0 = cvFloor(x), y0 = cvFloor(y);
    if (x0 < 0 || y0 < 0 || x0 + w + 1 > image.cols || y0 + h + 1 > image.rows) return false;
    const float ax = x - static_cast<float>(x0);
    ay = y - static_cast<float>(y0);
    for (int j = 0; j <= h; ++j) {
      const float* row = image[std::min(y0 + j, image.rows - 1)] + x0;
      for (int i = 0; i < w; ++i) between[j * w + i] = row[i] + ax * (row[i + 1] - row[i]);
    }
    return true;
  }
  float At(int k) const { return between[k] + ay * (between[k + w] - between[k]); }
};

/// The same of a square whose rows and columns lie along the columns of a matrix, about its centre.
template <int size>
bool SampleTurned(const cv::Mat1f& image, cv::Point2f centre, const cv::Matx22f& axes, float* out) {
  constexpr float kMiddle = 0.5f * (size - 1);
  const cv::Point2f reach(kMiddle * (std::abs(axes(0, 0)) + std::abs(axes(0, 1))),
                          kMiddle * (std::abs(axes(1, 0)) + std::abs(axes(1, 1))));
  const cv::Point2f first = centre - reach, last = centre + reach;
  if (!(first.x >= 0 && first.y >= 0 && last.x < static_cast<float>(image.cols - 1) &&
        last.y < static_cast<float>(image.rows - 1)))
    return false;
  const int stride = static_cast<int>(image.step1());
  int offset[size * size];  // first where, then what: the former the compiler vectorises
  float ax[size * size], ay[size * size];
  for (int k = 0; k < size * size; ++k) {
    const float di = static_cast<float>(k % size) - kMiddle, dj = static_cast<float>(k / size) - kMiddle;
    const float x = centre.x + axes(0, 0) * di + axes(0, 1) * dj;
    const float y = centre.y + axes(1, 0) * di + axes(1, 1) * dj;
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);  // not negative
    ax[k] = x - static_cast<float>(x0), ay[k] = y - static_cast<float>(y0);
    offset[k] = y0 * stride + x0;
  }
  static_assert(size * size % 4 == 0);
  for (int k = 0; k < size * size; k += 4) {
    const cv::v_int32x4 at = cv::v_load(offset + k);
    const cv::v_float32x4 x = cv::v_load(ax + k), y = cv::v_load(ay + k);
    cv::v_float32x4 top_left, top_right, bottom_left, bottom_right;
    cv::v_lut_deinterleave(image[0], at, top_left, top_right);
    cv::v_lut_deinterleave(image[0] + stride, at, bottom_left, bottom_right);
    cv::v_store(out + k, (cv::v_setall_f32(1) - y) * (top_left + x * (top_right - top_left)) +
                             y * (bottom_left + x * (bottom_right - bottom_left)));
  }
  return true;
}

/// The sum of eight lanes: the compiler may not change the order of additions by itself.
float Total(const Lanes& sum) {
  float total = 0;
  for (int i = 0; i < kLanes; ++i) total += sum[i];
  return total;
}

/// Values and slopes by central differences of a patch from its samples, which reach one pixel farther.
void TakeSlopes(const float* wide, Patch* patch) {
  constexpr int kWide = kSize + 2;
  for (int j = 0; j < kSize; ++j)
    for (const int i : {0, kSize - kLanes}) {
      const float* here = wide + (j + 1) * kWide + 1 + i;
      const int k = j * kSize + i;
      LanesAt(patch->value + k) = LanesAt(here);
      LanesAt(patch->slope_x + k) = 0.5f * (LanesAt(here + 1) - LanesAt(here - 1));
      LanesAt(patch->slope_y + k) = 0.5f * (LanesAt(here + kWide) - LanesAt(here - kWide));
    }
}

/// The template at a position: values, slopes by central differences, and the inverse of their tensor.
bool MakePatch(const cv::Mat1f& image, cv::Point2f centre, const std::optional<cv::Matx22f>& axes,
               float min_texture, Patch* patch) {
  constexpr int kWide = kSize + 2;
  float wide[kWide * kWide];
  if (axes) {
    if (!SampleTurned<kWide>(image, centre, *axes, wide)) return false;
  } else {
    Samples<kWide, kWide> samples;
    if (!samples.Take(image, centre.x - kHalf - 1, centre.y - kHalf - 1)) return false;
    for (int k = 0; k < kWide * kWide; ++k) wide[k] = samples.At(k);
  }
  TakeSlopes(wide, patch);
  Lanes sum_xx{}, sum_xy{}, sum_yy{};
  for (int k = 0; k < kPixels; k += kLanes) {
    const Lanes &x = LanesAt(patch->slope_x + k), &y = LanesAt(patch->slope_y + k);
    sum_xx += x * x, sum_xy += x * y, sum_yy += y * y;
  }
  const float xx = Total(sum_xx), xy = Total(sum_xy), yy = Total(sum_yy);
  const float smaller = 0.5f * (xx + yy - std::sqrt((xx - yy) * (xx - yy) + 4 * xy * xy));
  if (smaller < min_texture * kPixels) return false;
  const float inverse_det = 1 / (xx * yy - xy * xy);
  patch->inverse_xx = yy * inverse_det, patch->inverse_xy = -xy * inverse_det,
  patch->inverse_yy = xx * inverse_det;
  return true;
}

/// Gauss-Newton on the position of a patch in an image; false: left the image.
bool Refine(const Patch& patch, const cv::Mat1f& image, int max_iterations, float min_step_px,
            cv::Point2f* position) {
  Samples<kSize, kSize> now;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    if (!now.Take(image, position->x - kHalf, position->y - kHalf)) return false;
    Lanes sum_x{}, sum_y{};
    for (int k = 0; k < kPixels; k += kLanes) {
      const Lanes &above = LanesAt(now.between + k), &below = LanesAt(now.between + k + kSize);
      const Lanes error = LanesAt(patch.value + k) - (above + now.ay * (below - above));
      sum_x += error * LanesAt(patch.slope_x + k), sum_y += error * LanesAt(patch.slope_y + k);
    }
    const float bx = Total(sum_x), by = Total(sum_y);
    const float dx = patch.inverse_xx * bx + patch.inverse_xy * by;
    const float dy = patch.inverse_xy * bx + patch.inverse_yy * by;
    position->x += dx, position->y += dy;
    if (dx * dx + dy * dy < min_step_px * min_step_px) break;
  }
  return true;
}

/// Mean absolute difference of a patch and the image there; empty: outside.
std::optional<float> DifferenceGrey(const Patch& patch, const cv::Mat1f& image, cv::Point2f position) {
  Samples<kSize, kSize> now;
  if (!now.Take(image, position.x - kHalf, position.y - kHalf)) return {};
  Lanes sum{};
  for (int k = 0; k < kPixels; k += kLanes)
    for (int i = 0; i < kLanes; ++i) sum[i] += std::abs(patch.value[k + i] - now.At(k + i));
  return Total(sum) / kPixels;
}

FlowResult TrackPatch(const std::vector<cv::Mat1f>& first, const std::vector<cv::Mat1f>& second,
                      const FlowQuery& query, const FlowOptions& options) {
  FlowResult result;
  cv::Point2f flow = query.predicted - query.position;
  Patch patch;
  for (int level = static_cast<int>(first.size()) - 1; level >= 0; --level) {
    // Halving by pyrDown keeps the centre of pixel (2 i, 2 j) at (i, j).
    const float scale = 1 / static_cast<float>(1 << level);
    const cv::Point2f here = query.position * scale;
    cv::Point2f there = here + flow * scale;
    // Coarse levels only lead the way: there it need not be turned.
    const auto axes = level == 0 ? query.first_from_second : std::nullopt;
    const float min_step_px = level == 0 ? options.min_step_px : options.min_coarse_step_px;
    const bool ok = MakePatch(first[level], here, axes, options.min_texture, &patch) &&
                    Refine(patch, second[level], options.max_iterations, min_step_px, &there);
    if (ok) flow = (there - here) / scale;
    if (!ok && level == 0) return result;  // coarser levels see less of the rim; the finest must succeed
  }
  result.position = query.position + flow;
  const std::optional<float> difference_grey = DifferenceGrey(patch, second.front(), result.position);
  result.ok = difference_grey && *difference_grey < options.max_difference_grey;
  return result;
}

/// The same to the last bit, with all it calls compiled for AVX2.
ORBSLAM_WIDE_VECTORS FlowResult TrackPatchWide(const std::vector<cv::Mat1f>& first,
                                               const std::vector<cv::Mat1f>& second, const FlowQuery& query,
                                               const FlowOptions& options) {
  return TrackPatch(first, second, query, options);
}

/// Fetches what a patch about a position will be made of: images of the past have long left the caches.
void Fetch(const cv::Mat1f& image, cv::Point2f centre) {
  const int u = std::clamp(cvFloor(centre.x - kHalf - 1), 0, image.cols - 1);
  const int last_u = std::min(u + kSize + 2, image.cols - 1);
  const int v = std::clamp(cvFloor(centre.y - kHalf - 1), 0, image.rows - 1);
  for (int row = v; row < std::min(v + kSize + 3, image.rows); ++row) {
    __builtin_prefetch(image[row] + u);
    __builtin_prefetch(image[row] + last_u);
  }
}

void Fetch(const std::vector<cv::Mat1f>& first, const std::vector<cv::Mat1f>& second,
           const FlowQuery& query) {
  for (size_t level = 0; level < first.size(); ++level)
    Fetch(first[level], query.position / static_cast<float>(1 << level));
  Fetch(second.front(), query.predicted);
}

}  // namespace

std::vector<cv::Point2f> SpreadCorners(const cv::Mat1b& gray, const CornerOptions& options) {
  FastCorners fast(options.fast_threshold, options.fast_threshold);
  const std::vector<Corner>& corners = fast.Detect(gray, static_cast<int>(kHalf) + 3);
  std::vector<std::vector<const Corner*>> cells(options.columns * options.rows);
  for (const Corner& corner : corners)
    cells[corner.y * options.rows / gray.rows * options.columns + corner.x * options.columns / gray.cols]
        .push_back(&corner);
  std::vector<cv::Point2f> chosen;
  for (auto& cell : cells) {
    const size_t count = std::min(cell.size(), static_cast<size_t>(options.per_cell));
    std::partial_sort(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(count), cell.end(),
                      [](const Corner* a, const Corner* b) {
                        if (a->score != b->score) return a->score > b->score;
                        return a < b;
                      });
    for (size_t i = 0; i < count; ++i) chosen.emplace_back(cell[i]->x, cell[i]->y);
  }
  return chosen;
}

std::vector<FlowResult> TrackPatches(const std::vector<cv::Mat1f>& first,
                                     const std::vector<cv::Mat1f>& second, std::span<const FlowQuery> queries,
                                     const FlowOptions& options) {
  const auto track = HasWideVectors() ? TrackPatchWide : TrackPatch;
  std::vector<FlowResult> results;
  results.reserve(queries.size());
  for (size_t i = 0; i < queries.size(); ++i) {
    if (i + 1 < queries.size()) Fetch(first, second, queries[i + 1]);
    results.push_back(track(first, second, queries[i], options));
  }
  return results;
}

}  // namespace orbslam
