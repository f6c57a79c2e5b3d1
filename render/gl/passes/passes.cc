// SPDX-License-Identifier: Apache-2.0
#include "render/gl/passes/passes.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "render/gl/context/context.h"

namespace skyfit {
namespace {

// `filter`: whole numbers have none but the nearest.
GlTexture make_texture(GLenum target, GLint filter = GL_LINEAR) {
  GLuint id = 0;
  glCreateTextures(target, 1, &id);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    glTextureParameteri(id, axis, GL_CLAMP_TO_EDGE);
  }
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, filter);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, filter);
  return GlTexture(id);
}

// No pass sees what another left behind, nor what a new context begins with.
void set_default_state() {
  // Depths in 0..1, for reversed depth, too; OpenGL's own -1..1 would halve their range.
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  for (const GLenum feature :
       {GL_DEPTH_TEST, GL_DEPTH_CLAMP, GL_CULL_FACE, GL_BLEND, GL_SCISSOR_TEST}) {
    glDisable(feature);
  }
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glDepthRange(0, 1);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

std::int64_t nanoseconds(const GlQuery& stamp) {
  GLint64 value = 0;
  glGetQueryObjecti64v(stamp.id(), GL_QUERY_RESULT, &value);
  return value;
}

}  // namespace

std::vector<PassTime> StartedPasses::times() const {
  std::vector<PassTime> made;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::int64_t took = nanoseconds(stamps[i + 1]) - nanoseconds(stamps[i]);
    made.push_back({names[i], 1e-6 * static_cast<double>(took)});
  }
  return made;
}

std::int64_t StartedPasses::end_ns() const { return nanoseconds(stamps.back()); }

void FrameGraph::add_target(const std::string& name, GLenum format, int width, int height) {
  const auto found = textures_.find(name);
  if (found != textures_.end() && found->second.format == format && found->second.width == width &&
      found->second.height == height) {
    return;
  }
  const GLint filter = format == GL_RGBA32UI ? GL_NEAREST : GL_LINEAR;
  Texture texture{make_texture(GL_TEXTURE_2D, filter), format, width, height};
  glTextureStorage2D(texture.object.id(), 1, format, width, height);
  check_gl("texture " + name);
  textures_.insert_or_assign(name, std::move(texture));
}

void FrameGraph::add_table(const std::string& name, int width, int height, int depth, GLenum format,
                           const void* texels) {
  const bool flat = depth <= 1;
  Texture texture{make_texture(flat ? GL_TEXTURE_2D : GL_TEXTURE_3D), format, width, height};
  const GLuint id = texture.object.id();
  const GLenum type = format == GL_RGBA8     ? GL_UNSIGNED_BYTE
                      : format == GL_RGBA16F ? GL_HALF_FLOAT
                                             : GL_FLOAT;
  if (flat) {
    glTextureStorage2D(id, 1, format, width, height);
    glTextureSubImage2D(id, 0, 0, 0, width, height, GL_RGBA, type, texels);
  } else {
    glTextureStorage3D(id, 1, format, width, height, depth);
    glTextureSubImage3D(id, 0, 0, 0, 0, width, height, depth, GL_RGBA, type, texels);
  }
  check_gl("table " + name);
  textures_.insert_or_assign(name, std::move(texture));
}

const FrameGraph::Texture& FrameGraph::texture(const std::string& name) const {
  const auto found = textures_.find(name);
  if (found == textures_.end())
    throw std::runtime_error(fmt::format("render: no texture \"{}\"", name));
  return found->second;
}

GlFramebuffer FrameGraph::framebuffer(const Pass& pass) const {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  GlFramebuffer made(id);
  std::vector<GLenum> colors;
  for (const std::string& name : pass.writes) {
    const Texture& target = texture(name);
    const bool depth = target.format == GL_DEPTH_COMPONENT32F;
    const GLenum slot =
        depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(colors.size());
    glNamedFramebufferTexture(id, slot, target.object.id(), 0);
    if (!depth) colors.push_back(slot);
    glViewport(0, 0, target.width, target.height);
  }
  glNamedFramebufferDrawBuffers(id, static_cast<GLsizei>(colors.size()), colors.data());
  if (glCheckNamedFramebufferStatus(id, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error(
        fmt::format("render: pass \"{}\" has no complete framebuffer", pass.name));
  }
  return made;
}

StartedPasses FrameGraph::run(std::span<const Pass> passes) const {
  StartedPasses started;
  const auto stamp = [&] {
    GLuint query = 0;
    glCreateQueries(GL_TIMESTAMP, 1, &query);
    started.stamps.emplace_back(query);
    glQueryCounter(query, GL_TIMESTAMP);
  };
  stamp();
  for (const Pass& pass : passes) {
    set_default_state();
    const GlFramebuffer target = pass.writes.empty() ? GlFramebuffer() : framebuffer(pass);
    glBindFramebuffer(GL_FRAMEBUFFER, target.id());
    for (std::size_t unit = 0; unit < pass.reads.size(); ++unit) {
      bind(pass.reads[unit], static_cast<GLuint>(unit));
    }
    for (std::size_t unit = 0; unit < pass.images.size(); ++unit) {
      bind_image(pass.images[unit], static_cast<GLuint>(unit));
    }
    // The frame before may still use what this one writes.
    if (!pass.images.empty()) glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    pass.draw();
    if (!pass.images.empty()) {
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                      GL_FRAMEBUFFER_BARRIER_BIT);
    }
    check_gl("pass " + pass.name);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    started.names.push_back(pass.name);
    stamp();
  }
  return started;
}

void FrameGraph::bind(const std::string& name, GLuint unit) const {
  glBindTextureUnit(unit, texture(name).object.id());
}

void FrameGraph::bind_image(const std::string& name, GLuint unit) const {
  const Texture& target = texture(name);
  glBindImageTexture(unit, target.object.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, target.format);
}

template <class T>
std::vector<T> FrameGraph::read(const std::string& name, GLenum format, GLenum type, int channels,
                                int first, int rows) const {
  const Texture& source = texture(name);
  std::vector<T> pixels(static_cast<std::size_t>(source.width) * rows * channels);
  const std::size_t bytes = pixels.size() * sizeof(T);
  if (bytes > static_cast<std::size_t>(std::numeric_limits<GLsizei>::max())) {
    throw std::runtime_error(fmt::format("render: texture \"{}\" is too large to read back", name));
  }
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glGetTextureSubImage(source.object.id(), 0, 0, first, 0, source.width, rows, 1, format, type,
                       static_cast<GLsizei>(bytes), pixels.data());
  check_gl("reading back " + name);
  return pixels;
}

std::vector<float> FrameGraph::read_rows(const std::string& name, GLenum format, int channels,
                                         int first, int rows) const {
  return read<float>(name, format, GL_FLOAT, channels, first, rows);
}

std::vector<std::uint32_t> FrameGraph::read_back_words(const std::string& name) const {
  return read<std::uint32_t>(name, GL_RGBA_INTEGER, GL_UNSIGNED_INT, 4, 0, texture(name).height);
}

}  // namespace skyfit
