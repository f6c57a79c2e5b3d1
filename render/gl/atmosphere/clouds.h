// SPDX-License-Identifier: Apache-2.0
// The sheet of clouds of render/shaders/clouds.glsl.
#pragma once

#include "render/gl/context/objects.h"
#include "render/gl/context/uniform_block.h"
#include "render/render.h"

namespace skyfit {

class Clouds {
 public:
  Clouds();

  // The noise as texture `unit`, and what the shader needs.
  void bind(const CloudLayer& clouds, GLuint program, GLuint unit, UniformBuffers& buffers) const;

 private:
  GlTexture noise_;
};

}  // namespace skyfit
