// SPDX-License-Identifier: GPL-3.0-or-later
#include "orbslam/render/renderer.h"

#include <algorithm>
#include <array>
#include <mutex>

#include "gpu_cache.h"
#include "orbslam/util/check.h"
#include "shaders.h"
#include "targets.h"

namespace orbslam {
namespace {

constexpr double kNearM = 0.05, kFarM = 40.0;

/// Homogeneous OpenGL clip coordinates of a point in the camera frame: PinholeCamera::Project, with the first
/// row of pixels at the top and pixel centres at whole numbers.
Eigen::Matrix4f ClipFromCamera(const PinholeCamera& camera) {
  const double w = camera.width, h = camera.height, range = kFarM - kNearM;
  Eigen::Matrix4d clip;
  clip << 2 * camera.fx / w, 0, 2 * (camera.cx + 0.5) / w - 1, 0,   //
      0, 2 * camera.fy / h, 2 * (camera.cy + 0.5) / h - 1, 0,       //
      0, 0, (kFarM + kNearM) / range, -2 * kFarM * kNearM / range,  //
      0, 0, 1, 0;
  return clip.cast<float>();
}

Eigen::Matrix4f ToMatrix(const Rigid3d& b_from_a) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = b_from_a.RotationMatrix();
  matrix.topRightCorner<3, 1>() = b_from_a.translation;
  return matrix.cast<float>();
}

/// Inward unit normals, camera frame, of the four planes through the camera that bound the view.
std::array<Eigen::Vector3d, 4> SidesOfView(const PinholeCamera& camera) {
  const double left = (camera.cx + 0.5) / camera.fx, right = (camera.width - 0.5 - camera.cx) / camera.fx;
  const double top = (camera.cy + 0.5) / camera.fy, bottom = (camera.height - 0.5 - camera.cy) / camera.fy;
  return {Eigen::Vector3d(1, 0, left).normalized(), Eigen::Vector3d(-1, 0, right).normalized(),
          Eigen::Vector3d(0, 1, top).normalized(), Eigen::Vector3d(0, -1, bottom).normalized()};
}

}  // namespace

struct Renderer::Impl {
  Impl(const PinholeCamera& camera_in, std::unique_ptr<OsmesaContext> context_in)
      : camera(camera_in),
        context(std::move(context_in)),
        sides(SidesOfView(camera_in)),
        clip_from_camera(ClipFromCamera(camera_in)) {
    const OsmesaContext::Current current(context.get());
    color_program = MakeColorProgram();
    geometry_program = MakeGeometryProgram();
    color_target = std::make_unique<ColorTarget>(cv::Size(camera.width, camera.height));
    geometry_target = std::make_unique<GeometryTarget>(cv::Size(camera.width, camera.height));
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glFrontFace(GL_CW);  // rows run downwards, which mirrors
    glViewport(0, 0, camera.width, camera.height);
  }

  bool MayBeSeen(const GpuMesh& mesh, const Rigid3d& camera_from_mesh) const {
    const Eigen::Vector3d center = camera_from_mesh * mesh.center;
    const auto is_inside = [&](const Eigen::Vector3d& side) { return side.dot(center) > -mesh.radius; };
    return std::ranges::all_of(sides, is_inside);
  }

  /// set_material(object) is called before each object that may be seen is drawn.
  template <class SetMaterial>
  void Draw(GLuint program, std::span<const SceneObject> objects, const Rigid3d& camera_from_world,
            const SetMaterial& set_material) {
    glUniformMatrix4fv(glGetUniformLocation(program, "clip_from_camera"), 1, GL_FALSE,
                       clip_from_camera.data());
    const GLint transform = glGetUniformLocation(program, "camera_from_mesh");
    struct Visible {
      const SceneObject* object;
      const GpuMesh* mesh;
      Rigid3d camera_from_mesh;
      double far_end_m;
    };
    std::vector<Visible> visible;
    for (const SceneObject& object : objects) {
      const GpuMesh& mesh = cache.Find(object.mesh);
      const Rigid3d camera_from_mesh = camera_from_world * object.world_from_mesh;
      if (!MayBeSeen(mesh, camera_from_mesh)) continue;
      visible.push_back(
          {&object, &mesh, camera_from_mesh, (camera_from_mesh * mesh.center).norm() + mesh.radius});
    }
    // Near things first, walls last: what is hidden need not be shaded.
    std::ranges::stable_sort(visible, {}, &Visible::far_end_m);
    for (const Visible& item : visible) {
      glUniformMatrix4fv(transform, 1, GL_FALSE, ToMatrix(item.camera_from_mesh).data());
      set_material(*item.object);
      glBindVertexArray(item.mesh->array);
      glDrawElements(GL_TRIANGLES, item.mesh->num_indices, GL_UNSIGNED_INT, nullptr);
    }
  }

  void SetLighting(const Lighting& lighting, const Rigid3d& camera_from_world) const {
    const auto num_lamps = static_cast<int>(lighting.lamps.size());
    ORBSLAM_CHECK(num_lamps <= Lighting::kMaxLamps);
    Eigen::Matrix3Xf positions(3, num_lamps), directions(3, num_lamps), powers(3, num_lamps);
    for (int i = 0; i < num_lamps; ++i) {
      const Lamp& lamp = lighting.lamps[i];
      positions.col(i) = (camera_from_world * lamp.position).cast<float>();
      directions.col(i) = (camera_from_world.rotation * lamp.direction).cast<float>();
      powers.col(i) = lamp.power_bgr.reverse();  // the shader's colours are RGB
    }
    const auto set = [&](const char* name, const Eigen::Matrix3Xf& values) {
      const auto count = static_cast<GLsizei>(values.cols());
      if (count > 0) glUniform3fv(glGetUniformLocation(color_program, name), count, values.data());
    };
    set("lamp_position", positions);
    set("lamp_direction", directions);
    set("lamp_power", powers);
    set("from_above", lighting.from_above_bgr.reverse());
    set("from_below", lighting.from_below_bgr.reverse());
    set("up", (camera_from_world.rotation * Eigen::Vector3d::UnitZ()).cast<float>());
    glUniform1i(glGetUniformLocation(color_program, "num_lamps"), num_lamps);
  }

  std::mutex mutex;  // guards all below
  const PinholeCamera camera;
  const std::unique_ptr<OsmesaContext> context;
  const std::array<Eigen::Vector3d, 4> sides;
  const Eigen::Matrix4f clip_from_camera;
  GLuint color_program = 0, geometry_program = 0;
  std::unique_ptr<ColorTarget> color_target;
  std::unique_ptr<GeometryTarget> geometry_target;
  GpuCache cache;
};

Renderer::Renderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Renderer::~Renderer() = default;
const PinholeCamera& Renderer::camera() const { return impl_->camera; }

Result<std::unique_ptr<Renderer>> Renderer::Create(const PinholeCamera& camera) {
  ORBSLAM_CHECK(!camera.IsDistorted() && camera.width > 0 && camera.height > 0);
  Result<std::unique_ptr<OsmesaContext>> context = OsmesaContext::Create();
  if (!context) return context.error();
  return std::unique_ptr<Renderer>(new Renderer(std::make_unique<Impl>(camera, *std::move(context))));
}

cv::Mat Renderer::RenderColor(std::span<const SceneObject> objects, const Lighting& lighting,
                              const Rigid3d& world_from_camera) {
  const std::lock_guard lock(impl_->mutex);
  const OsmesaContext::Current current(impl_->context.get());
  const Rigid3d camera_from_world = Inverse(world_from_camera);
  const GLuint program = impl_->color_program;
  impl_->color_target->BindAndClear();
  glUseProgram(program);
  impl_->SetLighting(lighting, camera_from_world);
  const GLint color = glGetUniformLocation(program, "color"),
              shininess = glGetUniformLocation(program, "shininess");
  const GLint emission = glGetUniformLocation(program, "emission");
  impl_->Draw(program, objects, camera_from_world, [&](const SceneObject& object) {
    const Material& material = object.material;
    glBindTexture(GL_TEXTURE_2D, impl_->cache.Find(material.texture));
    glUniform3f(color, material.color_bgr.z(), material.color_bgr.y(), material.color_bgr.x());
    glUniform1f(shininess, material.shininess);
    glUniform1f(emission, material.emission);
  });
  cv::Mat bgr = impl_->color_target->ReadBgr();
  impl_->cache.DropUnused();
  return bgr;
}

GeometryView Renderer::RenderGeometry(std::span<const SceneObject> objects,
                                      const Rigid3d& world_from_camera) {
  const std::lock_guard lock(impl_->mutex);
  const OsmesaContext::Current current(impl_->context.get());
  const GLuint program = impl_->geometry_program;
  impl_->geometry_target->BindAndClear();
  glUseProgram(program);
  const GLint properties = glGetUniformLocation(program, "properties");
  impl_->Draw(program, objects, Inverse(world_from_camera), [&](const SceneObject& object) {
    glUniform4f(properties, static_cast<float>(object.label) / 255.0f, object.is_moving ? 1.0f : 0.0f,
                object.material.infrared, 0);
  });
  GeometryView view = impl_->geometry_target->Read();
  impl_->cache.DropUnused();
  return view;
}

}  // namespace orbslam
