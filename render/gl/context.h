// SPDX-License-Identifier: Apache-2.0
// A headless OpenGL 4.5 core context. Nothing is drawn to its own surface: frames go to framebuffer
// objects.
#pragma once

#include <memory>
#include <string>

namespace skyfit {

class GlContext {
 public:
  GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  virtual ~GlContext() = default;

  // Makes the context that of the calling thread and loads the OpenGL functions from it.
  virtual void make_current() = 0;
};

// Software rendering without display or GPU. The context is current when this returns. Throws
// std::runtime_error when the driver has no OpenGL 4.5 core.
std::unique_ptr<GlContext> make_osmesa_context();

// Throws std::runtime_error that names `where` and the error when OpenGL has recorded one since the
// last call.
void check_gl(const std::string& where);

}  // namespace skyfit
