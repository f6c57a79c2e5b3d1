// SPDX-License-Identifier: Apache-2.0
// Arrays in the device's memory.
#pragma once

#include <glad/gl.h>

#include <span>

#include "render/gl/context/objects.h"

namespace skyfit {

// Not changed afterwards. An empty array becomes a buffer of one byte, which nobody reads.
template <class T>
GlBuffer upload(std::span<const T> data) {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  GlBuffer buffer(id);
  if (data.empty()) {
    glNamedBufferStorage(id, 1, nullptr, 0);
  } else {
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(data.size_bytes()), data.data(), 0);
  }
  return buffer;
}

// Replaces what the buffer holds: for what changes from frame to frame.
template <class T>
void refill(GlBuffer& buffer, std::span<const T> data) {
  if (buffer.id() == 0) {
    GLuint id = 0;
    glCreateBuffers(1, &id);
    buffer = GlBuffer(id);
  }
  glNamedBufferData(buffer.id(), static_cast<GLsizeiptr>(data.size_bytes()), data.data(),
                    GL_STREAM_DRAW);
}

}  // namespace skyfit
