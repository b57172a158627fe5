// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "figure_cloth.h"
#include "figure_mesh.h"
#include "orbslam/render/scene.h"
#include "orbslam/synthetic/figure.h"

namespace orbslam {

/// The skin-tight or clothed surfaces of a body's parts, each in its part's frame, metres; of a left part
/// (the right one is its mirror image). Where parts join, both go on round the joint.
class BodyMeshes {
 public:
  explicit BodyMeshes(const BodySize& size) : size_(size), scale_(size.height / 1.75) {}

  Mesh Hips() const;
  Mesh Shirt() const;
  Mesh Neck() const;
  Mesh Face() const;
  Mesh Ears() const;
  Mesh Hair() const;
  Mesh UpperArm() const;
  Mesh Forearm() const;
  Mesh Hand() const;
  Mesh Thigh() const;
  Mesh Shin() const;
  Mesh Shoe() const;
  Mesh ShoeTip() const;

  static FaceRows Rows();
  double ShirtAroundM() const { return 0.96 * scale_; }
  double ShirtHeightM() const { return 0.62 * scale_; }

 private:
  /// A loft of sections given for a height of 1.75 m, with a cloth's tiles counted out along it.
  Mesh Limb(std::vector<Section> sections, int around, int along) const;

  BodySize size_;
  double scale_;
};

}  // namespace orbslam
