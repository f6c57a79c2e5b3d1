// SPDX-License-Identifier: Apache-2.0
// A std140 uniform block, filled by its members' names: the places are the driver's, so nothing has
// to agree with a struct. Throws std::runtime_error when the program has no such block or member: a
// renamed one is noticed.
#pragma once

#include <cstring>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/gl/context/buffers.h"

namespace skyfit {

// Of the blocks that are bound, by their bindings: they stay from frame to frame.
struct UniformBuffer {
  GlBuffer buffer;
  std::vector<std::byte> held;
};
using UniformBuffers = std::map<GLint, UniformBuffer>;

class UniformBlock {
 public:
  UniformBlock(GLuint program, const std::string& block) : program_(program) {
    const GLuint index = glGetUniformBlockIndex(program, block.c_str());
    if (index == GL_INVALID_INDEX) throw std::runtime_error("render: no uniform block " + block);
    GLint size = 0;
    glGetActiveUniformBlockiv(program, index, GL_UNIFORM_BLOCK_DATA_SIZE, &size);
    glGetActiveUniformBlockiv(program, index, GL_UNIFORM_BLOCK_BINDING, &binding_);
    bytes_.resize(static_cast<std::size_t>(size));
  }

  void set(const char* name, float value) { put(name, &value, sizeof value); }
  void set(const char* name, double value) { set(name, static_cast<float>(value)); }
  void set(const char* name, const glm::vec2& value) { put(name, &value, sizeof value); }
  void set(const char* name, const glm::vec3& value) { put(name, &value, sizeof value); }
  void set(const char* name, const glm::vec4& value) { put(name, &value, sizeof value); }
  void set(const char* name, const glm::mat4& value) { put(name, &value, sizeof value); }
  // Columns of matrices begin at multiples of 16 bytes.
  void set(const char* name, const glm::mat3& value) {
    const glm::mat3x4 columns(value);
    put(name, &columns, sizeof columns);
  }
  void set(const char* name, const glm::mat4x3& value) {
    const glm::mat4x4 columns(value);
    put(name, &columns, sizeof columns);
  }
  void set(const char* name, std::span<const glm::vec4> values) {
    put(name, values.data(), values.size_bytes());
  }
  void set(const char* name, std::span<const glm::mat4> values) {
    put(name, values.data(), values.size_bytes());
  }

  // Makes it the one that programs read at the block's binding.
  void bind(UniformBuffers& buffers) const {
    auto& [buffer, held] = buffers[binding_];
    if (held != bytes_) {
      refill(buffer, std::span<const std::byte>(bytes_));
      held = bytes_;
    }
    glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(binding_), buffer.id());
  }

 private:
  void put(const char* name, const void* value, std::size_t size) {
    GLuint index = GL_INVALID_INDEX;
    glGetUniformIndices(program_, 1, &name, &index);
    GLint offset = -1;
    if (index != GL_INVALID_INDEX)
      glGetActiveUniformsiv(program_, 1, &index, GL_UNIFORM_OFFSET, &offset);
    if (offset < 0 || static_cast<std::size_t>(offset) + size > bytes_.size())
      throw std::runtime_error(std::string("render: no member of a uniform block ") + name);
    std::memcpy(bytes_.data() + offset, value, size);
  }

  GLuint program_;
  GLint binding_ = 0;
  std::vector<std::byte> bytes_;
};

}  // namespace skyfit
