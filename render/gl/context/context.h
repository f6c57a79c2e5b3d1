// SPDX-License-Identifier: Apache-2.0
// A headless OpenGL 4.5 core context. Nothing is drawn to its own surface: frames go to framebuffer
// objects.
#pragma once

#include <memory>
#include <string>

#include "render/render.h"

namespace skyfit {

class GlContext {
 public:
  GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;
  virtual ~GlContext() = default;

  // Makes the context that of the calling thread, in place of any other, and loads the OpenGL
  // functions from it: there is one set of them in a process, so that two contexts are used in
  // turn, not at once.
  virtual void make_current() = 0;

  // What draws, for users: the renderer, the version of OpenGL and the way to it.
  const std::string& description() const { return description_; }

 protected:
  // Of the current context.
  void describe(const std::string& way);

 private:
  std::string description_;
};

// The context is current when this returns. Throws std::runtime_error, in one line, when there is
// no OpenGL 4.5 core.
std::unique_ptr<GlContext> make_context(GraphicsDevice device);

// Software rendering without display or GPU.
std::unique_ptr<GlContext> make_osmesa_context();

// EGL without display: its devices, GPUs before software, then Mesa's platform without surfaces.
std::unique_ptr<GlContext> make_egl_context();

// Takes the calling thread's context from it, whichever of the two libraries it came from. Both may
// be one Mesa inside, which keeps one current context and does not tell the other library.
void release_current_context();

// Throws std::runtime_error that names `where` and the error when OpenGL has recorded one since the
// last call.
void check_gl(const std::string& where);

}  // namespace skyfit
