// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/osmesa.h>
// After osmesa.h, which brings the base.
#include <GL/glext.h>

#include <array>
#include <memory>

#include "orbslam/util/result.h"

namespace orbslam {

/// An off-screen OpenGL 3.3 core context. What is drawn goes to framebuffer objects, so that its own buffer
/// is a formality.
class OsmesaContext {
 public:
  static Result<std::unique_ptr<OsmesaContext>> Create();
  ~OsmesaContext();
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  /// Makes the context the calling thread's for as long as this lives; one at a time.
  class Current {
   public:
    explicit Current(OsmesaContext* context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
  };

 private:
  static constexpr int kSide = 4;

  explicit OsmesaContext(OSMesaContext handle) : handle_(handle) {}
  bool MakeCurrent();

  OSMesaContext handle_;
  std::array<unsigned char, 4 * kSide * kSide> buffer_{};
};

}  // namespace orbslam
