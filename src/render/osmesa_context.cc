// SPDX-License-Identifier: GPL-3.0-or-later
#include "osmesa_context.h"

#include <mutex>

#include "orbslam/util/check.h"

namespace orbslam {
namespace {

/// Mesa sets up what all contexts share with the first one: not made for two threads at once.
std::mutex& CreationMutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

Result<std::unique_ptr<OsmesaContext>> OsmesaContext::Create() {
  constexpr int kAttributes[] = {OSMESA_FORMAT,
                                 OSMESA_RGBA,
                                 OSMESA_DEPTH_BITS,
                                 0,
                                 OSMESA_PROFILE,
                                 OSMESA_CORE_PROFILE,
                                 OSMESA_CONTEXT_MAJOR_VERSION,
                                 3,
                                 OSMESA_CONTEXT_MINOR_VERSION,
                                 3,
                                 0};
  const std::lock_guard lock(CreationMutex());
  const OSMesaContext handle = OSMesaCreateContextAttribs(kAttributes, nullptr);
  if (!handle) return Error{"OSMesa makes no off-screen context of OpenGL 3.3"};
  std::unique_ptr<OsmesaContext> context(new OsmesaContext(handle));
  if (!context->MakeCurrent()) return Error{"OSMesa's off-screen context cannot be used"};
  OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0);
  return context;
}

OsmesaContext::~OsmesaContext() {
  const std::lock_guard lock(CreationMutex());
  OSMesaDestroyContext(handle_);
}

bool OsmesaContext::MakeCurrent() {
  return OSMesaMakeCurrent(handle_, buffer_.data(), GL_UNSIGNED_BYTE, kSide, kSide) == GL_TRUE;
}

OsmesaContext::Current::Current(OsmesaContext* context) { ORBSLAM_CHECK(context->MakeCurrent()); }
OsmesaContext::Current::~Current() { OSMesaMakeCurrent(nullptr, nullptr, 0, 0, 0); }

}  // namespace orbslam
