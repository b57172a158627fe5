// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "canvas.h"
#include "light_bake.h"
#include "mesh_builder.h"
#include "orbslam/synthetic/room.h"

namespace orbslam {

/// Where a piece of furniture stands: its frame has z up and its front along -y at yaw 0.
Eigen::Isometry3d Place(double x, double y, double z, double yaw_deg);

enum class Face { kFront, kBack, kLeft, kRight, kTop, kBottom };

/// Collects what a room is made of; one object in the end for each material. Boxes are given by two corners
/// in a frame whose z is up. All random decisions draw from rng().
class RoomBuilder {
 public:
  RoomBuilder(uint64_t seed, double texels_per_metre);

  Rng& rng() { return rng_; }

  using PaintFunction = std::function<void(Canvas*)>;
  /// A material whose texture repeats every `period_m` in both directions, painted when first used; later
  /// calls with the same name return it.
  int Tiled(const std::string& name, double period_m, double detail, const Material& look,
            const PaintFunction& paint);
  int Plain(const std::string& name, const Eigen::Vector3f& bgr, float shininess = 0, float infrared = 1);

  void Box(const Eigen::Isometry3d& place, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
           int material);
  /// One face of a box, with a picture of its own. Keep it a little before what is behind.
  void Picture(const Eigen::Isometry3d& place, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
               Face face, double detail, const Material& look, const PaintFunction& paint);
  /// Smooth pieces of a plain or tiled material.
  MeshBuilder& Shape(int material) { return parts_[material].mesh; }
  void Occlude(const Eigen::Isometry3d& place, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

  Room Take(const Lighting& lighting);

 private:
  struct Part {
    Material material;
    double period_m = 1;
    MeshBuilder mesh;
  };

  std::shared_ptr<const cv::Mat> Painted(double width, double height, double detail,
                                         const PaintFunction& paint);
  static constexpr double kPieceM = 0.14;  // of a lit surface

  double texels_per_metre_;
  Rng rng_;
  std::vector<Part> parts_;
  std::map<std::string, int> by_name_;
  std::vector<Occluder> occluders_;
};

}  // namespace orbslam
