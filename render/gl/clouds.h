// SPDX-License-Identifier: Apache-2.0
// The sheet of clouds of render/shaders/clouds.glsl.
#pragma once

#include "render/gl/objects.h"
#include "render/render.h"

namespace skyfit {

class Clouds {
 public:
  Clouds();

  // The noise as texture `unit`, and what the shader needs, which is bound while the buffer lives.
  GlBuffer bind(const CloudLayer& clouds, GLuint program, GLuint unit) const;

 private:
  GlTexture noise_;
};

}  // namespace skyfit
