// SPDX-License-Identifier: Apache-2.0
// OpenGL names that delete themselves. They belong to the context that is current when they are
// made.
#pragma once

#include <glad/gl.h>

#include <utility>

namespace skyfit {

template <class Traits>
class GlObject {
 public:
  GlObject() = default;
  explicit GlObject(GLuint id) : id_(id) {}
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  GlObject(const GlObject&) = delete;
  GlObject& operator=(const GlObject&) = delete;
  ~GlObject() {
    if (id_ != 0) Traits::destroy(id_);
  }
  GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
};

struct ProgramTraits {
  static void destroy(GLuint id) { glDeleteProgram(id); }
};
struct ShaderTraits {
  static void destroy(GLuint id) { glDeleteShader(id); }
};
struct TextureTraits {
  static void destroy(GLuint id) { glDeleteTextures(1, &id); }
};
struct BufferTraits {
  static void destroy(GLuint id) { glDeleteBuffers(1, &id); }
};
struct FramebufferTraits {
  static void destroy(GLuint id) { glDeleteFramebuffers(1, &id); }
};
struct VertexArrayTraits {
  static void destroy(GLuint id) { glDeleteVertexArrays(1, &id); }
};
struct QueryTraits {
  static void destroy(GLuint id) { glDeleteQueries(1, &id); }
};

using GlProgram = GlObject<ProgramTraits>;
using GlShader = GlObject<ShaderTraits>;
using GlTexture = GlObject<TextureTraits>;
using GlBuffer = GlObject<BufferTraits>;
using GlFramebuffer = GlObject<FramebufferTraits>;
using GlQuery = GlObject<QueryTraits>;
using GlVertexArray = GlObject<VertexArrayTraits>;

inline GlVertexArray make_vertex_array() {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  return GlVertexArray(id);
}

}  // namespace skyfit
