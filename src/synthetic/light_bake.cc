// SPDX-License-Identifier: GPL-3.0-or-later
#include "light_bake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace orbslam {
namespace {

using Eigen::Vector3f;

struct Box {
  Vector3f middle, half_size;
  float cosine, sine;
  float radius;

  Vector3f Turned(const Vector3f& v) const {
    return {cosine * v.x() + sine * v.y(), cosine * v.y() - sine * v.x(), v.z()};
  }
  /// Whether origin + t direction is inside for some t in (0, 1); Kay and Kajiya's slabs (SIGGRAPH 1986).
  bool Hides(const Vector3f& origin, const Vector3f& direction) const {
    const Vector3f o = Turned(origin - middle), d = Turned(direction);
    float enter = 0, leave = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const float inverse = 1.0f / (std::abs(d[axis]) < 1e-6f ? 1e-6f : d[axis]);
      const float a = (-half_size[axis] - o[axis]) * inverse, b = (half_size[axis] - o[axis]) * inverse;
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter < leave;
  }
};

constexpr int kNumSkyRays = 24, kNumLampRays = 4;
constexpr float kSkyReachM = 0.9f;

/// Directions of the upper hemisphere, cosine-weighted, by a golden-angle spiral.
std::array<Vector3f, kNumSkyRays> SkyDirections() {
  std::array<Vector3f, kNumSkyRays> directions;
  for (int i = 0; i < kNumSkyRays; ++i) {
    const float radius = std::sqrt((static_cast<float>(i) + 0.5f) / kNumSkyRays),
                angle = 2.39996f * static_cast<float>(i);
    directions[i] = {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - radius * radius)};
  }
  return directions;
}

bool IsHidden(const std::vector<Box>& boxes, const Vector3f& origin, const Vector3f& ray) {
  return std::ranges::any_of(boxes, [&](const Box& box) { return box.Hides(origin, ray); });
}

float OpenSky(const std::vector<Box>& boxes, const Vector3f& origin, const Vector3f& normal) {
  static const std::array<Vector3f, kNumSkyRays> directions = SkyDirections();
  std::vector<Box> near;
  for (const Box& box : boxes) {
    if ((box.middle - origin).squaredNorm() < (box.radius + kSkyReachM) * (box.radius + kSkyReachM))
      near.push_back(box);
  }
  if (near.empty()) return 1;
  const Vector3f x = normal.unitOrthogonal(), y = normal.cross(x);
  int open = 0;
  for (const Vector3f& d : directions) {
    open += !IsHidden(near, origin, kSkyReachM * (d.x() * x + d.y() * y + d.z() * normal));
  }
  return static_cast<float>(open) / kNumSkyRays;
}

/// The light of the lamps that arrives, and what would arrive without occluders.
Eigen::Vector2f LampLight(const std::vector<Box>& boxes, const Lighting& lighting, const Vector3f& origin,
                          const Vector3f& normal) {
  constexpr std::array<std::array<float, 2>, kNumLampRays> kOffsets{
      {{-0.25f, -0.15f}, {0.25f, 0.15f}, {-0.15f, 0.25f}, {0.15f, -0.25f}}};
  Eigen::Vector2f sum(0, 0);
  for (const Lamp& lamp : lighting.lamps) {
    const Vector3f direction = lamp.direction.cast<float>(), x = direction.unitOrthogonal(),
                   y = direction.cross(x);
    for (const auto& offset : kOffsets) {
      const Vector3f ray = lamp.position.cast<float>() + offset[0] * x + offset[1] * y - origin;
      const float squared = ray.squaredNorm(), cosines = normal.dot(ray) * -direction.dot(ray) / squared;
      if (normal.dot(ray) <= 0 || cosines <= 0) continue;
      const float light = lamp.power_bgr.mean() * cosines / (squared + 0.2f) / kNumLampRays;
      sum[1] += light;
      if (!IsHidden(boxes, origin, 0.97f * ray)) sum[0] += light;
    }
  }
  return sum;
}

}  // namespace

void BakeLight(std::span<const Occluder> occluders, const Lighting& lighting, Mesh* mesh) {
  std::vector<Box> boxes;
  for (const Occluder& o : occluders) {
    boxes.push_back({o.middle.cast<float>(), o.half_size.cast<float>(), static_cast<float>(o.cosine),
                     static_cast<float>(o.sine), static_cast<float>(o.half_size.norm())});
  }
  constexpr float kLiftM = 0.012f;
  for (Vertex& vertex : mesh->vertices) {
    const Vector3f origin = vertex.position + kLiftM * vertex.normal;
    const float ambient = (0.5f + 0.5f * vertex.normal.z()) * lighting.from_above_bgr.mean() +
                          (0.5f - 0.5f * vertex.normal.z()) * lighting.from_below_bgr.mean();
    const Eigen::Vector2f lamps = LampLight(boxes, lighting, origin, vertex.normal);
    const float open = 0.15f + 0.85f * OpenSky(boxes, origin, vertex.normal);
    vertex.light = (ambient * open + lamps[0] * (0.6f + 0.4f * open)) / (ambient + lamps[1]);
  }
}

}  // namespace orbslam
