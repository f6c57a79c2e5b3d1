// SPDX-License-Identifier: Apache-2.0
#include "render/gl/context/shader.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace skyfit {
namespace {

GlShader compile(const ShaderStage& stage, std::span<const ShaderSource> extra,
                 std::span<const std::string> defined) {
  const ShaderText source(stage.path, ShaderLanguage::kGlsl450, defined, extra);
  GlShader shader(glCreateShader(stage.type));
  const char* pointer = source.text().c_str();
  glShaderSource(shader.id(), 1, &pointer, nullptr);
  glCompileShader(shader.id());
  GLint done = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return shader;
  GLint length = 0;
  glGetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetShaderInfoLog(shader.id(), length, nullptr, log.data());
  throw std::runtime_error(source.translated(log.c_str()));
}

}  // namespace

GlProgram build_program(std::span<const ShaderStage> stages, std::span<const ShaderSource> extra,
                        std::span<const std::string> defined) {
  GlProgram program(glCreateProgram());
  for (const ShaderStage& stage : stages) {
    const GlShader shader = compile(stage, extra, defined);
    glAttachShader(program.id(), shader.id());
  }
  glLinkProgram(program.id());
  GLint done = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &done);
  if (done == GL_TRUE) return program;
  GLint length = 0;
  glGetProgramiv(program.id(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  glGetProgramInfoLog(program.id(), length, nullptr, log.data());
  throw std::runtime_error(fmt::format("{}: cannot link: {}", stages.back().path, log.c_str()));
}

}  // namespace skyfit
