// SPDX-License-Identifier: Apache-2.0
// Uniforms by name. Throws std::runtime_error when the program has no such uniform: a renamed one
// is noticed.
#pragma once

#include <glad/gl.h>

#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <stdexcept>
#include <string>

namespace skyfit {

class Uniforms {
 public:
  explicit Uniforms(GLuint program) : program_(program) {}

  void set(const char* name, int value) const { glProgramUniform1i(program_, at(name), value); }
  void set(const char* name, float value) const { glProgramUniform1f(program_, at(name), value); }
  void set(const char* name, double value) const { set(name, static_cast<float>(value)); }
  void set(const char* name, const glm::vec2& value) const {
    glProgramUniform2fv(program_, at(name), 1, glm::value_ptr(value));
  }
  void set(const char* name, const glm::vec3& value) const {
    glProgramUniform3fv(program_, at(name), 1, glm::value_ptr(value));
  }
  void set(const char* name, const glm::vec4& value) const {
    glProgramUniform4fv(program_, at(name), 1, glm::value_ptr(value));
  }
  void set(const char* name, std::span<const glm::vec4> values) const {
    glProgramUniform4fv(program_, at(name), static_cast<GLsizei>(values.size()),
                        glm::value_ptr(values.front()));
  }
  void set(const char* name, std::span<const glm::mat4> values) const {
    glProgramUniformMatrix4fv(program_, at(name), static_cast<GLsizei>(values.size()), GL_FALSE,
                              glm::value_ptr(values.front()));
  }
  void set(const char* name, const glm::mat3& value) const {
    glProgramUniformMatrix3fv(program_, at(name), 1, GL_FALSE, glm::value_ptr(value));
  }
  void set(const char* name, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(program_, at(name), 1, GL_FALSE, glm::value_ptr(value));
  }
  void set(const char* name, const glm::mat4x3& value) const {
    glProgramUniformMatrix4x3fv(program_, at(name), 1, GL_FALSE, glm::value_ptr(value));
  }

 private:
  GLint at(const char* name) const {
    const GLint location = glGetUniformLocation(program_, name);
    if (location < 0) throw std::runtime_error(std::string("render: no uniform ") + name);
    return location;
  }
  GLuint program_;
};

}  // namespace skyfit
