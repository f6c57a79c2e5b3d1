// SPDX-License-Identifier: Apache-2.0
// Shader programs from sources that are part of the library. A source may `#include "path"` another
// one by its path in the repository; each file is read once per program. `model/shared/` formulas
// find Number and OUT defined.
#pragma once

#include <glad/gl.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/gl/context/objects.h"

namespace skyfit {

struct ShaderSource {
  std::string_view path;  // as in #include: "model/shared/phase.glsl"
  std::string_view text;
};

// Every .glsl, .vert, .frag and .comp file of render/shaders/ and model/shared/.
std::span<const ShaderSource> embedded_shaders();

struct ShaderStage {
  GLenum type;  // GL_VERTEX_SHADER ...
  std::string path;
};

// Compiles and links. Throws std::runtime_error `path:line: the driver's message` for the first
// error, or names the missing file. `extra` sources are looked up first; each of `defined`,
// a name or a name and its value, is #defined in every stage.
GlProgram build_program(std::span<const ShaderStage> stages,
                        std::span<const ShaderSource> extra = {},
                        std::span<const std::string> defined = {});

}  // namespace skyfit
