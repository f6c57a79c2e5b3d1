// SPDX-License-Identifier: Apache-2.0
// A user's own pictures of the ground's materials, see render/shaders/own_materials.glsl.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "render/gl/context/objects.h"
#include "render/gl/context/uniform_block.h"
#include "render/gl/terrain/color_reflectance.h"
#include "render/render.h"

namespace skyfit {

inline constexpr int kSmallestOwnSide = 4, kLargestOwnSide = 4096;  // texels

// Row by row from the top, at a side of `side`.
struct OwnPicture {
  int side = 0;
  std::vector<float> texels;
};

// Reflectances at the four nodes of the colour rule, 4 values a texel, of sRGB colours. Throws
// std::runtime_error in one line that names the file, what was found and what was expected.
OwnPicture read_own_color(const std::filesystem::path& file, const ColorReflectance& colors);

// The slopes of a relief to the east and to the north, 2 values a texel, whose normals the picture
// has; 127.5 or 128 of 255 is level. Throws as above, and where a normal does not point out of the
// surface.
OwnPicture read_own_slopes(const std::filesystem::path& file);

class OwnTextures {
 public:
  // Throws as the two above, with the material and its field, such as soil.color, at the end.
  OwnTextures(const OwnMaterial& soil, const OwnMaterial& rock, const ColorReflectance& colors);

  // For shaders of surfaces; none where all materials are the program's own.
  const std::vector<std::string>& defines() const { return defines_; }

  // As four textures from `unit` on, and what the shader needs. `camera`: planet coordinates, m.
  void bind(const glm::dvec3& camera, GLuint program, GLuint unit, UniformBuffers& buffers) const;

 private:
  OwnMaterial soil_, rock_;
  std::vector<std::string> defines_;
  std::vector<GlTexture> textures_;  // colour and slopes of the soil, then of the rock
  std::vector<glm::vec4> means_;     // of each
};

}  // namespace skyfit
