// SPDX-License-Identifier: Apache-2.0
#include "render/page/sky_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "model/atmosphere/ground_spectrum.h"
#include "model/numerics/angles.h"
#include "model/version.h"
#include "render/glsl/shader_text.h"
#include "render/glsl/table_defines.h"
#include "render/page/changes.h"
#include "render/page/page_tables.h"
#include "render/page/table_packing.h"

namespace skyfit {
namespace {

using nlohmann::json;

// Optical depths are divided into differences, phase functions are steep.
constexpr Packing kDepthPacking{.step = 1.0 / 2048, .logarithm = true, .least = 1e-9};
constexpr Packing kIrradiancePacking{.step = 1.0 / 1024, .logarithm = true, .least = 1e-12};
constexpr Packing kPhasePacking{.step = 1.0 / 1024};
constexpr Packing kChangePacking{.step = 1.0 / 100};

constexpr Packing kScatteringChangePacking{.step = 1.0 / 100, .row = kChangeSizes.scattering_mu_s};

json packed_tables(const AtmosphereTables& tables) {
  return {{"optical_depth", packed(tables.optical_depth, kDepthPacking)},
          {"irradiance", packed(tables.irradiance, kIrradiancePacking)},
          {"rayleigh_like", packed(tables.rayleigh_like, scattering_packing(tables.sizes))},
          {"single", packed(tables.single, scattering_packing(tables.sizes))},
          {"phase", packed(tables.phase, kPhasePacking)}};
}

json packed_change(const AtmosphereTables& change) {
  return {{"optical_depth", packed(change.optical_depth, kChangePacking)},
          {"irradiance", packed(change.irradiance, kChangePacking)},
          {"rayleigh_like", packed(change.rayleigh_like, kScatteringChangePacking)},
          {"single", packed(change.single, kScatteringChangePacking)},
          {"phase", packed(change.phase, kChangePacking)}};
}

// What the shader has besides tables.
json uniforms_of(const AtmosphereTables& tables) {
  json albedo = json::array();
  for (const WavelengthNode& node : tables.color.nodes)
    albedo.push_back(ground_albedo_at(tables.atmosphere, node.wavelength_nm));
  return {{"phase_parameters", phase_parameters(tables.phases)}, {"ground_albedo", albedo}};
}

json slider_json(const SliderTables& tables) {
  const PageSlider& slider = tables.slider;
  const ParameterInfo info = parameter_info(slider.parameter);
  json changes = json::array();
  for (std::size_t i = 0; i < tables.changes.size(); ++i) {
    changes.push_back({{"value", slider.tabulated()[i]},
                       {"tables", packed_change(tables.changes[i])},
                       {"uniforms", uniforms_of(tables.changes[i])}});
  }
  return {{"name", info.name},
          {"meaning", info.meaning},
          {"unit", info.unit},
          {"low", slider.low},
          {"value", slider.value},
          {"high", slider.high},
          {"logarithmic", slider.logarithmic},
          {"sigma", slider.sigma ? json(*slider.sigma) : json()},
          {"error", std::max(tables.tabulated_error, tables.half_way_error)},
          {"changes", changes}};
}

std::string mat3_define(std::string_view name, const std::array<std::array<double, 3>, 3>& rows) {
  std::string text(name);
  for (std::size_t column = 0; column < 3; ++column) {
    for (std::size_t row = 0; row < 3; ++row)
      text += fmt::format("{} {:.9g}", column + row > 0 ? "," : "", rows[row][column]);
  }
  return text;
}

json shaders(const AtmosphereTables& tables) {
  std::vector<std::string> defined = lasting_table_defines(tables);
  defined.insert(defined.end(),
                 {"CHANGES",
                  fmt::format("CHANGE_SIZE {}, {}, {}, {}", kChangeSizes.scattering_mu_s,
                              kChangeSizes.scattering_azimuth, kChangeSizes.scattering_ground,
                              kChangeSizes.scattering_sky),
                  fmt::format("CHANGE_HEIGHTS {}", kChangeSizes.scattering_r),
                  mat3_define("SRGB_FROM_XYZ", kLinearSrgbFromXyz)});
  const auto text = [&](const char* path) {
    return ShaderText(path, ShaderLanguage::kGlslEs300, defined).text();
  };
  return {{"vertex", text("render/page/picture.vert")},
          {"sky", text("render/page/sky.frag")},
          {"display", text("render/page/display.frag")}};
}

json page_data(const SkyPageRequest& request, const PageTables& page) {
  const AtmosphereTables& tables = page.tables;
  const Atmosphere<double>& atmosphere = request.preset.atmosphere;
  json nodes = json::array();
  for (const WavelengthNode& node : tables.color.nodes) {
    nodes.push_back({{"wavelength_nm", node.wavelength_nm},
                     {"irradiance", request.spectra.solar_irradiance.at(node.wavelength_nm)}});
  }
  json errors = json::array();
  for (std::size_t i = 0; i < kComparedAltitudes_m.size(); ++i)
    errors.push_back({{"altitude_m", kComparedAltitudes_m[i]},
                      {"error", page.errors[i].error},
                      {"sun_zenith_deg", page.errors[i].at.sun_zenith / kRadiansPerDegree},
                      {"view_zenith_deg", page.errors[i].at.view_zenith / kRadiansPerDegree},
                      {"azimuth_deg", page.errors[i].at.relative_azimuth / kRadiansPerDegree}});
  json sliders = json::array();
  for (const SliderTables& slider : page.sliders) sliders.push_back(slider_json(slider));
  json uniforms = uniforms_of(tables);
  uniforms["depolarisation"] = tables.phases.depolarisation;
  return {{"preset", {{"name", request.preset.name}, {"note", request.preset.note}}},
          {"version", kVersion},
          {"planet",
           {{"radius_m", atmosphere.bottom_radius_m},
            {"thickness_m", atmosphere.top_radius_m - atmosphere.bottom_radius_m}}},
          {"sun_radius_deg", 0.5 * atmosphere.star.angular_diameter_deg},
          {"nodes", nodes},
          {"xyz_from_nodes", tables.color.xyz_from_nodes},
          {"errors", errors},
          {"uniforms", uniforms},
          {"tables", packed_tables(tables)},
          {"sliders", sliders},
          {"shaders", shaders(tables)}};
}

// Within <script type="application/json">, where only "<" could end it.
std::string in_script(const json& data) {
  std::string text;
  for (const char c : data.dump(-1, ' ', false, json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

// The template's {{name}} by their texts, which are not searched again.
std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string>>& parts) {
  std::string result;
  while (true) {
    const std::size_t open = page.find("{{");
    result += page.substr(0, open);
    if (open == std::string_view::npos) return result;
    const std::size_t close = page.find("}}", open);
    const std::string_view name = page.substr(open + 2, close - open - 2);
    const auto part = std::ranges::find(parts, name, [](const auto& p) { return p.first; });
    if (part == parts.end()) throw std::logic_error(fmt::format("page.html: {}", name));
    result += part->second;
    page.remove_prefix(close + 2);
  }
}

}  // namespace

SkyPage sky_page(const SkyPageRequest& request) {
  const PageTables tables = page_tables(request);
  std::string script;
  // In the order of what they use: one module.
  for (const char* file :
       {"tables.js", "sky.js", "text.js", "controls.js", "sliders.js", "pointer.js", "start.js"})
    script += embedded_shader(std::string("render/page/") + file);
  std::string html =
      filled(embedded_shader("render/page/page.html"),
             {{"name", escaped(request.preset.name)},
              {"version", kVersion},
              {"style", std::string(embedded_shader("render/page/page.css"))},
              {"script", script},
              {"preset", "data:application/json;base64," + base64(preset_to_json(request.preset))},
              {"data", in_script(page_data(request, tables))}});
  if (html.size() > kMostPageBytes) {
    throw std::invalid_argument(
        fmt::format("{}: a page with {} sliders has {:.1f} MB: expected at most {:.0f} MB, which "
                    "fewer sliders give",
                    request.preset.name, request.sliders.size(),
                    1e-6 * static_cast<double>(html.size()), 1e-6 * kMostPageBytes));
  }
  SkyPageErrors errors{tables.errors, {}, {}};
  for (const SliderTables& slider : tables.sliders) {
    errors.tabulated.push_back(slider.tabulated_error);
    errors.half_way.push_back(slider.half_way_error);
  }
  return {std::move(html), errors};
}

}  // namespace skyfit
