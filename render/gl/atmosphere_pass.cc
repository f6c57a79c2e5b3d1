// SPDX-License-Identifier: Apache-2.0
#include "render/gl/atmosphere_pass.h"

#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "render/gl/shader.h"
#include "render/gl/uniforms.h"

namespace skyfit {
namespace {

void add(const std::string& name, const Table& table, FrameGraph& graph) {
  graph.add_table(name, table.width, table.height, table.depth, table.rgba);
}

}  // namespace

void add_tables(const AtmosphereTables& tables, FrameGraph& graph) {
  add("optical_depth", tables.optical_depth, graph);
  add("irradiance", tables.irradiance, graph);
  add("rayleigh_like", tables.rayleigh_like, graph);
  add("single_mie", tables.single_mie, graph);
  add("phase", tables.phase, graph);
}

void set_atmosphere(const AtmosphereTables& tables, GLuint program) {
  const Uniforms uniforms(program);
  const Atmosphere<double>& a = tables.atmosphere;
  const AerosolPhase<double>& phase = a.mie.phase;
  const TableSizes& sizes = tables.sizes;
  uniforms.set("bottom_km", 1e-3 * a.bottom_radius_m);
  uniforms.set("thickness_km", 1e-3 * (a.top_radius_m - a.bottom_radius_m));
  uniforms.set("mu_s_min", kTableLowestSun);
  uniforms.set("scattering_size", glm::vec4(sizes.scattering_mu_s, sizes.scattering_azimuth,
                                            sizes.scattering_ground, sizes.scattering_sky));
  uniforms.set("depolarisation", a.rayleigh.depolarisation);
  uniforms.set("phase_type", static_cast<int>(phase.type));
  uniforms.set("lobe_type", static_cast<int>(phase.lobe));
  uniforms.set("phase_parameters", glm::vec4(phase.g, phase.g1, phase.g2, phase.weight));
}

AtmospherePass::AtmospherePass(const AtmosphereTables& tables)
    : program_(build_program(
          std::array{ShaderStage{GL_VERTEX_SHADER, "render/shaders/fullscreen.vert"},
                     ShaderStage{GL_FRAGMENT_SHADER, "render/shaders/atmosphere.frag"}})) {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  empty_ = GlVertexArray(id);
  set_atmosphere(tables, program_.id());
  const Uniforms uniforms(program_.id());
  glm::vec4 ground_albedo;
  for (int node = 0; node < 4; ++node) {
    ground_albedo[node] = static_cast<float>(ground_albedo_at(
        tables.atmosphere, tables.color.nodes[static_cast<std::size_t>(node)].wavelength_nm));
  }
  uniforms.set("ground_albedo", ground_albedo);
  glm::mat4x3 xyz_from_nodes;
  glm::mat3 srgb_from_xyz;
  for (int row = 0; row < 3; ++row) {
    const auto r = static_cast<std::size_t>(row);
    for (int node = 0; node < 4; ++node) {
      xyz_from_nodes[node][row] =
          static_cast<float>(tables.color.xyz_from_nodes[r][static_cast<std::size_t>(node)]);
    }
    for (int k = 0; k < 3; ++k) {
      srgb_from_xyz[k][row] =
          static_cast<float>(kLinearSrgbFromXyz[r][static_cast<std::size_t>(k)]);
    }
  }
  uniforms.set("xyz_from_nodes", xyz_from_nodes);
  uniforms.set("srgb_from_xyz", srgb_from_xyz);
}

void AtmospherePass::draw(const Projection& projection, const FrameOptions& options) const {
  const Uniforms uniforms(program_.id());
  uniforms.set("site_from_view", glm::transpose(projection.view_from_site));
  uniforms.set("tangent", projection.tangent);
  uniforms.set("near_km", projection.near_km);
  uniforms.set("camera_km", 1e-3 * options.camera.altitude_m);
  uniforms.set("sun", glm::vec3(std::sin(options.sun_zenith), 0, std::cos(options.sun_zenith)));
  uniforms.set("pixel_angle",
               options.camera.vertical_fov / (options.height * options.samples_per_side));
  glDisable(GL_DEPTH_TEST);
  glUseProgram(program_.id());
  glBindVertexArray(empty_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace skyfit
