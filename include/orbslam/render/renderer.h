// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "orbslam/camera/pinhole_camera.h"
#include "orbslam/geometry/rigid3.h"
#include "orbslam/render/scene.h"
#include "orbslam/util/result.h"

namespace orbslam {

/// A small panel that shines to its front.
struct Lamp {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();     // world, metres
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  // unit, to its front
  Eigen::Vector3f power_bgr = Eigen::Vector3f::Ones();    // radiance of white paper 1 m straight before it
};

/// Lamps, and what comes from everywhere: from above to faces that look up, from below to those that look
/// down.
struct Lighting {
  static constexpr int kMaxLamps = 6;
  std::vector<Lamp> lamps;  // at most kMaxLamps
  Eigen::Vector3f from_above_bgr{0.5f, 0.5f, 0.5f}, from_below_bgr{0.3f, 0.3f, 0.3f};
};

/// What is seen through the centre of each pixel.
struct GeometryView {
  cv::Mat depth_m;   // CV_32FC1, along the optical axis; 0: nothing there
  cv::Mat labels;    // CV_8UC1, SceneObject::label
  cv::Mat moving;    // CV_8UC1, 255: SceneObject::is_moving
  cv::Mat infrared;  // CV_8UC1, 255 times Material::infrared
  cv::Mat cosine;    // CV_8UC1, 255 times the cosine between the line of sight and the surface's normal
};

/// Draws scenes in memory (OSMesa: no display, no GPU). Textures are taken as gamma-coded (gamma 2) and lit
/// in linear light. Meshes and textures are kept by their address for as long as somebody else holds them, so
/// that they must not change. Calls from several threads wait for each other; the picture depends on neither.
class Renderer {
 public:
  /// camera: undistorted. Error: no off-screen context of OpenGL 3.3 can be had.
  static Result<std::unique_ptr<Renderer>> Create(const PinholeCamera& camera);
  ~Renderer();

  /// CV_8UC3, anti-aliased (4 samples a pixel).
  cv::Mat RenderColor(std::span<const SceneObject> objects, const Lighting& lighting,
                      const Rigid3d& world_from_camera);
  GeometryView RenderGeometry(std::span<const SceneObject> objects, const Rigid3d& world_from_camera);

  const PinholeCamera& camera() const;

 private:
  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace orbslam
