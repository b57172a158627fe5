// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "orbslam/util/check.h"

namespace orbslam {
namespace {

using Eigen::Vector3d;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Normals from the faces, weighted by area; vertices at one place share theirs, so that seams do not show.
void SmoothNormals(Mesh* mesh) {
  struct Hash {
    size_t operator()(const Eigen::Vector3i& p) const {
      return static_cast<size_t>(p.x()) * 73856093u ^ static_cast<size_t>(p.y()) * 19349663u ^
             static_cast<size_t>(p.z()) * 83492791u;
    }
  };
  std::unordered_map<Eigen::Vector3i, Eigen::Vector3f, Hash> sums;
  const auto key = [](const Eigen::Vector3f& p) -> Eigen::Vector3i {
    constexpr float kPerMetre = 1e5f;
    return (kPerMetre * p).array().round().cast<int>();
  };
  auto& vertices = mesh->vertices;
  for (size_t i = 0; i + 2 < mesh->indices.size(); i += 3) {
    const auto& a = vertices[mesh->indices[i]].position;
    const auto& b = vertices[mesh->indices[i + 1]].position;
    const auto& c = vertices[mesh->indices[i + 2]].position;
    const Eigen::Vector3f normal = (b - a).cross(c - a);
    for (const auto* corner : {&a, &b, &c})
      sums.try_emplace(key(*corner), 0.0f, 0.0f, 0.0f).first->second += normal;
  }
  for (Vertex& vertex : vertices) {
    const Eigen::Vector3f sum = sums[key(vertex.position)];
    if (sum.norm() > 0) vertex.normal = sum.normalized();
  }
}

Section Mix(const Section& a, const Section& b, double wa, double wb) {
  return {wa * a.z + wb * b.z, wa * a.radius_x + wb * b.radius_x, wa * a.radius_y + wb * b.radius_y,
          wa * a.center_x + wb * b.center_x, wa * a.center_y + wb * b.center_y};
}

/// Cubic Hermite between sections with central slopes (Catmull-Rom for uneven knots).
Section SectionAt(std::span<const Section> sections, double z) {
  size_t i = 0;
  while (i + 2 < sections.size() && sections[i + 1].z < z) ++i;
  const auto slope = [sections](size_t k) {
    const Section &before = sections[k > 0 ? k - 1 : k],
                  &after = sections[std::min(k + 1, sections.size() - 1)];
    const double dz = after.z - before.z;
    return Mix(after, before, 1 / dz, -1 / dz);
  };
  const double dz = sections[i + 1].z - sections[i].z, t = (z - sections[i].z) / dz;
  const double h1 = t * t * (3 - 2 * t), h2 = t * (1 - t) * (1 - t) * dz, h3 = t * t * (t - 1) * dz;
  return Mix(Mix(sections[i], sections[i + 1], 1 - h1, h1), Mix(slope(i), slope(i + 1), h2, h3), 1, 1);
}

/// Fine sections from the bottom up, with rounded ends where wanted.
std::vector<Section> FineSections(std::span<const Section> sections, const LoftDetail& detail) {
  constexpr int kCapRings = 4;
  constexpr double kCapDepth = 0.8;  // of the smaller radius
  std::vector<Section> fine;
  const auto cap = [](const Section& end, double angle, double sign) {
    const double depth = kCapDepth * std::min(end.radius_x, end.radius_y), c = std::cos(angle);
    return Section{end.z + sign * depth * std::sin(angle), c * end.radius_x, c * end.radius_y, end.center_x,
                   end.center_y};
  };
  for (int i = kCapRings; i > 0 && detail.close_bottom; --i) {
    fine.push_back(cap(sections.front(), kTurn / 4 * i / kCapRings, -1));
  }
  for (int i = 0; i <= detail.along; ++i) {
    const double z = sections.front().z + (sections.back().z - sections.front().z) * i / detail.along;
    Section section = SectionAt(sections, z);
    section.z = z;
    fine.push_back(section);
  }
  for (int i = 1; i <= kCapRings && detail.close_top; ++i) {
    fine.push_back(cap(sections.back(), kTurn / 4 * i / kCapRings, 1));
  }
  return fine;
}

}  // namespace

Mesh Loft(std::span<const Section> sections, const LoftDetail& detail) {
  ORBSLAM_CHECK(sections.size() >= 2);
  const std::vector<Section> rings = FineSections(sections, detail);
  const double top = rings.back().z, height = top - rings.front().z;
  Mesh mesh;
  for (const Section& ring : rings) {
    for (int i = 0; i <= detail.around; ++i) {
      const double share = static_cast<double>(i % detail.around) / detail.around;
      const Vector3d out(-std::cos(kTurn * share), -std::sin(kTurn * share), 0);
      const Vector3d position(ring.center_x + ring.radius_x * out.x(),
                              ring.center_y + ring.radius_y * out.y(), ring.z);
      const Eigen::Vector2d uv(detail.repeats_u * i / detail.around,
                               detail.repeats_v * (top - ring.z) / height);
      mesh.vertices.push_back({position.cast<float>(), out.cast<float>(), uv.cast<float>()});
    }
  }
  const auto columns = static_cast<uint32_t>(detail.around + 1);
  for (uint32_t row = 0; row + 1 < rings.size(); ++row) {
    for (uint32_t i = 0; i + 1 < columns; ++i) {
      const uint32_t a = row * columns + i, b = a + 1, c = a + columns, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
    }
  }
  SmoothNormals(&mesh);
  return mesh;
}

Mesh Ellipsoid(const Vector3d& center, const Vector3d& radii, int around, int along) {
  std::vector<Section> sections;
  constexpr double kNearlyAll = 0.995;
  for (int i = 0; i <= along; ++i) {
    const double z = kNearlyAll * std::sin(kTurn / 2 * (static_cast<double>(i) / along - 0.5));
    const double r = std::sqrt(1 - z * z);
    sections.push_back({center.z() + radii.z() * z, r * radii.x(), r * radii.y(), center.x(), center.y()});
  }
  return Loft(sections, {around, 2 * along, 1, 1, true, true});
}

Mesh BoxMesh(const Vector3d& low, const Vector3d& high) {
  Mesh mesh;
  const Vector3d size = high - low;
  const auto side = [&](const Vector3d& normal, const Vector3d& right, const Vector3d& down) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (int i = 0; i < 4; ++i) {
      const int u = i % 2, v = i / 2;
      const Vector3d unit = 0.5 * (normal + (2 * u - 1) * right + (2 * v - 1) * down);
      const Vector3d position = 0.5 * (low + high) + unit.cwiseProduct(size);
      mesh.vertices.push_back({position.cast<float>(), normal.cast<float>(),
                               Eigen::Vector2f(static_cast<float>(u), static_cast<float>(v))});
    }
    mesh.indices.insert(mesh.indices.end(), {first, first + 2, first + 1, first + 1, first + 2, first + 3});
  };
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  for (const Vector3d& normal : {x, y, Vector3d(-x), Vector3d(-y)}) side(normal, z.cross(normal), -z);
  side(z, x, -y);
  side(-z, x, y);
  return mesh;
}

Mesh Rod(const Vector3d& from, const Vector3d& to, double radius, int around) {
  const double length = (to - from).norm();
  const std::array<Section, 2> ends = {{{0, radius, radius}, {length, radius, radius}}};
  Mesh mesh = Loft(ends, {around, 2, 1, 1, true, true});
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), to - from).toRotationMatrix();
  place.translation() = from;
  Transform(place, &mesh);
  return mesh;
}

void Displace(const std::function<Vector3d(const Vertex&)>& offset, Mesh* mesh) {
  for (Vertex& vertex : mesh->vertices) vertex.position += offset(vertex).cast<float>();
  SmoothNormals(mesh);
}

void Transform(const Eigen::Isometry3d& to_from_mesh, Mesh* mesh) {
  const Eigen::Isometry3f to = to_from_mesh.cast<float>();
  for (Vertex& vertex : mesh->vertices) {
    vertex.position = to * vertex.position;
    vertex.normal = (to.linear() * vertex.normal).normalized();  // scales are the same along all axes
  }
}

void MirrorY(Mesh* mesh) {
  for (Vertex& vertex : mesh->vertices) {
    vertex.position.y() = -vertex.position.y();
    vertex.normal.y() = -vertex.normal.y();
  }
  for (size_t i = 0; i + 2 < mesh->indices.size(); i += 3) std::swap(mesh->indices[i], mesh->indices[i + 1]);
}

void Append(const Mesh& other, Mesh* mesh) {
  const auto first = static_cast<uint32_t>(mesh->vertices.size());
  mesh->vertices.insert(mesh->vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const uint32_t index : other.indices) mesh->indices.push_back(first + index);
}

}  // namespace orbslam
