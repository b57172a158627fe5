// SPDX-License-Identifier: GPL-3.0-or-later
#include "targets.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "orbslam/util/check.h"

namespace orbslam {
namespace {

GLuint BindNewFramebuffer() {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  return name;
}

void Attach(GLenum attachment, GLenum format, cv::Size size, int samples) {
  GLuint name = 0;
  glGenRenderbuffers(1, &name);
  glBindRenderbuffer(GL_RENDERBUFFER, name);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, size.width, size.height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, name);
}

void ExpectComplete() { ORBSLAM_CHECK(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE); }

cv::Mat ReadPixels(cv::Size size, int type, GLenum format, GLenum kind) {
  cv::Mat pixels(size, type);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.width, size.height, format, kind, pixels.data);
  return pixels;
}

}  // namespace

ColorTarget::ColorTarget(cv::Size size) : size_(size) {
  resolved_ = BindNewFramebuffer();
  Attach(GL_COLOR_ATTACHMENT0, GL_RGBA8, size, 0);
  ExpectComplete();
  many_samples_ = BindNewFramebuffer();
  Attach(GL_COLOR_ATTACHMENT0, GL_RGBA8, size, kSamples);
  Attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, size, kSamples);
  ExpectComplete();
}

void ColorTarget::BindAndClear() const {
  glBindFramebuffer(GL_FRAMEBUFFER, many_samples_);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

cv::Mat ColorTarget::ReadBgr() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, many_samples_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
  glBlitFramebuffer(0, 0, size_.width, size_.height, 0, 0, size_.width, size_.height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  cv::Mat bgr;
  cv::cvtColor(ReadPixels(size_, CV_8UC4, GL_RGBA, GL_UNSIGNED_BYTE), bgr, cv::COLOR_RGBA2BGR);
  return bgr;
}

GeometryTarget::GeometryTarget(cv::Size size) : size_(size), framebuffer_(BindNewFramebuffer()) {
  Attach(GL_COLOR_ATTACHMENT0, GL_R32F, size, 0);
  Attach(GL_COLOR_ATTACHMENT1, GL_RGBA8, size, 0);
  Attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F, size, 0);
  constexpr GLenum kBoth[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  glDrawBuffers(2, kBoth);
  ExpectComplete();
}

void GeometryTarget::BindAndClear() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

GeometryView GeometryTarget::Read() const {
  GeometryView view;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  view.depth_m = ReadPixels(size_, CV_32FC1, GL_RED, GL_FLOAT);
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  cv::Mat channels[4];
  cv::split(ReadPixels(size_, CV_8UC4, GL_RGBA, GL_UNSIGNED_BYTE), channels);
  view.labels = channels[0], view.moving = channels[1], view.infrared = channels[2],
  view.cosine = channels[3];
  return view;
}

}  // namespace orbslam
