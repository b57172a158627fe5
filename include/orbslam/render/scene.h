// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "orbslam/geometry/rigid3.h"

namespace orbslam {

struct Vertex {
  Eigen::Vector3f position;  // metres, frame of the mesh
  Eigen::Vector3f normal;    // unit, outwards
  Eigen::Vector2f uv;        // of the texture, which repeats; v runs down the image
  float light = 1;           // share of the lamps' and the room's light that arrives: baked shadows
};

/// Triangles, counter-clockwise seen from outside; three indices of vertices each.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
};

/// How a surface looks, and how a depth camera likes it.
struct Material {
  std::shared_ptr<const cv::Mat> texture;  // CV_8UC3 BGR; nullptr: plain
  Eigen::Vector3f color_bgr{1, 1, 1};      // multiplies the texture
  float shininess = 0;                     // weight of the highlight, in [0, 1]
  float emission = 0;  // share of the colour that needs no light, in [0, 1]: lamps, screens
  float infrared =
      1;  // share of the projector's pattern that comes back, in [0, 1]: dark and shiny things lose depth
};

/// One rigid thing. label 0: belongs to the room; others name what can move (a person's parts share one).
struct SceneObject {
  std::shared_ptr<const Mesh> mesh;
  Material material;
  Rigid3d world_from_mesh;
  uint8_t label = 0;
  bool is_moving = false;  // at this moment, by the eye: see who fills it in
};

}  // namespace orbslam
