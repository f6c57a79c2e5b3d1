// SPDX-License-Identifier: Apache-2.0
// A frame is a list of passes over named textures. The list is the renderer's documentation: what a
// pass reads is bound to texture units 0, 1, ... in the order of `reads`; what it writes are the
// colour targets 0, 1, ... in the order of `writes`, a depth texture is the depth target; what its
// compute shaders write are the image units 0, 1, ... in the order of `images`.
//
// Each pass begins with the same state, whatever ran before it: clip control from 0 to 1, no depth
// test, depth function GL_LESS, depth range 0 to 1, all masks open, no culling, blending, scissors
// or depth clamp. It sets what it needs otherwise, with a viewport of its own where it writes no
// target, and restores nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "render/gl/context/objects.h"
#include "render/render.h"

namespace skyfit {

struct Pass {
  std::string name;
  std::vector<std::string> reads, writes;
  std::function<void()> draw;
  std::vector<std::string> images = {};
};

// Passes that the device may not have run yet.
struct StartedPasses {
  std::vector<std::string> names;
  std::vector<GlQuery> stamps;  // the device's clock before the first pass and after each

  // Wait for the device. The time that each took; its clock at the end.
  std::vector<PassTime> times() const;
  std::int64_t end_ns() const;
};

class FrameGraph {
 public:
  // Textures by name; float formats filter linearly and clamp to their edges. A target of the same
  // format and size stays as it is.
  void add_target(const std::string& name, GLenum format, int width, int height);
  // `texels`: RGBA of GL_RGBA32F, GL_RGBA16F or GL_RGBA8.
  void add_table(const std::string& name, int width, int height, int depth, GLenum format,
                 const void* texels);

  // Hands the passes to the device, which runs them in order. Throws std::runtime_error that names
  // the pass: an unknown texture, an incomplete framebuffer, an OpenGL error.
  StartedPasses run(std::span<const Pass> passes) const;

  void bind(const std::string& name, GLuint unit) const;

  // `channels` floats per pixel of some rows of a target, the lowest being `first`; from the bottom
  // to the top.
  std::vector<float> read_rows(const std::string& name, GLenum format, int channels, int first,
                               int rows) const;
  // Of a target of whole numbers, four words per pixel.
  std::vector<std::uint32_t> read_back_words(const std::string& name) const;

 private:
  struct Texture {
    GlTexture object;
    GLenum format;
    int width, height;
  };
  const Texture& texture(const std::string& name) const;
  GlFramebuffer framebuffer(const Pass& pass) const;
  template <class T>
  std::vector<T> read(const std::string& name, GLenum format, GLenum type, int channels, int first,
                      int rows) const;
  void bind_image(const std::string& name, GLuint unit) const;

  std::map<std::string, Texture> textures_;
};

}  // namespace skyfit
