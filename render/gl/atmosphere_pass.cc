// SPDX-License-Identifier: Apache-2.0
#include "render/gl/atmosphere_pass.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "render/gl/shader.h"
#include "render/gl/uniform_block.h"

namespace skyfit {
namespace {

void add(const std::string& name, const Table& table, FrameGraph& graph) {
  graph.add_table(name, table.width, table.height, table.depth, table.rgba);
}

// Rows and columns of the sky's view for each texel of the scattering table.
constexpr int kRowsPerTexel = 4, kColumnsPerTexel = 2;

glm::vec4 second_sun(const SecondSun& sun) {
  const double s = std::sin(sun.zenith);
  return {s * std::cos(sun.azimuth), -s * std::sin(sun.azimuth), std::cos(sun.zenith),
          sun.irradiance};
}

glm::vec4 ground_albedo(const AtmosphereTables& tables) {
  glm::vec4 albedo;
  for (int node = 0; node < 4; ++node) {
    albedo[node] = static_cast<float>(ground_albedo_at(
        tables.atmosphere, tables.color.nodes[static_cast<std::size_t>(node)].wavelength_nm));
  }
  return albedo;
}

glm::vec4 scattering_per_km(const AtmosphereTables& tables, const PowerLaw<double>& law,
                            double share) {
  glm::vec4 values;
  for (int node = 0; node < 4; ++node) {
    const double wavelength = tables.color.nodes[static_cast<std::size_t>(node)].wavelength_nm;
    values[node] = static_cast<float>(
        1e3 * share * law.value * std::pow(wavelength / law.wavelength_nm, -law.exponent));
  }
  return values;
}

GlBuffer color_block(const ColorRule& color, GLuint program) {
  glm::mat4x3 xyz_from_nodes;
  glm::mat3 srgb_from_xyz;
  for (int row = 0; row < 3; ++row) {
    const auto r = static_cast<std::size_t>(row);
    for (int node = 0; node < 4; ++node) {
      xyz_from_nodes[node][row] =
          static_cast<float>(color.xyz_from_nodes[r][static_cast<std::size_t>(node)]);
    }
    for (int k = 0; k < 3; ++k) {
      srgb_from_xyz[k][row] =
          static_cast<float>(kLinearSrgbFromXyz[r][static_cast<std::size_t>(k)]);
    }
  }
  UniformBlock block(program, "Colors");
  block.set("xyz_from_nodes", xyz_from_nodes);
  block.set("srgb_from_xyz", srgb_from_xyz);
  return block.bind();
}

}  // namespace

void add_tables(const AtmosphereTables& tables, FrameGraph& graph) {
  add("optical_depth", tables.optical_depth, graph);
  add("irradiance", tables.irradiance, graph);
  add("rayleigh_like", tables.rayleigh_like, graph);
  add("single_mie", tables.single_mie, graph);
  add("phase", tables.phase, graph);
}

GlBuffer atmosphere_block(const AtmosphereTables& tables, GLuint program) {
  const Atmosphere<double>& a = tables.atmosphere;
  const AerosolPhase<double>& phase = a.mie.phase;
  const TableSizes& sizes = tables.sizes;
  UniformBlock block(program, "Atmosphere");
  block.set("bottom_km", 1e-3 * a.bottom_radius_m);
  block.set("thickness_km", 1e-3 * (a.top_radius_m - a.bottom_radius_m));
  block.set("mu_s_min", kTableLowestSun);
  block.set("depolarisation", a.rayleigh.depolarisation);
  block.set("scattering_size", glm::vec4(sizes.scattering_mu_s, sizes.scattering_azimuth,
                                         sizes.scattering_ground, sizes.scattering_sky));
  block.set("phase_parameters", glm::vec4(phase.g, phase.g1, phase.g2, phase.weight));
  block.set("ground_albedo", ground_albedo(tables));
  block.set("air_scattering", scattering_per_km(tables, a.rayleigh.scattering_per_m,
                                                a.rayleigh.site_pressure_hpa / kStandardPressureHpa));
  block.set("aerosol_scattering", scattering_per_km(tables, a.mie.scattering_per_m, 1));
  return block.bind();
}

AtmospherePass::AtmospherePass() : empty_(make_vertex_array()) {}

void AtmospherePass::set_tables(const AtmosphereTables& tables) {
  tables_.atmosphere = tables.atmosphere;
  tables_.color = tables.color;
  tables_.sizes = tables.sizes;
}

std::vector<std::string> atmosphere_defines(const AtmosphereTables& tables) {
  const AerosolPhase<double>& phase = tables.atmosphere.mie.phase;
  return {fmt::format("PHASE_TYPE {}", static_cast<int>(phase.type)),
          fmt::format("LOBE_TYPE {}", static_cast<int>(phase.lobe))};
}

GLuint AtmospherePass::program(const std::string& fragment, const Defined& defined) {
  const auto key = std::pair(fragment, defined);
  const auto found = programs_.find(key);
  if (found != programs_.end()) return found->second.id();
  GlProgram built =
      build_program(std::array{ShaderStage{GL_VERTEX_SHADER, "render/shaders/fullscreen.vert"},
                               ShaderStage{GL_FRAGMENT_SHADER, fragment}},
                    {}, defined);
  return programs_.emplace(key, std::move(built)).first->second.id();
}

AtmospherePass::Defined AtmospherePass::defined_by(const FrameOptions& options) const {
  Defined defined = atmosphere_defines(tables_);
  if (options.second_sun) defined.push_back("SECOND_SUN");
  return defined;
}

glm::ivec3 AtmospherePass::sky_view_size() const {
  const TableSizes& sizes = tables_.sizes;
  return {(sizes.scattering_azimuth - 1) * kColumnsPerTexel + 1,
          (sizes.scattering_ground - 1) * kRowsPerTexel + 1,
          (sizes.scattering_sky - 1) * kRowsPerTexel + 1};
}

void AtmospherePass::bind_blocks(GLuint program, const Projection& projection,
                                 const SiteAxes& axes, const FrameOptions& options) {
  UniformBlock view(program, "View");
  view.set("site_from_view", glm::transpose(projection.view_from_site));
  view.set("planet_from_site", glm::mat3(axes.planet_from_site()));
  view.set("tangent", projection.tangent);
  view.set("camera_km", 1e-3 * options.camera.altitude_m);
  view.set("near_km", projection.near_km);
  view.set("pixel_angle",
           options.camera.vertical_fov / (options.height * options.samples_per_side));
  view.set("sky_view_size", glm::vec4(sky_view_size(), 0));
  std::vector<glm::vec4> suns = {{std::sin(options.sun_zenith), 0, std::cos(options.sun_zenith), 1}};
  if (const auto& sun = options.second_sun) suns.push_back(second_sun(*sun));
  view.set("suns", std::span<const glm::vec4>(suns));
  blocks_.clear();
  blocks_.push_back(view.bind());
  blocks_.push_back(atmosphere_block(tables_, program));
}

void AtmospherePass::add_sky_view(const FrameOptions& options, FrameGraph& graph) const {
  const glm::ivec3 size = sky_view_size();
  for (const std::string& target : kSkyViewWrites)
    graph.add_target(target, GL_RGBA32F, size.x * (options.second_sun ? 2 : 1), size.y + size.z);
}

void AtmospherePass::draw_triangle(GLuint program) const {
  glUseProgram(program);
  glBindVertexArray(empty_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void AtmospherePass::draw_sky_view(const Projection& projection, const SiteAxes& axes,
                                   const FrameOptions& options) {
  const GLuint id = program("render/shaders/sky_view.frag", defined_by(options));
  bind_blocks(id, projection, axes, options);
  draw_triangle(id);
}

GLuint AtmospherePass::variant(bool surface, const FrameOptions& options) {
  Defined defined = defined_by(options);
  if (surface) defined.push_back("SURFACE");
  if (options.layers) defined.push_back("LAYERS");
  return program("render/shaders/atmosphere.frag", defined);
}

void AtmospherePass::draw(const FrameOptions& options) {
  const GLuint sky = variant(false, options), surface = variant(true, options);
  blocks_.push_back(color_block(tables_.color, sky));
  // The triangle lies at depth 0, as the sky does.
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_EQUAL);
  draw_triangle(sky);
  glDepthFunc(GL_LESS);
  draw_triangle(surface);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace skyfit
