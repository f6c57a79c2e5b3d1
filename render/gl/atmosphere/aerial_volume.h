// SPDX-License-Identifier: Apache-2.0
// The volume over the view frustum of render/shaders/aerial_volume.glsl.
#pragma once

#include <array>

#include "render/gl/context/objects.h"

namespace skyfit {

class AerialVolume {
 public:
  // `classes` of phase functions but the Rayleigh-like one.
  explicit AerialVolume(int classes);

  int classes() const { return classes_; }

  // Runs the program of aerial_volume.comp, whose blocks and tables are bound.
  void fill(GLuint program) const;

  // As three textures from `unit` on.
  void bind(GLuint unit) const;

 private:
  int classes_;
  std::array<GlTexture, 3> textures_;  // two of scattering, one of extinction
};

}  // namespace skyfit
