// SPDX-License-Identifier: Apache-2.0
// The atmosphere over the G-buffer. Reads the tables and the G-buffer in the order of
// kAtmosphereReads; writes light (in the frame's primaries and luminance, cd/m^2), the distance
// from the camera (km, infinite for sky) and, when asked, the layers in the order of kLayerWrites.
// The sky, the suns' discs, surfaces and those near enough to show their grains are drawn apart,
// each by a shader that does no more than it must. As fragments, of which a renderer in software
// skips those that fail the depth test, or as compute shaders, which have all of a GPU to
// themselves: fragments are shaded by a part of it on cards made for computing. Before it, the
// light of whole rays from the eye is looked up once for all pixels, into the targets
// kSkyViewWrites.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/atmosphere/refraction.h"
#include "render/features/render_features.h"
#include "render/gl/atmosphere/aerial_volume.h"
#include "render/gl/atmosphere/atmosphere_tables.h"
#include "render/gl/atmosphere/clouds.h"
#include "render/gl/context/objects.h"
#include "render/gl/context/uniform_block.h"
#include "render/gl/passes/passes.h"
#include "render/gl/passes/projection.h"
#include "render/gl/passes/shadow_pass.h"
#include "render/gl/passes/site_axes.h"
#include "render/gl/terrain/materials.h"
#include "render/gl/terrain/own_textures.h"

namespace skyfit {

// The texture units of render/shaders/atmosphere.glsl, sky_rays.glsl, pixel_light.glsl and
// sky_view.glsl.
inline const std::vector<std::string> kTableReads = {
    "optical_depth", "irradiance",  "rayleigh_like",  "single",
    "phase",         "sky_ray_air", "sky_ray_aerosol"};
inline const std::vector<std::string> kAtmosphereReads = {
    "optical_depth",   "irradiance", "rayleigh_like", "single",   "phase",        "sky_ray_air",
    "sky_ray_aerosol", "gbuffer",    "depth",         "view_air", "view_aerosol", "view_depth"};

// Of the suns' discs alone: light in the frame's primaries, cd/m^2, and the share of the sample
// that they cover.
inline const std::string kDiscWrite = "disc";

inline const std::vector<std::string> kLayerWrites = {"in_scatter", "reflected", "transmittance",
                                                      "albedo", "normal"};

inline const std::vector<std::string> kSkyViewWrites = {"view_air", "view_aerosol", "view_depth"};

// A frame as the atmosphere's passes see it.
struct AtmosphereView {
  const FrameOptions& options;
  const Projection& projection;
  const SiteAxes& axes;
  std::span<const ShadowView> shadows;
  double farthest_km;  // of the ground that is seen: the length of the volume
  bool only_ground;    // is seen: no meshes, no moon
  double nearest_m;    // of the ground that is seen, or less
  double highest_m;    // of all ground
  const Materials& materials;
  const OwnTextures& own_textures;
  bool read;  // the frame will be: the last colour target is kDiscWrite

  // The volume holds one sun's light before the ground, for an eye in the lower air, without
  // layers, at whose edges it would mix light; VOLUME promises the shaders that both are in the
  // air.
  bool volume(const AtmosphereTables& tables) const;
  // Whole rays to the sky have tables of their own, or sums in the shader in their place.
  bool sky_rays(const AtmosphereTables& tables) const;
  bool sees_grains() const;  // of the ground, in some pixel
};

class AtmospherePass {
 public:
  explicit AtmospherePass(GraphicsDevice device);

  // The tables' values are read from the textures; the rest is kept.
  void set_tables(const AtmosphereTables& tables, const TableCodes& codes);
  const AtmosphereTables& tables() const { return tables_; }  // without values

  // Projection::eye_in_air.
  glm::vec4 eye_in_air(const FrameOptions& options);

  // Whether whole rays are looked up once a frame: not from high above the air; by Hillaire's
  // method from everywhere in it; not by closed forms, and not where light before surfaces is
  // summed along the path.
  bool has_sky_view(const FrameOptions& options) const;
  void add_sky_view(const FrameOptions& options, FrameGraph& graph) const;
  void draw_sky_view(const AtmosphereView& view);
  void fill_volume(const AtmosphereView& view);

  // Either of two ways comes after the passes above of the same view, as far as it has them, and
  // compiles the variants that the options need, when they are new.
  // As fragments. Where grains are seen, the pixels are first sorted by the G-buffer's depth, which
  // their classes replace; it is the depth target of both.
  void classify(const AtmosphereView& view);
  void draw(const AtmosphereView& view, const ShadowPass& shadow_maps);
  // As compute shaders into images, but for the suns, whose depth target is the G-buffer's.
  void dispatch(const AtmosphereView& view, const ShadowPass& shadow_maps);
  void draw_only_suns(const AtmosphereView& view);

 private:
  using Defined = std::vector<std::string>;
  GLuint program(const std::string& path, const Defined& defined);
  Defined defined_by(const FeatureShader& shader) const;
  const Refraction& refraction();
  GLuint variant(const std::string& path, const Defined& what, const AtmosphereView& view);
  void bind_blocks(GLuint program, const AtmosphereView& view);
  // What both ways read; `sky` and `grainy` are programs of theirs that have all the uniform
  // blocks.
  void bind(const AtmosphereView& view, const ShadowPass& shadow_maps, GLuint sky, GLuint grainy);
  void draw_triangle(GLuint program) const;
  void draw_suns(const AtmosphereView& view);
  void clear_disc(const AtmosphereView& view) const;

  GraphicsDevice device_;
  AtmosphereTables tables_;  // without the tables' values
  TableCodes codes_;
  std::map<std::pair<std::string, Defined>, GlProgram> programs_;
  GlVertexArray empty_;
  GlTexture scattering_coefficients_;   // over height
  std::optional<GlTexture> gathered_;   // of kBodare
  std::optional<AerialVolume> volume_;  // made when first used
  std::optional<Clouds> clouds_;
  std::optional<Refraction> refraction_;  // of the tables' atmosphere, made when first used
  UniformBuffers blocks_;
};

}  // namespace skyfit
