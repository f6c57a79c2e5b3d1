// SPDX-License-Identifier: Apache-2.0
// The atmosphere over the G-buffer. Reads the tables and the G-buffer in the order of
// kAtmosphereReads; writes light (linear sRGB and luminance, cd/m^2) and the distance from the
// camera (km, infinite for sky).
#pragma once

#include <string>
#include <vector>

#include "render/gl/objects.h"
#include "render/gl/passes.h"
#include "render/gl/projection.h"

namespace skyfit {

// The texture units of render/shaders/atmosphere.glsl and atmosphere.frag.
inline const std::vector<std::string> kAtmosphereReads = {
    "optical_depth", "irradiance", "rayleigh_like",      "single_mie",
    "phase",         "color",      "normal_reflectance", "depth"};

// Makes the textures of the tables, named as in kAtmosphereReads.
void add_tables(const AtmosphereTables& tables, FrameGraph& graph);

// What render/shaders/atmosphere.glsl needs to know of the tables.
void set_atmosphere(const AtmosphereTables& tables, GLuint program);

class AtmospherePass {
 public:
  explicit AtmospherePass(const AtmosphereTables& tables);
  void draw(const Projection& projection, const FrameOptions& options) const;

 private:
  GlProgram program_;
  GlVertexArray empty_;
};

}  // namespace skyfit
