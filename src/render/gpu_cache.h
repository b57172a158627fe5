// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <unordered_map>

#include "orbslam/render/scene.h"
#include "osmesa_context.h"

namespace orbslam {

struct GpuMesh {
  std::shared_ptr<const Mesh> owner;
  GLuint array = 0, vertices = 0, indices = 0;
  GLsizei num_indices = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // of a sphere round it, frame of the mesh, metres
  double radius = 0;
};

/// Meshes and textures on the renderer's side, by address. All calls need the context to be current; what is
/// left in the end goes with the context.
class GpuCache {
 public:
  const GpuMesh& Find(const std::shared_ptr<const Mesh>& mesh);
  /// nullptr: a white texel.
  GLuint Find(const std::shared_ptr<const cv::Mat>& texture);
  /// Drops what nobody else holds any more.
  void DropUnused();

 private:
  struct GpuTexture {
    std::shared_ptr<const cv::Mat> owner;
    GLuint name = 0;
  };

  std::unordered_map<const Mesh*, GpuMesh> meshes_;
  std::unordered_map<const cv::Mat*, GpuTexture> textures_;
  GLuint white_ = 0;
};

}  // namespace orbslam
