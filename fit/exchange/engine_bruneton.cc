// SPDX-License-Identifier: Apache-2.0
// The arguments of atmosphere::Model (Bruneton 2017, Precomputed Atmospheric Scattering: a New
// Implementation, model.h): metres, 1/m, layers of density with the terms exp_term exp(exp_scale h)
// + linear_term h + constant_term, Cornette & Shanks' lobe, spectra at increasing wavelengths.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
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

// Model takes wavelengths in increasing order: blue, green, red.
Rgb reversed(const Rgb& values) { return {values[2], values[1], values[0]}; }

// One layer, or a second one of no width before it.
double scale_height(const PresetReader& root, std::string_view field) {
  const std::vector<PresetReader> layers = root.objects(field);
  const bool one = layers.size() == 1 || (layers.size() == 2 && layers[0].number("width") == 0);
  if (!one || layers.back().number("exp_term") != 1 || !(layers.back().number("exp_scale") < 0) ||
      layers.back().number("linear_term") != 0 || layers.back().number("constant_term") != 0)
    root.fail_value(field, "the density exp(-h / H), one layer with exp_term 1");
  return -1 / layers.back().number("exp_scale");
}

// Two linear layers, a tent. Its tip need not be 1.
void read_tent(const PresetReader& root, EngineAtmosphere& engine) {
  constexpr std::string_view kField = "absorption_density";
  constexpr double kSame = 1e-4;
  const std::vector<PresetReader> layers = root.objects(kField);
  if (layers.size() != 2) root.fail_value(kField, "two layers, a tent");
  const double width = layers[0].number("width"), slope = layers[0].number("linear_term"),
               tip = slope * width + layers[0].number("constant_term");
  const double falling_tip =
      layers[1].number("linear_term") * width + layers[1].number("constant_term");
  if (layers[0].number("exp_term") != 0 || layers[1].number("exp_term") != 0 || !(slope > 0) ||
      !(tip > 0) || std::abs(layers[1].number("linear_term") / slope + 1) > kSame ||
      std::abs(falling_tip / tip - 1) > kSame)
    root.fail_value(kField,
                    "a tent: a density that rises linearly and falls as steeply from there");
  engine.tent_peak_m = width;
  engine.tent_half_width_m = tip / slope;
  for (double& channel : engine.absorption) channel *= tip;
}

// The spectrum at kEngineWavelengths_nm, linear between its wavelengths and constant beyond them,
// as Model has it; `if_none` where there is no such field.
Rgb spectrum_or(const PresetReader& root, std::string_view field, const std::vector<double>& nm,
                const Rgb& if_none) {
  if (!root.has(field)) return if_none;
  const std::vector<double> values = root.numbers(field);
  if (values.size() != nm.size())
    root.fail_value(field, fmt::format("{} numbers, one for each of wavelengths", nm.size()));
  for (const double value : values) {
    if (!std::isfinite(value) || value < 0) root.fail_value(field, "numbers >= 0");
  }
  const Spectrum spectrum{nm, values};
  Rgb rgb;
  for (std::size_t k = 0; k < 3; ++k)
    rgb[k] = spectrum.at(std::clamp(kEngineWavelengths_nm[k], nm.front(), nm.back()));
  return rgb;
}

std::vector<double> wavelengths(const PresetReader& root) {
  std::vector<double> nm = root.numbers("wavelengths");
  if (nm.empty() || !(nm.front() > 0) || !std::isfinite(nm.back()) ||
      std::ranges::adjacent_find(nm, std::ranges::greater_equal{}) != nm.end())
    root.fail_value("wavelengths", "increasing numbers, nm");
  return nm;
}

}  // namespace

std::string bruneton_text(const EngineAtmosphere& engine, const ExportFacts& facts) {
  Json json;
  json["skyfit"] = {{"preset", facts.preset}, {"loss", facts.loss}};
  json["wavelengths"] = reversed(kEngineWavelengths_nm);
  json["sun_angular_radius"] = facts.star.angular_radius_rad();
  json["bottom_radius"] = engine.bottom_radius_m;
  json["top_radius"] = engine.top_radius_m;
  json["rayleigh_density"] = Json::array({layer(0, 1, -1 / engine.rayleigh_scale_height_m, 0, 0)});
  json["rayleigh_scattering"] = reversed(engine.rayleigh_scattering);
  json["mie_density"] = Json::array({layer(0, 1, -1 / engine.mie_scale_height_m, 0, 0)});
  json["mie_scattering"] = reversed(engine.mie_scattering);
  Rgb extinction = engine.mie_scattering;
  for (std::size_t k = 0; k < 3; ++k) extinction[k] += engine.mie_absorption[k];
  json["mie_extinction"] = reversed(extinction);
  json["mie_phase_function_g"] = engine.g;
  const double slope = 1 / engine.tent_half_width_m, rise = engine.tent_peak_m * slope;
  json["absorption_density"] = Json::array(
      {layer(engine.tent_peak_m, 0, 0, slope, 1 - rise), layer(0, 0, 0, -slope, 1 + rise)});
  json["absorption_extinction"] = reversed(engine.absorption);
  json["ground_albedo"] = reversed(engine.ground_albedo);
  json["max_sun_zenith_angle"] = kHighestSun;
  json["length_unit_in_meters"] = 1000;
  return json.dump(2) + "\n";
}

std::optional<EngineAtmosphere> read_bruneton(std::string_view text, std::string_view source,
                                              std::vector<std::string>& notes) {
  if (text.find("\"mie_phase_function_g\"") == text.npos) return {};
  const PresetDocument document(text, source);
  const PresetReader root = document.root();
  root.expect_only({"skyfit",
                    "wavelengths",
                    "solar_irradiance",
                    "sun_angular_radius",
                    "bottom_radius",
                    "top_radius",
                    "rayleigh_density",
                    "rayleigh_scattering",
                    "mie_density",
                    "mie_scattering",
                    "mie_extinction",
                    "mie_phase_function_g",
                    "absorption_density",
                    "absorption_extinction",
                    "ground_albedo",
                    "max_sun_zenith_angle",
                    "length_unit_in_meters",
                    "num_precomputed_wavelengths",
                    "combine_scattering_textures",
                    "half_precision"});
  const std::vector<double> nm = wavelengths(root);
  EngineAtmosphere engine;
  engine.lobe = PhaseType::kCornetteShanks;
  engine.bottom_radius_m = root.number("bottom_radius");
  engine.top_radius_m = root.number("top_radius");
  engine.rayleigh_scattering = spectrum_or(root, "rayleigh_scattering", nm, {});
  engine.rayleigh_scale_height_m = scale_height(root, "rayleigh_density");
  engine.mie_scattering = spectrum_or(root, "mie_scattering", nm, {});
  engine.mie_scale_height_m = scale_height(root, "mie_density");
  const Rgb extinction = spectrum_or(root, "mie_extinction", nm, engine.mie_scattering);
  for (std::size_t k = 0; k < 3; ++k) {
    if (extinction[k] < engine.mie_scattering[k])
      root.fail_value("mie_extinction", "at least mie_scattering");
    engine.mie_absorption[k] = extinction[k] - engine.mie_scattering[k];
  }
  engine.g = root.number("mie_phase_function_g");
  engine.absorption = spectrum_or(root, "absorption_extinction", nm, {});
  if (std::ranges::max(engine.absorption) > 0) read_tent(root, engine);
  engine.ground_albedo = spectrum_or(root, "ground_albedo", nm, {});
  if (root.has("solar_irradiance"))
    notes.push_back("solar_irradiance is not read: the star is skyfit's sun");
  const double sun = Star{}.angular_radius_rad();
  if (std::abs(number_or(root, "sun_angular_radius", sun) / sun - 1) > 0.02)
    notes.push_back("sun_angular_radius is not read: the star is skyfit's sun");
  return engine;
}

}  // namespace skyfit::fit
