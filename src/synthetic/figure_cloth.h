// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "orbslam/util/random.h"

namespace orbslam {

/// Woven and printed things. A tile is kClothTileM wide and repeats without a seam in both directions.
enum class Cloth { kChecks, kStripes, kPrint, kKnit, kJeans };

inline constexpr double kClothTileM = 0.32;

using Picture = std::shared_ptr<const cv::Mat>;  // CV_8UC3

/// kTilePx x kTilePx, pure in (cloth, the numbers drawn).
cv::Mat PaintCloth(Cloth cloth, Rng* rng);

/// The front, back and sides of a shirt, once round the body and from collar to hem: tiles of the cloth with
/// a button row, a pocket and a badge (or for kPrint and kKnit a line of large letters on chest and back).
Picture PaintShirt(Cloth cloth, double around_m, double height_m, Rng* rng);

/// Skin with eyes, brows and mouth in the middle; `rows` as fractions of the height from the top.
struct FaceRows {
  double brows, eyes, nose, mouth;
};
Picture PaintFace(const FaceRows& rows, const cv::Scalar& skin_bgr, const cv::Scalar& hair_bgr, Rng* rng);
Picture PaintSkin(const cv::Scalar& skin_bgr, Rng* rng);
Picture PaintHair(const cv::Scalar& hair_bgr, Rng* rng);

}  // namespace orbslam
