// SPDX-License-Identifier: Apache-2.0
// What the render tests share: a context, small tables, and shared GLSL functions run on the GPU.
#pragma once

#include <glad/gl.h>

#include <memory>
#include <string>
#include <vector>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/preset.h"
#include "model/tables/tables.h"
#include "render/gl/context/context.h"
#include "render/gl/context/shader.h"
#include "render/gl/passes/passes.h"

namespace skyfit {

inline Preset shipped(const std::string& name) {
  return parse_preset(refs::shipped_preset_json(name), name);
}

inline constexpr TableSizes kSmallTables = {256, 128, 16, 8, 16, 16, 24, 16, 8, 24, 16, 8};

inline AtmosphereTables tables_of(const Preset& preset, const TableSizes& sizes) {
  return compute_tables(preset.atmosphere, color_rule(refs::standard_spectral_data()), sizes, 2,
                        {});
}

// Runs a compute program once per vec4 of the inputs and returns its outputs; `bindings` are those
// of both as storage buffers.
inline std::vector<float> run_compute(const GlProgram& program, const std::vector<float>& inputs,
                                      std::pair<GLuint, GLuint> bindings) {
  const auto bytes = static_cast<GLsizeiptr>(inputs.size() * sizeof(float));
  GLuint names[2];
  glCreateBuffers(2, names);
  const GlBuffer in(names[0]), out(names[1]);
  glNamedBufferStorage(in.id(), bytes, inputs.data(), 0);
  glNamedBufferStorage(out.id(), bytes, nullptr, 0);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, bindings.first, in.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, bindings.second, out.id());
  glUseProgram(program.id());
  glDispatchCompute(static_cast<GLuint>(inputs.size() / 4), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<float> outputs(inputs.size());
  glGetNamedBufferSubData(out.id(), 0, bytes, outputs.data());
  check_gl("a compute program");
  return outputs;
}

// Runs `body` (statements that turn vec4 x into vec4 y) once per input on the GPU. `prepare` sets
// uniforms, blocks and textures; `defined` as in build_program().
template <class Prepare>
std::vector<float> run_glsl(const std::string& includes, const std::string& body,
                            const std::vector<float>& inputs,
                            const std::vector<std::string>& defined, Prepare&& prepare) {
  const std::string text =
      includes +
      "layout(local_size_x = 1) in;\n"
      "layout(std430, binding = 0) readonly buffer In { vec4 inputs[]; };\n"
      "layout(std430, binding = 1) writeonly buffer Out { vec4 outputs[]; };\n"
      "void main() {\n  vec4 x = inputs[gl_GlobalInvocationID.x];\n  vec4 y = vec4(0.0);\n" +
      body + "\n  outputs[gl_GlobalInvocationID.x] = y;\n}\n";
  const ShaderSource source{"test.comp", text};
  const GlProgram program = build_program(
      std::vector<ShaderStage>{{GL_COMPUTE_SHADER, "test.comp"}}, std::span(&source, 1), defined);
  prepare(program.id());
  return run_compute(program, inputs, {0, 1});
}

inline std::vector<float> run_glsl(const std::string& includes, const std::string& body,
                                   const std::vector<float>& inputs) {
  return run_glsl(includes, body, inputs, {}, [](GLuint) {});
}

}  // namespace skyfit
