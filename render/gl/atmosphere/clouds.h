// SPDX-License-Identifier: Apache-2.0
// The sheets of clouds of render/shaders/clouds.glsl.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/gl/context/objects.h"
#include "render/gl/context/uniform_block.h"
#include "render/render.h"

namespace skyfit {

// Fractal, repeating, 64 values along each axis, mean 1/2 and deviation 1/6 of 65535; x fastest.
std::vector<std::uint16_t> cloud_noise();

class Clouds {
 public:
  Clouds();

  // The noise as texture `unit`, and what the shader needs of the sheets for an eye at a height
  // within the air, or at its top.
  void bind(std::span<const CloudLayer> sheets, double eye_m, GLuint program, GLuint unit,
            UniformBuffers& buffers) const;

 private:
  GlTexture noise_;
};

}  // namespace skyfit
