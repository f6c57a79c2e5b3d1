// SPDX-License-Identifier: Apache-2.0
#include "render/gl/atmosphere/atmosphere_tables.h"

#include <fmt/format.h>

#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"
#include "model/literature/bruneton_tables.h"
#include "model/literature/evaluate.h"
#include "model/literature/hillaire_tables.h"
#include "model/literature/nielsen.h"
#include "model/numerics/half.h"
#include "render/glsl/table_defines.h"

namespace skyfit {
namespace {

void add(const std::string& name, const Table& table, FrameGraph& graph) {
  graph.add_table(name, table.width, table.height, table.depth, GL_RGBA32F, table.rgba.data());
}

TexelCode add(const std::string& name, const Table& table, TableHolds holds,
              TablePrecision precision, FrameGraph& graph) {
  if (precision == TablePrecision::kFloat) {
    add(name, table, graph);
    return {};
  }
  const EncodedTable texels = encoded(table, holds, precision);
  graph.add_table(name, texels.width, texels.height, texels.depth,
                  precision == TablePrecision::kHalf ? GL_RGBA16F : GL_RGBA8, texels.texels.data());
  return texels.code;
}

glm::vec4 ground_albedo(const AtmosphereTables& tables) {
  glm::vec4 albedo;
  for (int node = 0; node < 4; ++node) {
    albedo[node] = static_cast<float>(ground_albedo_at(
        tables.atmosphere, tables.color.nodes[static_cast<std::size_t>(node)].wavelength_nm));
  }
  return albedo;
}

void set_closed_form(const AtmosphereTables& tables, UniformBlock& block) {
  const auto air = literature::air_at_nodes(tables.atmosphere, tables.color.nodes);
  block.set("air_beta", glm::vec4(air.air[0], air.air[1], air.air[2], air.air[3]));
  block.set("aerosol_beta",
            glm::vec4(air.aerosol[0], air.aerosol[1], air.aerosol[2], air.aerosol[3]));
  if (tables.sky_rays.mapping == SkyRayMapping::kNielsen) {
    const NielsenAerosol aerosol = nielsen_aerosol(tables.atmosphere);
    block.set("nielsen_haze", glm::vec2(aerosol.hazy_g, aerosol.mie_multiplier));
  } else {
    block.set("scale_heights_m", glm::vec2(air.air_scale_height_m, air.aerosol_scale_height_m));
  }
  if (!is_formula(tables.sky_rays.mapping)) return;
  const FormulaSky& sky = tables.sky_rays.formula;
  std::vector<glm::vec4> from_xyz(3);
  for (int node = 0; node < 4; ++node) {
    for (std::size_t c = 0; c < 3; ++c)
      from_xyz[c][node] =
          static_cast<float>(sky.radiance_from_xyz[static_cast<std::size_t>(node)][c]);
  }
  block.set("radiance_from_xyz", std::span<const glm::vec4>(from_xyz));
  block.set("turbidity", sky.turbidity);
}

// What render/shaders/closed_form.glsl is compiled for.
void define_closed_form(const AtmosphereTables& tables, std::vector<std::string>& defined) {
  defined.emplace_back("CLOSED_FORM");
  if (is_formula(tables.sky_rays.mapping)) defined.emplace_back("FORMULA_SKY");
  if (tables.sky_rays.mapping == SkyRayMapping::kHosekWilkie) defined.emplace_back("HOSEK_WILKIE");
  if (tables.sky_rays.mapping != SkyRayMapping::kNielsen) return;
  const NielsenChoices& choices = tables.sky_rays.nielsen;
  defined.emplace_back("NIELSEN");
  defined.push_back(
      fmt::format("NIELSEN_LOBE {}", static_cast<int>(nielsen_aerosol(tables.atmosphere).lobe)));
  if (choices.mean == NielsenMean::kOfHeights) defined.emplace_back("NIELSEN_MEAN_HEIGHT");
  if (choices.phase == NielsenAirPhase::kPublished) defined.emplace_back("NIELSEN_PUBLISHED_PHASE");
  if (choices.sun == NielsenSun::kPublished) defined.emplace_back("NIELSEN_PUBLISHED_SUN");
}

// What stands in the place of Bruneton's repairs.
void define_repairs(const BrunetonChoices& choices, std::vector<std::string>& defined) {
  if (choices.transmittance == BrunetonTransmittance::kInHalfFloats)
    defined.push_back(fmt::format("LEAST_TRANSMITTANCE {:.9g}", kLeastHalf));
  if (choices.in_scatter == BrunetonInScatter::kInHalfFloats)
    defined.emplace_back("BRUNETON_BY_RADII");
}

// What render/shaders/oneil.glsl is compiled for.
void define_sums(const ONeilChoices& choices, std::vector<std::string>& defined) {
  defined.emplace_back("ONEIL");
  defined.push_back(fmt::format("ONEIL_SAMPLES {}", choices.samples));
  if (choices.depths == ONeilDepths::kPolynomial) defined.emplace_back("ONEIL_POLYNOMIAL");
  if (choices.phase == ONeilAirPhase::kIsotropic) defined.emplace_back("ONEIL_ISOTROPIC_AIR");
  if (choices.shadow == ONeilShadow::kNone) defined.emplace_back("ONEIL_NO_SHADOW");
}

// Of RGBA in single precision.
GlTexture flat_texture(GLsizei width, GLsizei height, const void* rgba) {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &id);
  GlTexture texture(id);
  glTextureStorage2D(id, 1, GL_RGBA32F, width, height);
  glTextureSubImage2D(id, 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, rgba);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

// Rows and columns of the sky's view for each texel of the scattering table.
constexpr int kRowsPerTexel = 4, kColumnsPerTexel = 2;

glm::ivec3 sky_view_size(const AtmosphereTables& tables) {
  using Hillaire = literature::HillaireSizes;
  if (tables.sky_rays.mapping == SkyRayMapping::kHillaire)
    return {Hillaire::sky_view_azimuth, 0, Hillaire::sky_view_rows / 2};
  const TableSizes& sizes = tables.sizes;
  return {(sizes.scattering_azimuth - 1) * kColumnsPerTexel + 1,
          (sizes.scattering_ground - 1) * kRowsPerTexel + 1,
          (sizes.scattering_sky - 1) * kRowsPerTexel + 1};
}

GlTexture scattering_texture(const AtmosphereTables& tables) {
  const auto heights = static_cast<std::size_t>(tables.heights.texels(256));
  const Atmosphere<double>& a = tables.atmosphere;
  const Shells shells = shells_of(a, Keep::kAll);
  const Atmosphere<Dual<0>> plain = seeded<0>(a, {});
  std::vector<glm::vec4> values(heights * (tables.phases.count() + 1), glm::vec4(0));
  for (int node = 0; node < 4; ++node) {
    const Optics<0> optics =
        true_optics_at(shells, plain, tables.color.nodes[static_cast<std::size_t>(node)]);
    for (std::size_t i = 0; i < heights; ++i) {
      const double h = tables.heights.height(
          static_cast<double>(i) / static_cast<double>(heights - 1), shells.top);
      const Densities<0> density = optics.densities(h);
      for (std::size_t k = 0; k < optics.extinction.size(); ++k) {
        values[tables.phases.count() * heights + i][node] +=
            static_cast<float>(1e3 * optics.extinction[k].v * density[k].v);
      }
      for (const Scatterer<0>& s : optics.scatterers) {
        const auto row = static_cast<std::size_t>(tables.phases.of_constituent[s.constituent]);
        values[row * heights + i][node] +=
            static_cast<float>(1e3 * s.scattering.v * density[s.profile].v);
      }
    }
  }
  const auto width = static_cast<GLsizei>(heights),
             height = static_cast<GLsizei>(tables.phases.count() + 1);
  return flat_texture(width, height, values.data());
}

GlTexture gathered_texture(const AtmosphereTables& tables) {
  const Table& gathered = tables.sky_rays.gathered;
  return flat_texture(gathered.width, gathered.height, gathered.rgba.data());
}

TableCodes add_tables(const AtmosphereTables& tables, FrameGraph& graph, TablePrecision precision) {
  const SkyRayMapping mapping = tables.sky_rays.mapping;
  const auto of_sky_rays = [&](const std::string& name, const Table& table) {
    return add(name, table, sky_rays_hold(mapping),
               sky_rays_encoded(mapping) ? precision : TablePrecision::kFloat, graph);
  };
  add("optical_depth", tables.optical_depth, graph);
  add("irradiance", tables.irradiance, graph);
  add("phase", tables.phase, graph);
  return {precision,
          add("rayleigh_like", tables.rayleigh_like, TableHolds::kLogarithms, precision, graph),
          add("single", tables.single, TableHolds::kLogarithms, precision, graph),
          of_sky_rays("sky_ray_air", tables.sky_rays.air),
          of_sky_rays("sky_ray_aerosol", tables.sky_rays.aerosol)};
}

void bind_atmosphere(const AtmosphereTables& tables, GLuint program, UniformBuffers& buffers,
                     const TableCodes& codes) {
  std::vector<glm::vec4> parameters;
  for (const auto& p : phase_parameters(tables.phases))
    parameters.emplace_back(p[0], p[1], p[2], p[3]);
  UniformBlock block(program, "Atmosphere");
  block.set("depolarisation", tables.phases.depolarisation);
  block.set("phase_parameters", std::span<const glm::vec4>(parameters));
  block.set("ground_albedo", ground_albedo(tables));
  if (codes.precision != TablePrecision::kFloat) {
    block.set("texel_scale", glm::vec4(codes.rayleigh_like.scale, codes.single.scale,
                                       codes.sky_ray_air.scale, codes.sky_ray_aerosol.scale));
    block.set("texel_offset", glm::vec4(codes.rayleigh_like.offset, codes.single.offset,
                                        codes.sky_ray_air.offset, codes.sky_ray_aerosol.offset));
  }
  if (is_closed_form(tables.sky_rays.mapping)) set_closed_form(tables, block);
  block.bind(buffers);
  if (const std::vector<double>& nodes = tables.heights.nodes(); !nodes.empty()) {
    std::vector<glm::vec4> fours((nodes.size() + 3) / 4);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      fours[i / 4][static_cast<int>(i % 4)] = static_cast<float>(nodes[i]);
    UniformBlock heights(program, "TableHeights");
    heights.set("height_nodes", std::span<const glm::vec4>(fours));
    heights.bind(buffers);
  }
}

std::vector<std::string> atmosphere_defines(const AtmosphereTables& tables,
                                            const TableCodes& codes) {
  const glm::ivec3 sky_view = sky_view_size(tables);
  const Table& sky_rays = tables.sky_rays.air;
  std::vector<std::string> defined = table_defines(tables);
  defined.insert(
      defined.end(),
      {fmt::format("SKY_VIEW_SIZE {}, {}, {}", sky_view.x, sky_view.y, sky_view.z),
       fmt::format("SKY_RAY_SIZE {}, {}, {}", sky_rays.width, sky_rays.height, sky_rays.depth),
       fmt::format("BRUNETON_NU {}", literature::BrunetonSizes::nu)});
  if (codes.precision != TablePrecision::kFloat) defined.emplace_back("ENCODED");
  // Mesa rounds what it interpolates between texels of 8 bits to 8 bits again.
  if (codes.precision == TablePrecision::k8Bit) defined.emplace_back("EXACT_FILTER");
  if (tables.sky_rays.mapping == SkyRayMapping::kHillaire) {
    using Hillaire = literature::HillaireSizes;
    defined.insert(defined.end(),
                   {"HILLAIRE", fmt::format("HILLAIRE_STEPS {}", Hillaire::view_steps),
                    fmt::format("HILLAIRE_SKY_VIEW {}, {}", Hillaire::sky_view_azimuth,
                                Hillaire::sky_view_rows)});
  }
  define_repairs(tables.sky_rays.bruneton, defined);
  if (tables.sky_rays.mapping == SkyRayMapping::kONeil) define_sums(tables.sky_rays.oneil, defined);
  if (tables.sky_rays.mapping == SkyRayMapping::kBodare) defined.emplace_back("BODARE");
  if (is_closed_form(tables.sky_rays.mapping)) define_closed_form(tables, defined);
  return defined;
}

}  // namespace skyfit
