// SPDX-License-Identifier: Apache-2.0
#include "render/engine/engine_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "model/atmosphere/ground_spectrum.h"
#include "model/base/whole_file.h"
#include "model/tables/diffuse_source.h"
#include "model/version.h"
#include "render/glsl/shader_text.h"
#include "render/glsl/table_defines.h"

namespace skyfit {
namespace {

using nlohmann::ordered_json;

constexpr const char *kJson = "tables.json", *kGlsl = "sky.glsl", *kHlsl = "sky.hlsl";

struct TableEntry {
  std::string_view name, meaning, axes;
  Table AtmosphereTables::*table;
  bool scattering;  // logarithms of scattered light, in the precision that is asked for
};

// In the order of render/shaders/atmosphere.glsl.
constexpr std::array kTables = {
    TableEntry{"optical_depth", "optical depth from a point to the top of the atmosphere",
               "x: cosine of the zenith angle, y: height", &AtmosphereTables::optical_depth, false},
    TableEntry{"irradiance", "diffuse irradiance of a horizontal surface per unit solar irradiance",
               "x: sun, y: height", &AtmosphereTables::irradiance, false},
    TableEntry{"rayleigh_like",
               "natural logarithm of the mean along the ray, per km, of single Rayleigh scattering "
               "without its phase function and of multiple scattering over that",
               "x: sun (fastest) and azimuth, y: cosine of the zenith angle, z: height",
               &AtmosphereTables::rayleigh_like, true},
    TableEntry{"single",
               "natural logarithm of the mean along the ray, per km, of single scattering of the "
               "other scatterers without their phase functions",
               "x: sun (fastest) and azimuth, y: cosine of the zenith angle, z: height, one "
               "phase function after the other",
               &AtmosphereTables::single, true},
    TableEntry{"phase", "natural logarithm of tabulated phase functions, 1/sr",
               "x: scattering angle from 0 to 180 degrees, y: phase function",
               &AtmosphereTables::phase, false}};

using Row = std::array<double, 4>;

// Red, green, blue and luminance from values at the four wavelengths.
std::array<Row, 4> light_rows(const ColorRule& color, const ColorSpace& space) {
  std::array<Row, 4> rows{};
  for (std::size_t node = 0; node < 4; ++node) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < 3; ++k)
        rows[c][node] += space.from_xyz[c][k] * color.xyz_from_nodes[k][node];
    }
    rows[3][node] = color.xyz_from_nodes[1][node];
  }
  return rows;
}

std::string listed(const Row& row) { return fmt::format("{:.9g}", fmt::join(row, ", ")); }

Row ground_albedo(const AtmosphereTables& tables) {
  Row albedo{};
  for (std::size_t node = 0; node < 4; ++node)
    albedo[node] = ground_albedo_at(tables.atmosphere, tables.color.nodes[node].wavelength_nm);
  return albedo;
}

const EncodedTable& texels_of(const EngineTables& tables, std::string_view name) {
  for (const EngineTable& table : tables.tables) {
    if (table.name == name) return table.texels;
  }
  throw std::logic_error(fmt::format("no table {}", name));
}

std::vector<std::string> defines_of(const EngineTables& engine, const AtmosphereTables& tables,
                                    TablePrecision precision, Primaries primaries) {
  std::vector<std::string> defined = lasting_table_defines(tables), phases;
  for (const auto& parameters : phase_parameters(tables.phases))
    phases.push_back(fmt::format("vec4({})", listed(parameters)));
  const auto light = light_rows(tables.color, color_space(primaries));
  defined.insert(
      defined.end(),
      {"LIBRARY", fmt::format("DEPOLARISATION {:.9g}", tables.phases.depolarisation),
       fmt::format("PHASE_PARAMETERS {}", fmt::join(phases, ", ")),
       "GROUND_ALBEDO " + listed(ground_albedo(tables)), "RED_FROM_NODES " + listed(light[0]),
       "GREEN_FROM_NODES " + listed(light[1]), "BLUE_FROM_NODES " + listed(light[2]),
       "LUMINANCE_FROM_NODES " + listed(light[3])});
  if (precision != TablePrecision::kFloat) {
    const TexelCode air = texels_of(engine, "rayleigh_like").code,
                    others = texels_of(engine, "single").code;
    defined.insert(
        defined.end(),
        {"ENCODED", fmt::format("TEXEL_SCALE {:.9g}, {:.9g}, 1, 1", air.scale, others.scale),
         fmt::format("TEXEL_OFFSET {:.9g}, {:.9g}, 0, 0", air.offset, others.offset)});
  }
  return defined;
}

std::string_view primaries_text(Primaries primaries) {
  switch (primaries) {
    case Primaries::kRec709:
      return "Rec. 709 (those of sRGB)";
    case Primaries::kRec2020:
      return "Rec. 2020";
    case Primaries::kXyz:
      return "CIE 1931 XYZ";
  }
  throw std::logic_error("no such primaries");
}

std::string title(const Preset& preset, Primaries primaries) {
  std::string name = preset.name;
  for (char& c : name) {
    if (c < ' ') c = ' ';  // it stands in a comment of one line
  }
  return fmt::format(
      "The sky of the preset {}, from its tables in this folder; made by skyfit {}.\n"
      "Colours: linear, {}; luminance in cd/m^2, illuminance in lx.\n"
      "The functions for a renderer are those whose names begin with skyfit_, at the end.\n",
      name, kVersion, primaries_text(primaries));
}

ordered_json table_json(const EngineTable& table) {
  const EncodedTable& texels = table.texels;
  return {{"name", table.name},
          {"holds", table.meaning},
          {"axes", table.axes},
          {"width", texels.width},
          {"height", texels.height},
          {"depth", texels.depth},
          {"precision", texels.precision == TablePrecision::kHalf ? "half" : "float"},
          {"value = scale * texel + offset", {texels.code.scale, texels.code.offset}}};
}

ordered_json phase_json(const PhaseClasses& phases) {
  ordered_json others = ordered_json::array();
  const auto parameters = phase_parameters(phases);
  for (std::size_t c = 0; c < parameters.size(); ++c) {
    others.push_back({{"type", static_cast<int>(phases.others[c].type)},
                      {"lobe", static_cast<int>(phases.others[c].lobe)},
                      {"g or depolarisation, g1, g2, weight", parameters[c]}});
  }
  return {{"depolarisation of rayleigh_like", phases.depolarisation}, {"single", others}};
}

ordered_json texels_json(const TableSizes& sizes) {
  return {{"sun", sizes.scattering_mu_s},
          {"azimuth", sizes.scattering_azimuth},
          {"rays_to_ground", sizes.scattering_ground},
          {"rays_to_sky", sizes.scattering_sky},
          {"height", sizes.scattering_r}};
}

ordered_json parameters_of(const EngineTables& engine, const Preset& preset,
                           const AtmosphereTables& tables, Primaries primaries) {
  const Atmosphere<double>& a = tables.atmosphere;
  const auto light = light_rows(tables.color, color_space(primaries));
  ordered_json nodes = ordered_json::array(), list = ordered_json::array();
  for (const WavelengthNode& node : tables.color.nodes) nodes.push_back(node.wavelength_nm);
  for (const EngineTable& table : engine.tables) list.push_back(table_json(table));
  return {{"skyfit_tables", 1},
          {"preset", preset.name},
          {"written_by", fmt::format("skyfit {}", kVersion)},
          {"wavelengths_nm", nodes},
          {"primaries", color_space(primaries).name},
          {"unit", "cd/m^2 of luminance, lx of illuminance"},
          {"light_from_wavelengths",
           {{"red", light[0]}, {"green", light[1]}, {"blue", light[2]}, {"luminance", light[3]}}},
          {"planet",
           {{"bottom_radius_km", 1e-3 * a.bottom_radius_m},
            {"thickness_km", 1e-3 * (a.top_radius_m - a.bottom_radius_m)},
            {"ground_albedo", ground_albedo(tables)}}},
          {"sun",
           {{"angular_radius_rad", a.star.angular_radius_rad()},
            {"limb_darkening", a.star.limb_darkening}}},
          {"lowest_sun", kTableLowestSun},
          {"scattering_texels", texels_json(tables.sizes)},
          {"phase_functions", phase_json(tables.phases)},
          {"tables", list}};
}

std::string file_name(std::string_view table, const TableFormatEntry& format) {
  return fmt::format("{}.{}", table, format.name);
}

}  // namespace

EngineTables engine_tables(const Preset& preset, const AtmosphereTables& tables,
                           TablePrecision precision, Primaries primaries) {
  EngineTables engine;
  for (const TableEntry& entry : kTables) {
    engine.tables.push_back(
        {entry.name, entry.meaning, entry.axes,
         encoded(tables.*entry.table,
                 entry.scattering ? TableHolds::kLogarithms : TableHolds::kValues,
                 entry.scattering ? precision : TablePrecision::kFloat)});
  }
  engine.parameters = parameters_of(engine, preset, tables, primaries);
  const auto defined = defines_of(engine, tables, precision, primaries);
  const auto library = [&](ShaderLanguage language) {
    return shader_library(title(preset, primaries), "render/shaders/sky_library.glsl", language,
                          defined);
  };
  engine.glsl = library(ShaderLanguage::kGlslLibrary);
  engine.hlsl = library(ShaderLanguage::kHlslLibrary);
  return engine;
}

std::vector<std::string> engine_file_names() {
  std::vector<std::string> names = {kJson, kGlsl, kHlsl};
  for (const TableFormatEntry& format : table_formats()) {
    for (const TableEntry& entry : kTables) names.push_back(file_name(entry.name, format));
  }
  return names;
}

void write_engine_tables(const EngineTables& tables, const TableFormatEntry& format,
                         const std::filesystem::path& directory) {
  ordered_json parameters = tables.parameters;
  for (std::size_t i = 0; i < tables.tables.size(); ++i) {
    const EngineTable& table = tables.tables[i];
    const std::string name = file_name(table.name, format);
    parameters["tables"][i]["file"] = name;
    format.write(table.texels, directory / name);
  }
  write_file(directory / kJson,
             parameters.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
  write_file(directory / kGlsl, tables.glsl);
  write_file(directory / kHlsl, tables.hlsl);
}

}  // namespace skyfit
