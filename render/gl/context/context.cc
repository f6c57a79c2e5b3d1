// SPDX-License-Identifier: Apache-2.0
#include "render/gl/context/context.h"

#include <EGL/egl.h>
#include <fmt/format.h>
#include <glad/gl.h>
// After glad, which replaces the system's OpenGL header.
#include <GL/osmesa.h>

#include <stdexcept>

namespace skyfit {

void GlContext::describe(const std::string& way) {
  const auto text = [](GLenum name) { return reinterpret_cast<const char*>(glGetString(name)); };
  description_ = fmt::format("{}, OpenGL {}, by {}", text(GL_RENDERER), text(GL_VERSION), way);
}

std::unique_ptr<GlContext> make_context(GraphicsDevice device) {
  return device == GraphicsDevice::kGpu ? make_egl_context() : make_osmesa_context();
}

void release_current_context() {
  // EGL first: with one of EGL's current, OSMesa takes it for its own.
  if (eglGetCurrentContext() != EGL_NO_CONTEXT) {
    eglMakeCurrent(eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  if (OSMesaGetCurrentContext() != nullptr) {
    OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
  }
}

void check_gl(const std::string& where) {
  const GLenum error = glGetError();
  if (error != GL_NO_ERROR) {
    throw std::runtime_error(fmt::format("render: {}: OpenGL error 0x{:04x}", where, error));
  }
}

}  // namespace skyfit
