// SPDX-License-Identifier: Apache-2.0
// Shader programs from sources that are part of the library, see render/glsl/shader_text.h.
#pragma once

#include <glad/gl.h>

#include <span>
#include <string>

#include "render/gl/context/objects.h"
#include "render/glsl/shader_text.h"

namespace skyfit {

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
