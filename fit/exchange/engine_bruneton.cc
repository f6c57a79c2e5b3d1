// SPDX-License-Identifier: Apache-2.0
// The arguments of atmosphere::Model (Bruneton 2017, Precomputed Atmospheric Scattering: a New
// Implementation, model.h): metres, 1/m, layers of density with the terms exp_term exp(exp_scale h)
// + linear_term h + constant_term, Cornette & Shanks' lobe.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "fit/exchange/bruneton_textures.h"
#include "fit/exchange/engine_files.h"

namespace skyfit::fit {
namespace {

using Json = nlohmann::ordered_json;

Json layer(double width, double exp_term, double exp_scale, double linear_term,
           double constant_term) {
  return {{"width", width},
          {"exp_term", exp_term},
          {"exp_scale", exp_scale},
          {"linear_term", linear_term},
          {"constant_term", constant_term}};
}

double scale_height(const PresetReader& root, std::string_view field) {
  const std::vector<PresetReader> layers = root.objects(field);
  if (layers.empty()) root.fail_value(field, "at least one layer");
  const PresetReader& last = layers.back();
  if (last.number("exp_term") != 1 || !(last.number("exp_scale") < 0) ||
      last.number("linear_term") != 0 || last.number("constant_term") != 0)
    root.fail_value(field, "the density exp(-h / H), one layer with exp_term 1");
  return -1 / last.number("exp_scale");
}

// Two linear layers, a tent.
void read_tent(const PresetReader& root, EngineAtmosphere& engine) {
  const std::vector<PresetReader> layers = root.objects("absorption_density");
  if (layers.size() != 2) root.fail_value("absorption_density", "two layers, a tent");
  const double slope = layers[0].number("linear_term");
  if (!(slope > 0)) root.fail_value("absorption_density", "a density that rises first");
  engine.tent_peak_m = layers[0].number("width");
  engine.tent_half_width_m = 1 / slope;
}

}  // namespace

std::string bruneton_text(const EngineAtmosphere& engine, const ExportFacts& facts) {
  Json json;
  json["skyfit"] = {{"preset", facts.preset}, {"loss", facts.loss}};
  json["wavelengths"] = kEngineWavelengths_nm;
  json["sun_angular_radius"] = facts.star.angular_radius_rad();
  json["bottom_radius"] = engine.bottom_radius_m;
  json["top_radius"] = engine.top_radius_m;
  json["rayleigh_density"] = Json::array({layer(0, 1, -1 / engine.rayleigh_scale_height_m, 0, 0)});
  json["rayleigh_scattering"] = engine.rayleigh_scattering;
  json["mie_density"] = Json::array({layer(0, 1, -1 / engine.mie_scale_height_m, 0, 0)});
  json["mie_scattering"] = engine.mie_scattering;
  Rgb extinction = engine.mie_scattering;
  for (std::size_t k = 0; k < 3; ++k) extinction[k] += engine.mie_absorption[k];
  json["mie_extinction"] = extinction;
  json["mie_phase_function_g"] = engine.g;
  const double slope = 1 / engine.tent_half_width_m, rise = engine.tent_peak_m * slope;
  json["absorption_density"] = Json::array(
      {layer(engine.tent_peak_m, 0, 0, slope, 1 - rise), layer(0, 0, 0, -slope, 1 + rise)});
  json["absorption_extinction"] = engine.absorption;
  json["ground_albedo"] = engine.ground_albedo;
  json["max_sun_zenith_angle"] = kHighestSun;
  json["length_unit_in_meters"] = 1000;
  return json.dump(2) + "\n";
}

std::optional<EngineAtmosphere> read_bruneton(std::string_view text, std::string_view source,
                                              std::vector<std::string>& notes) {
  if (text.find("\"mie_phase_function_g\"") == text.npos) return {};
  const PresetDocument document(text, source);
  const PresetReader root = document.root();
  const std::vector<double> nm = root.numbers("wavelengths");
  if (!std::ranges::equal(nm, kEngineWavelengths_nm))
    root.fail_value("wavelengths", "[680, 550, 440]");
  EngineAtmosphere engine;
  engine.lobe = PhaseType::kCornetteShanks;
  engine.bottom_radius_m = root.number("bottom_radius");
  engine.top_radius_m = root.number("top_radius");
  engine.rayleigh_scattering = rgb_or(root, "rayleigh_scattering", {});
  engine.rayleigh_scale_height_m = scale_height(root, "rayleigh_density");
  engine.mie_scattering = rgb_or(root, "mie_scattering", {});
  engine.mie_scale_height_m = scale_height(root, "mie_density");
  const Rgb extinction = rgb_or(root, "mie_extinction", engine.mie_scattering);
  for (std::size_t k = 0; k < 3; ++k) {
    if (extinction[k] < engine.mie_scattering[k])
      root.fail_value("mie_extinction", "at least mie_scattering");
    engine.mie_absorption[k] = extinction[k] - engine.mie_scattering[k];
  }
  engine.g = root.number("mie_phase_function_g");
  engine.absorption = rgb_or(root, "absorption_extinction", {});
  if (std::ranges::max(engine.absorption) > 0) read_tent(root, engine);
  engine.ground_albedo = rgb_or(root, "ground_albedo", {});
  if (root.has("solar_irradiance"))
    notes.push_back("solar_irradiance is not read: the star is skyfit's sun");
  return engine;
}

}  // namespace skyfit::fit
