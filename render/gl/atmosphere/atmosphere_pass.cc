// SPDX-License-Identifier: Apache-2.0
#include "render/gl/atmosphere/atmosphere_pass.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <iterator>

#include "model/shared/sea.h"
#include "render/gl/atmosphere/disc_bending.h"
#include "render/gl/context/shader.h"
#include "render/gl/context/uniform_block.h"
#include "render/gl/context/uniforms.h"
#include "render/gl/passes/frame_setup.h"
#include "render/glsl/light_matrices.h"
#include "render/scene/second_light.h"

namespace skyfit {
namespace {

Table without_values(const Table& table) { return {table.width, table.height, table.depth, {}}; }

// Above it each pixel looks up its own ray: the sun's height at the far end changes too fast with
// the azimuth for pictures of all directions.
constexpr double kAbove = 20e3;  // m
// Above it the volume is more than 3 % off.
constexpr double kVolumeAbove = 12e3;  // m

const std::string kSkyView = "render/shaders/sky_view.frag",
                  kFillVolume = "render/shaders/aerial_volume.comp",
                  kClasses = "render/shaders/pixel_class.frag",
                  kFragments = "render/shaders/atmosphere.frag",
                  kCompute = "render/shaders/atmosphere.comp";

// What the last two may be for besides the sky.
const std::string kDisc = "DISC", kSurface = "SURFACE", kGrains = "GRAINS";

// Depths that stand for the classes of pixels; exact in single precision.
constexpr double kSkyClass = 0, kGrainlessClass = 0.5, kGrainyClass = 1;

constexpr int kGroup = 8;  // of atmosphere.comp, on a side

// After those of kAtmosphereReads.
constexpr GLuint kShadowUnit = 12, kScatteringUnit = 13, kCloudUnit = 14, kVolumeUnit = 15,
                 kMaterialUnit = 18, kOwnMaterialUnit = 20;
// Of kBodare while there is no volume to be read.
constexpr GLuint kGatheredUnit = kVolumeUnit;

std::vector<std::string> class_defines() {
  return {fmt::format("SKY_CLASS {:.1f}", kSkyClass),
          fmt::format("GRAINLESS_CLASS {:.1f}", kGrainlessClass),
          fmt::format("GRAINY_CLASS {:.1f}", kGrainyClass)};
}

double pixel_rad(const FrameOptions& options) {
  return options.camera.vertical_fov / (options.height * options.samples_per_side);
}

double grainless_m(const AtmosphereView& view) {
  return Materials::grainless_distance_m(pixel_rad(view.options));
}

double grainless_depth(const AtmosphereView& view) {
  return view.projection.near_km / (1e-3 * grainless_m(view));
}

// Behind light, distance and the layers.
GLuint disc_location(const FrameOptions& options) {
  return 2 + (options.layers ? static_cast<GLuint>(kLayerWrites.size()) : 0);
}

double thickness_m(const AtmosphereTables& tables) {
  return tables.atmosphere.top_radius_m - tables.atmosphere.bottom_radius_m;
}

std::vector<ShaderStage> stages_of(const std::string& path,
                                   const std::vector<std::string>& defined) {
  if (path == kFillVolume || path == kCompute) return {{GL_COMPUTE_SHADER, path}};
  const bool disc = std::ranges::find(defined, kDisc) != defined.end();
  const char* const vertex = path == kClasses     ? "render/shaders/pixel_class.vert"
                             : path != kFragments ? "render/shaders/fullscreen.vert"
                             : disc               ? "render/shaders/sun.vert"
                                                  : "render/shaders/atmosphere.vert";
  return {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, path}};
}

}  // namespace

bool AtmosphereView::volume(const AtmosphereTables& tables) const {
  const double thickness = thickness_m(tables);
  // The volume would smooth what half floats do.
  const BrunetonChoices& bruneton = tables.sky_rays.bruneton;
  return bruneton.transmittance == BrunetonTransmittance::kOfOpticalDepths &&
         bruneton.in_scatter == BrunetonInScatter::kExact &&
         !is_closed_form(tables.sky_rays.mapping) &&
         tables.sky_rays.mapping != SkyRayMapping::kONeil &&
         options.aerial == AerialPerspective::kVolume && only_ground && !second_light(options) &&
         options.camera.altitude_m <= std::min(kVolumeAbove, thickness) && highest_m <= thickness &&
         !has_dense_layers(shells_of(tables.atmosphere, Keep::kWhatMatters));
}

bool AtmosphereView::sky_rays(const AtmosphereTables& tables) const {
  if (is_closed_form(tables.sky_rays.mapping)) return false;
  return tables.sky_rays.mapping != SkyRayMapping::kFromOutside ||
         options.camera.altitude_m > thickness_m(tables);
}

bool AtmosphereView::sees_grains() const { return !only_ground || nearest_m < grainless_m(*this); }

bool AtmospherePass::has_sky_view(const FrameOptions& options) const {
  const SkyRayMapping mapping = tables_.sky_rays.mapping;
  const bool hillaire = mapping == SkyRayMapping::kHillaire;
  // Closed forms and sums of what is before a surface have no whole rays to the ground.
  if (is_closed_form(mapping) || mapping == SkyRayMapping::kONeil ||
      mapping == SkyRayMapping::kBodare)
    return false;
  return options.camera.altitude_m <= (hillaire ? thickness_m(tables_) : kAbove);
}

AtmospherePass::AtmospherePass(GraphicsDevice device)
    : device_(device), empty_(make_vertex_array()) {}

void AtmospherePass::set_tables(const AtmosphereTables& tables, const TableCodes& codes) {
  codes_ = codes;
  tables_.atmosphere = tables.atmosphere;
  tables_.color = tables.color;
  tables_.sizes = tables.sizes;
  tables_.heights = tables.heights;
  tables_.sky_rays.mapping = tables.sky_rays.mapping;
  tables_.sky_rays.nielsen = tables.sky_rays.nielsen;
  tables_.sky_rays.oneil = tables.sky_rays.oneil;
  tables_.sky_rays.bruneton = tables.sky_rays.bruneton;
  tables_.sky_rays.formula = tables.sky_rays.formula;
  tables_.sky_rays.air = without_values(tables.sky_rays.air);
  tables_.phases = tables.phases;
  scattering_coefficients_ = scattering_texture(tables);
  refraction_.reset();
  gathered_.reset();
  if (tables.sky_rays.mapping == SkyRayMapping::kBodare) gathered_ = gathered_texture(tables);
}

GLuint AtmospherePass::program(const std::string& path, const Defined& defined) {
  const auto key = std::pair(path, defined);
  const auto found = programs_.find(key);
  if (found != programs_.end()) return found->second.id();
  return programs_.emplace(key, build_program(stages_of(path, defined), {}, defined))
      .first->second.id();
}

AtmospherePass::Defined AtmospherePass::defined_by(const FeatureShader& shader) const {
  Defined defined = atmosphere_defines(tables_, codes_);
  std::ranges::move(feature_defines(shader), std::back_inserter(defined));
  if (!has_sky_view(shader.options)) defined.push_back("FROM_ABOVE");
  return defined;
}

const Refraction& AtmospherePass::refraction() {
  constexpr double kWavelength = 550;  // of which the bending is that of all
  if (!refraction_) refraction_.emplace(tables_.atmosphere, kWavelength);
  return *refraction_;
}

glm::vec4 AtmospherePass::eye_in_air(const FrameOptions& options) {
  if (!options.refraction) return glm::vec4(0);
  const auto [refractivity, scale_height] = refraction().near_ground();
  return glm::dvec4(1e-3 * tables_.atmosphere.bottom_radius_m, 1e-3 * options.camera.altitude_m,
                    refractivity, 1e-3 * scale_height);
}

void AtmospherePass::bind_blocks(GLuint program, const AtmosphereView& view) {
  const FrameOptions& options = view.options;
  UniformBlock block(program, "View");
  block.set("site_from_view", glm::transpose(view.projection.view_from_site));
  block.set("planet_from_site", glm::mat3(view.axes.planet_from_site()));
  block.set("tangent", view.projection.tangent);
  block.set("camera_km", 1e-3 * options.camera.altitude_m);
  block.set("near_km", view.projection.near_km);
  block.set("pixel_angle", pixel_rad(options));
  block.set("volume_km", view.farthest_km);
  block.set("slope_variance", SharedSea<double>{}.sea_slope_variance(options.wind_m_s));
  const auto second = second_light(options);
  std::vector<glm::vec4> suns;
  for (const glm::dvec3& sun : directions_of_suns(options)) suns.emplace_back(sun, 1);
  if (second) suns.back().w = static_cast<float>(second->share);
  block.set("suns", std::span<const glm::vec4>(suns));
  if (options.refraction) {
    std::vector<glm::vec4> bending;
    for (std::size_t i = 0; i < suns.size(); ++i) {
      const double zenith =
          std::atan2(glm::length(glm::dvec2(suns[i].x, suns[i].y)), double{suns[i].z});
      const double star = tables_.atmosphere.star.angular_radius_rad(),
                   radius = i > 0 ? second->moon_radius.value_or(star) : star;
      std::ranges::copy(disc_bending(refraction(), options.camera.altitude_m, zenith, radius),
                        std::back_inserter(bending));
    }
    block.set("bending", std::span<const glm::vec4>(bending));
    const glm::vec4& eye = view.projection.eye_in_air;
    block.set("refractive_air", glm::vec2(eye.z, eye.w));
  }
  block.bind(blocks_);
  bind_atmosphere(tables_, program, blocks_, codes_);
}

void AtmospherePass::add_sky_view(const FrameOptions& options, FrameGraph& graph) const {
  const glm::ivec3 size = sky_view_size(tables_);
  const int suns = second_light(options) ? 2 : 1,
            classes = static_cast<int>(tables_.phases.others.size());
  for (const std::string& target : kSkyViewWrites)
    graph.add_target(target, GL_RGBA32F, size.x * suns * classes, size.y + size.z);
}

void AtmospherePass::draw_triangle(GLuint program) const {
  glUseProgram(program);
  glBindVertexArray(empty_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void AtmospherePass::draw_sky_view(const AtmosphereView& view) {
  const GLuint id = program(kSkyView, defined_by({view.options, tables_.color}));
  bind_blocks(id, view);
  glBindTextureUnit(kScatteringUnit, scattering_coefficients_.id());
  draw_triangle(id);
}

void AtmospherePass::fill_volume(const AtmosphereView& view) {
  const int classes = static_cast<int>(tables_.phases.others.size());
  if (!volume_ || volume_->classes() != classes) volume_.emplace(classes);
  Defined defined = defined_by({view.options, tables_.color});
  // It subtracts neighbouring points of the tables.
  if (device_ == GraphicsDevice::kGpu) defined.push_back("EXACT_FILTER");
  const GLuint id = program(kFillVolume, defined);
  bind_blocks(id, view);
  glBindTextureUnit(kScatteringUnit, scattering_coefficients_.id());
  if (gathered_) glBindTextureUnit(kGatheredUnit, gathered_->id());
  volume_->fill(id);
}

GLuint AtmospherePass::variant(const std::string& path, const Defined& what,
                               const AtmosphereView& view) {
  Defined defined = defined_by({.options = view.options,
                                .color = tables_.color,
                                .reads_volume = view.volume(tables_),
                                .has_shadow_maps = !view.shadows.empty()});
  defined.push_back(fmt::format(
      "LIGHT_FROM_NODES {:.9g}",
      fmt::join(light_from_nodes(tables_.color, color_space(view.options.primaries)), ", ")));
  if (path == kCompute) std::ranges::copy(class_defines(), std::back_inserter(defined));
  defined.insert(defined.end(), what.begin(), what.end());
  const bool surface = std::ranges::find(what, kSurface) != what.end();
  const bool own_paths = tables_.sky_rays.bruneton.in_scatter == BrunetonInScatter::kInHalfFloats;
  if ((!surface || own_paths) && view.sky_rays(tables_))
    defined.push_back(fmt::format("SKY_RAYS {}", static_cast<int>(tables_.sky_rays.mapping)));
  if (surface) std::ranges::copy(view.own_textures.defines(), std::back_inserter(defined));
  if (surface && tables_.atmosphere.sea) defined.push_back("SEA");
  if (std::ranges::find(what, kDisc) != what.end())
    defined.push_back(fmt::format("DISC_LOCATION {}", disc_location(view.options)));
  return program(path, defined);
}

void AtmospherePass::classify(const AtmosphereView& view) {
  const GLuint classes = program(kClasses, class_defines());
  const Uniforms uniforms(classes);
  uniforms.set("grainless_depth", grainless_depth(view));
  uniforms.set("tangent", view.projection.tangent);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  draw_triangle(classes);
}

void AtmospherePass::bind(const AtmosphereView& view, const ShadowPass& shadow_maps, GLuint sky,
                          GLuint grainy) {
  bind_blocks(sky, view);
  if (!view.shadows.empty()) {
    shadow_maps.bind(view.shadows, directions_of_suns(view.options).size(), grainy, kShadowUnit,
                     blocks_);
  }
  glBindTextureUnit(kScatteringUnit, scattering_coefficients_.id());
  if (!view.options.clouds.empty()) {
    if (!clouds_) clouds_.emplace();
    clouds_->bind(view.options.clouds,
                  std::min(view.options.camera.altitude_m, thickness_m(tables_)), sky, kCloudUnit,
                  blocks_);
  }
  if (view.volume(tables_)) {
    volume_->bind(kVolumeUnit);
  } else if (gathered_) {
    glBindTextureUnit(kGatheredUnit, gathered_->id());
  }
  const glm::dvec3 camera =
      (tables_.atmosphere.bottom_radius_m + view.options.camera.altitude_m) * view.axes.z;
  view.materials.bind(camera, grainy, kMaterialUnit, blocks_);
  view.own_textures.bind(camera, grainy, kOwnMaterialUnit, blocks_);
}

void AtmospherePass::clear_disc(const AtmosphereView& view) const {
  if (!view.read) return;
  const GLuint location = disc_location(view.options);
  const std::array<float, 4> nothing{};
  glClearBufferfv(GL_COLOR, static_cast<GLint>(location), nothing.data());
  // Only the suns write to it.
  glColorMaski(location, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
}

void AtmospherePass::draw(const AtmosphereView& view, const ShadowPass& shadow_maps) {
  const GLuint sky = variant(kFragments, {}, view);
  const GLuint grainless = variant(kFragments, {kSurface}, view);
  const GLuint grainy = variant(kFragments, {kSurface, kGrains}, view);
  bind(view, shadow_maps, sky, grainy);
  clear_disc(view);
  // The triangle lies at the near end of the range of depths.
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_EQUAL);
  glDepthRange(kSkyClass, 1);
  draw_triangle(sky);
  draw_suns(view);
  // What takes longest comes last: before another program samples what has been drawn, Mesa's
  // renderer waits for all that is on its way.
  if (view.sees_grains()) {
    glDepthRange(kGrainlessClass, 1);
    draw_triangle(grainless);
    glDepthRange(kGrainyClass, 1);
    draw_triangle(grainy);
  } else {
    glDepthFunc(GL_LESS);  // than any depth: the pixels have no classes
    draw_triangle(grainless);
  }
}

void AtmospherePass::dispatch(const AtmosphereView& view, const ShadowPass& shadow_maps) {
  const GLuint sky = variant(kCompute, {}, view);
  const GLuint grainless = variant(kCompute, {kSurface}, view);
  const GLuint grainy = variant(kCompute, {kSurface, kGrains}, view);
  bind(view, shadow_maps, sky, grainy);
  const auto groups = [&](int pixels) {
    return static_cast<GLuint>((pixels * view.options.samples_per_side + kGroup - 1) / kGroup);
  };
  std::vector<std::pair<GLuint, double>> classes = {{sky, kSkyClass}, {grainless, kGrainlessClass}};
  if (view.sees_grains()) classes.emplace_back(grainy, kGrainyClass);
  for (const auto& [id, pixel_class] : classes) {
    const Uniforms uniforms(id);
    uniforms.set("pixel_class", pixel_class);
    uniforms.set("grainless_depth", grainless_depth(view));
    glUseProgram(id);
    glDispatchCompute(groups(view.options.width), groups(view.options.height), 1);
  }
}

void AtmospherePass::draw_only_suns(const AtmosphereView& view) {
  clear_disc(view);
  draw_suns(view);
}

void AtmospherePass::draw_suns(const AtmosphereView& view) {
  glUseProgram(variant(kFragments, {kDisc}, view));
  if (view.read) glColorMaski(disc_location(view.options), GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBindVertexArray(empty_.id());
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_EQUAL);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, second_light(view.options) ? 2 : 1);
  if (view.read) glColorMaski(disc_location(view.options), GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
}

}  // namespace skyfit
