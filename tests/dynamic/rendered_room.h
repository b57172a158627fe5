// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "orbslam/dynamic/dynamic_detector.h"
#include "orbslam/geometry/so3.h"
#include "orbslam/util/random.h"

namespace orbslam::test {

/// An upright box with its front parallel to the wall; metres, world: x right, y down, z forward.
struct RoomBox {
  Eigen::Vector3d centre, half_size;
};

/// A textured back wall, a floor, two resting boxes and what else is given, seen by a camera.
class RenderedRoom {
 public:
  PinholeCamera camera{320, 240, 260, 260, 159.5, 119.5, {}};
  double wall_z_m = 3.5;
  double depth_noise = 1;  // times the sensor's sigma

  RgbdImage Render(uint32_t frame, const Rigid3d& world_from_camera,
                   const std::vector<RoomBox>& movers) const {
    RgbdImage image;
    image.id = FrameId(frame);
    image.timestamp_s = frame / 30.0;
    image.gray = cv::Mat(camera.height, camera.width, CV_8UC1);
    image.depth_m = cv::Mat(camera.height, camera.width, CV_32FC1);
    Rng rng(7, frame);
    std::vector<RoomBox> boxes{{{-1.0, 0.7, 2.6}, {0.25, 0.5, 0.2}}, {{1.1, 0.8, 2.2}, {0.2, 0.4, 0.3}}};
    boxes.insert(boxes.end(), movers.begin(), movers.end());
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u) {
        double depth = 0;
        const double gray = ShadePixel(world_from_camera, u, v, boxes, &depth);
        image.gray.at<uint8_t>(v, u) = static_cast<uint8_t>(gray + rng.Uniform(-2, 2));
        image.depth_m.at<float>(v, u) =
            static_cast<float>(depth + depth_noise * DepthModel::SigmaM(depth) * rng.Gaussian());
      }
    return image;
  }

  /// Pixels on the boxes given, without noise.
  cv::Mat1b Truth(const Rigid3d& world_from_camera, const std::vector<RoomBox>& movers) const {
    cv::Mat1b truth(camera.height, camera.width, uint8_t{0});
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u)
        for (const RoomBox& box : movers)
          if (Entry(world_from_camera.translation, world_from_camera.rotation * camera.Unproject(u, v, 1),
                    box) > 0)
            truth(v, u) = 255;
    return truth;
  }

 private:
  /// The mean over a pixel's area, as a sensor takes it: point samples would hide motions below a pixel.
  /// depth: of its middle.
  double ShadePixel(const Rigid3d& world_from_camera, int u, int v, const std::vector<RoomBox>& boxes,
                    double* depth) const {
    // A grid turned so that edges of either direction cross one sample after the other.
    constexpr std::array<std::pair<double, double>, 4> kSamples{
        {{-0.125, -0.375}, {0.375, -0.125}, {0.125, 0.375}, {-0.375, 0.125}}};
    const auto shade = [&](double du, double dv) {
      return Shade(world_from_camera.translation,
                   world_from_camera.rotation * camera.Unproject(u + du, v + dv, 1), boxes, depth);
    };
    double sum = 0;
    for (const auto& [du, dv] : kSamples) sum += shade(du, dv);
    shade(0, 0);
    return sum / kSamples.size();
  }

  /// Depth (along a ray with z = 1 in the camera) at which it enters a box; 0: it misses.
  static double Entry(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray, const RoomBox& box) {
    const Eigen::Array3d to = (box.centre - origin).array(), d = ray.array();
    const double first = ((to - box.half_size.array() * d.sign()) / d).maxCoeff();
    const double last = ((to + box.half_size.array() * d.sign()) / d).minCoeff();
    return first > 0.1 && first < last ? first : 0;
  }

  /// Patches of 9 cm with sharp corners, fixed to the thing's own coordinates.
  static double Texture(const Eigen::Vector3d& x, uint64_t thing) {
    const auto patch = [](double t) {
      return static_cast<uint64_t>(static_cast<int64_t>(std::floor(t / 0.09)) + 4096);
    };
    return 40 + static_cast<double>(Rng(patch(x.x()), patch(x.y()), patch(x.z()) * 64 + thing).Below(170));
  }

  double Shade(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray, const std::vector<RoomBox>& boxes,
               double* depth) const {
    *depth = (wall_z_m - origin.z()) / ray.z();
    uint64_t thing = 0;
    Eigen::Vector3d shift(0, 0, 0.045);  // keeps the surfaces off the patches' borders
    const double floor_depth = ray.y() > 0 ? (1.2 - origin.y()) / ray.y() : 1e9;
    if (floor_depth < *depth) *depth = floor_depth, thing = 1, shift = {0, 0.045, 0};
    for (size_t i = 0; i < boxes.size(); ++i) {
      const double entry = Entry(origin, ray, boxes[i]);
      if (entry <= 0 || entry >= *depth) continue;
      *depth = entry, thing = 2 + i;
      shift = -boxes[i].centre + Eigen::Vector3d(0.01, 0.01, 0.01);
    }
    return Texture(origin + *depth * ray + shift, thing);
  }
};

/// A hand-held camera that sways by some centimetres and a degree.
inline Rigid3d Sway(uint32_t frame, double scale = 1) {
  const double t = frame / 30.0;
  return {
      So3Exp(scale * Eigen::Vector3d(0.02 * std::sin(1.3 * t), 0.03 * std::sin(1.9 * t), 0.01 * std::sin(t))),
      scale * Eigen::Vector3d(0.06 * std::sin(2 * t), 0.03 * std::sin(2.7 * t), 0.05 * std::sin(1.7 * t))};
}

struct MaskScore {
  double recall = 0, precision = 0, masked_share = 0;
};

/// Pixels within 8 px of the truth count neither way.
inline MaskScore Score(const cv::Mat& mask, const cv::Mat1b& truth) {
  double hit = 0, true_pixels = 0, right = 0, wrong = 0, masked = 0;
  for (int v = 0; v < truth.rows; ++v)
    for (int u = 0; u < truth.cols; ++u) {
      const bool is_masked = !mask.empty() && mask.at<uint8_t>(v, u) != 0;
      true_pixels += truth(v, u) != 0, masked += is_masked;
      hit += is_masked && truth(v, u) != 0;
      if (!is_masked) continue;
      const cv::Rect near = cv::Rect(u - 8, v - 8, 17, 17) & cv::Rect(0, 0, truth.cols, truth.rows);
      right += truth(v, u) != 0, wrong += truth(v, u) == 0 && cv::countNonZero(truth(near)) == 0;
    }
  return {true_pixels > 0 ? hit / true_pixels : 1, right + wrong > 0 ? right / (right + wrong) : 1,
          masked / static_cast<double>(truth.total())};
}

}  // namespace orbslam::test
