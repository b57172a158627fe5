// SPDX-License-Identifier: GPL-3.0-or-later
#include "gpu_cache.h"

#include <algorithm>
#include <cstddef>

#include "orbslam/util/check.h"
#include "shaders.h"

namespace orbslam {
namespace {

void PointTo(VertexAttribute attribute, GLint count, size_t offset) {
  glEnableVertexAttribArray(attribute);
  glVertexAttribPointer(attribute, count, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                        reinterpret_cast<void*>(offset));
}

GpuMesh Upload(const std::shared_ptr<const Mesh>& mesh) {
  GpuMesh gpu{mesh};
  glGenVertexArrays(1, &gpu.array);
  glBindVertexArray(gpu.array);
  glGenBuffers(1, &gpu.vertices);
  glBindBuffer(GL_ARRAY_BUFFER, gpu.vertices);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh->vertices.size() * sizeof(Vertex)),
               mesh->vertices.data(), GL_STATIC_DRAW);
  PointTo(kPosition, 3, offsetof(Vertex, position));
  PointTo(kNormal, 3, offsetof(Vertex, normal));
  PointTo(kUv, 2, offsetof(Vertex, uv));
  PointTo(kLight, 1, offsetof(Vertex, light));
  glGenBuffers(1, &gpu.indices);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gpu.indices);
  gpu.num_indices = static_cast<GLsizei>(mesh->indices.size());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh->indices.size() * sizeof(uint32_t)),
               mesh->indices.data(), GL_STATIC_DRAW);
  Eigen::AlignedBox3f box;
  for (const Vertex& vertex : mesh->vertices) box.extend(vertex.position);
  if (!box.isEmpty()) {
    gpu.center = box.center().cast<double>();
    gpu.radius = 0.5 * box.diagonal().norm();
  }
  return gpu;
}

/// bgr: CV_8UC3. Repeats; trilinear, since aliasing would be features that no camera sees.
GLuint UploadTexture(const cv::Mat& bgr) {
  ORBSLAM_CHECK(bgr.type() == CV_8UC3 && bgr.isContinuous());
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, bgr.cols, bgr.rows, 0, GL_BGR, GL_UNSIGNED_BYTE, bgr.data);
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return name;
}

}  // namespace

const GpuMesh& GpuCache::Find(const std::shared_ptr<const Mesh>& mesh) {
  GpuMesh& gpu = meshes_[mesh.get()];
  if (!gpu.owner) gpu = Upload(mesh);
  return gpu;
}

GLuint GpuCache::Find(const std::shared_ptr<const cv::Mat>& texture) {
  if (!texture) {
    if (white_ == 0) white_ = UploadTexture(cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(255)));
    return white_;
  }
  GpuTexture& gpu = textures_[texture.get()];
  if (!gpu.owner) gpu = {texture, UploadTexture(*texture)};
  return gpu.name;
}

void GpuCache::DropUnused() {
  std::erase_if(meshes_, [](const auto& entry) {
    const GpuMesh& mesh = entry.second;
    if (mesh.owner.use_count() > 1) return false;
    const GLuint buffers[] = {mesh.vertices, mesh.indices};
    glDeleteBuffers(2, buffers);
    glDeleteVertexArrays(1, &mesh.array);
    return true;
  });
  std::erase_if(textures_, [](const auto& entry) {
    const GpuTexture& texture = entry.second;
    if (texture.owner.use_count() > 1) return false;
    glDeleteTextures(1, &texture.name);
    return true;
  });
}

}  // namespace orbslam
