// SPDX-License-Identifier: Apache-2.0
// The atmosphere over the G-buffer. Reads the tables and the G-buffer in the order of
// kAtmosphereReads; writes light (linear sRGB and luminance, cd/m^2), the distance from the camera
// (km, infinite for sky) and, when asked, the layers in the order of kLayerWrites. Where there is a
// surface and where there is sky are drawn apart, each by a shader that does no more than it must:
// the depth test tells them apart. Before it, the light of whole rays from the eye is looked up once
// for all pixels, into the targets kSkyViewWrites.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/gl/objects.h"
#include "render/gl/passes.h"
#include "render/gl/projection.h"
#include "render/gl/site_axes.h"

namespace skyfit {

// The texture units of render/shaders/atmosphere.glsl, of atmosphere.frag and of sky_view.glsl.
inline const std::vector<std::string> kTableReads = {"optical_depth", "irradiance",
                                                     "rayleigh_like", "single_mie", "phase"};
inline const std::vector<std::string> kAtmosphereReads = {
    "optical_depth", "irradiance", "rayleigh_like",      "single_mie",
    "phase",         "color",      "normal_reflectance", "depth_copy",
    "view_air",      "view_aerosol", "view_depth"};

inline const std::vector<std::string> kLayerWrites = {"in_scatter", "reflected", "transmittance",
                                                      "albedo"};

// Makes the textures of the tables, named as in kAtmosphereReads.
void add_tables(const AtmosphereTables& tables, FrameGraph& graph);

inline const std::vector<std::string> kSkyViewWrites = {"view_air", "view_aerosol", "view_depth"};

// What render/shaders/atmosphere.glsl needs to know of the tables.
std::vector<std::string> atmosphere_defines(const AtmosphereTables& tables);
GlBuffer atmosphere_block(const AtmosphereTables& tables, GLuint program);

class AtmospherePass {
 public:
  AtmospherePass();

  // The tables' values are read from the textures; the rest is kept.
  void set_tables(const AtmosphereTables& tables);

  void add_sky_view(const FrameOptions& options, FrameGraph& graph) const;
  void draw_sky_view(const Projection& projection, const SiteAxes& axes,
                     const FrameOptions& options);

  // After draw_sky_view() of the same view. Compiles the variants that the options need, when they
  // are new. The depth target holds the G-buffer's depth.
  void draw(const FrameOptions& options);

 private:
  using Defined = std::vector<std::string>;
  GLuint program(const std::string& fragment, const Defined& defined);
  GLuint variant(bool surface, const FrameOptions& options);
  Defined defined_by(const FrameOptions& options) const;
  glm::ivec3 sky_view_size() const;  // columns of a sun, rows to the ground, rows to the sky
  void bind_blocks(GLuint program, const Projection& projection, const SiteAxes& axes,
                   const FrameOptions& options);
  void draw_triangle(GLuint program) const;

  AtmosphereTables tables_;  // without the tables' values
  std::map<std::pair<std::string, Defined>, GlProgram> programs_;
  GlVertexArray empty_;
  std::vector<GlBuffer> blocks_;  // of the frame
};

}  // namespace skyfit
