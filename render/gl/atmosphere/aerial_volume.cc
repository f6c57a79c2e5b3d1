// SPDX-License-Identifier: Apache-2.0
#include "render/gl/atmosphere/aerial_volume.h"

namespace skyfit {
namespace {

// As in aerial_volume.glsl; the work groups of aerial_volume.comp are 8 x 8.
constexpr int kWidth = 32, kHeight = 32, kDepth = 16;
constexpr int kGroup = 8;

GlTexture new_texture(GLenum target) {
  GLuint id = 0;
  glCreateTextures(target, 1, &id);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTextureParameteri(id, axis, GL_CLAMP_TO_EDGE);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return GlTexture(id);
}

}  // namespace

AerialVolume::AerialVolume(int classes)
    : classes_(classes),
      textures_{new_texture(GL_TEXTURE_3D), new_texture(GL_TEXTURE_3D),
                new_texture(GL_TEXTURE_2D)} {
  glTextureStorage3D(textures_[0].id(), 1, GL_RGBA32F, kWidth, kHeight, kDepth);
  glTextureStorage3D(textures_[1].id(), 1, GL_RGBA32F, kWidth, kHeight, classes * kDepth);
  glTextureStorage2D(textures_[2].id(), 1, GL_RGBA32F, kHeight, kDepth);
}

void AerialVolume::fill(GLuint program) const {
  for (GLuint unit = 0; unit < textures_.size(); ++unit)
    glBindImageTexture(unit, textures_[unit].id(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA32F);
  glUseProgram(program);
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);  // the frame before may still read them
  glDispatchCompute(kWidth / kGroup, kHeight / kGroup, 1);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void AerialVolume::bind(GLuint unit) const {
  for (const GlTexture& texture : textures_) glBindTextureUnit(unit++, texture.id());
}

}  // namespace skyfit
