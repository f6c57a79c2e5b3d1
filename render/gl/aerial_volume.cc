// SPDX-License-Identifier: Apache-2.0
#include "render/gl/aerial_volume.h"

namespace skyfit {
namespace {

// As in aerial_volume.glsl; its work groups are 8 x 8 x 1.
constexpr int kWidth = 32, kHeight = 32, kDepth = 16;
constexpr int kGroup = 8;

}  // namespace

AerialVolume::AerialVolume() {
  for (GlTexture& volume : volumes_) {
    GLuint id = 0;
    glCreateTextures(GL_TEXTURE_3D, 1, &id);
    volume = GlTexture(id);
    glTextureStorage3D(id, 1, GL_RGBA32F, kWidth, kHeight, kDepth);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
      glTextureParameteri(id, axis, GL_CLAMP_TO_EDGE);
    glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  }
}

void AerialVolume::fill(GLuint program) const {
  for (GLuint unit = 0; unit < volumes_.size(); ++unit)
    glBindImageTexture(unit, volumes_[unit].id(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  glUseProgram(program);
  glDispatchCompute(kWidth / kGroup, kHeight / kGroup, kDepth);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void AerialVolume::bind(GLuint unit) const {
  for (const GlTexture& volume : volumes_) glBindTextureUnit(unit++, volume.id());
}

}  // namespace skyfit
