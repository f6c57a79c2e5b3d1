// SPDX-License-Identifier: Apache-2.0
// Unreal's SkyAtmosphere: kilometres, a scale in 1/km times a colour, Henyey & Greenstein's lobe,
// linear sRGB as red, green and blue light. Defaults are those of the component (Epic Games, API
// reference of USkyAtmosphereComponent).
#include <algorithm>
#include <nlohmann/json.hpp>

#include "fit/exchange/engine_files.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMetres = 1000;
constexpr std::string_view kComponent = "SkyAtmosphere";

// A coefficient in 1/m as a scale in 1/km and a colour whose largest channel is 1.
void add_scaled(const char* name, const Rgb& per_m, Json& json) {
  const double scale = std::ranges::max(per_m);
  json[std::string(name) + "Scale"] = kMetres * scale;
  json[name] = Json::array();
  for (const double channel : per_m) json[name].push_back(scale > 0 ? channel / scale : 0);
}

Rgb scaled(const PresetReader& object, const std::string& name, double scale, const Rgb& color) {
  const double per_km = number_or(object, name + "Scale", scale);
  Rgb value = rgb_or(object, name, color);
  for (double& channel : value) channel *= per_km / kMetres;
  return value;
}

}  // namespace

std::string unreal_text(const EngineAtmosphere& engine, const ExportFacts& facts) {
  Json sky;
  sky["BottomRadius"] = engine.bottom_radius_m / kMetres;
  sky["AtmosphereHeight"] = (engine.top_radius_m - engine.bottom_radius_m) / kMetres;
  sky["GroundAlbedo"] = engine.ground_albedo;
  sky["MultiScatteringFactor"] = 1;
  add_scaled("RayleighScattering", engine.rayleigh_scattering, sky);
  sky["RayleighExponentialDistribution"] = engine.rayleigh_scale_height_m / kMetres;
  add_scaled("MieScattering", engine.mie_scattering, sky);
  add_scaled("MieAbsorption", engine.mie_absorption, sky);
  sky["MieAnisotropy"] = engine.g;
  sky["MieExponentialDistribution"] = engine.mie_scale_height_m / kMetres;
  add_scaled("OtherAbsorption", engine.absorption, sky);
  sky["OtherTentDistribution"] = {{"TipAltitude", engine.tent_peak_m / kMetres},
                                  {"TipValue", 1},
                                  {"Width", engine.tent_half_width_m / kMetres}};
  Json json;
  json["skyfit"] = {{"preset", facts.preset}, {"loss", facts.loss}};
  json["SkyAtmosphere"] = sky;
  json["DirectionalLight"] = {
      {"Pitch", facts.sun_zenith * kDegreesPerRadian - 90},
      {"Yaw", facts.sun_azimuth * kDegreesPerRadian - 180},
      {"LightSourceAngle", 2 * facts.star.angular_radius_rad() * kDegreesPerRadian}};
  return json.dump(2) + "\n";
}

std::optional<EngineAtmosphere> read_unreal(std::string_view text, std::string_view source,
                                            std::vector<std::string>& notes) {
  if (text.find('"' + std::string(kComponent) + '"') == text.npos) return {};
  const PresetDocument document(text, source);
  const PresetReader sky = document.root().object(kComponent);
  sky.expect_only({"BottomRadius", "AtmosphereHeight", "GroundAlbedo", "MultiScatteringFactor",
                   "RayleighScatteringScale", "RayleighScattering",
                   "RayleighExponentialDistribution", "MieScatteringScale", "MieScattering",
                   "MieAbsorptionScale", "MieAbsorption", "MieAnisotropy",
                   "MieExponentialDistribution", "OtherAbsorptionScale", "OtherAbsorption",
                   "OtherTentDistribution"});
  EngineAtmosphere engine;
  engine.lobe = PhaseType::kHenyeyGreenstein;
  engine.bottom_radius_m = kMetres * number_or(sky, "BottomRadius", 6360);
  engine.top_radius_m = engine.bottom_radius_m + kMetres * number_or(sky, "AtmosphereHeight", 60);
  engine.ground_albedo = rgb_or(sky, "GroundAlbedo", {0.402, 0.402, 0.402});
  engine.rayleigh_scattering = scaled(sky, "RayleighScattering", 0.0331, {0.175287, 0.409607, 1});
  engine.rayleigh_scale_height_m = kMetres * number_or(sky, "RayleighExponentialDistribution", 8);
  engine.mie_scattering = scaled(sky, "MieScattering", 0.003996, {1, 1, 1});
  engine.mie_absorption = scaled(sky, "MieAbsorption", 0.000444, {1, 1, 1});
  engine.g = number_or(sky, "MieAnisotropy", 0.8);
  engine.mie_scale_height_m = kMetres * number_or(sky, "MieExponentialDistribution", 1.2);
  engine.absorption = scaled(sky, "OtherAbsorption", 0.001881, {0.345561, 1, 0.045189});
  if (sky.has("OtherTentDistribution")) {
    const PresetReader tent = sky.object("OtherTentDistribution");
    tent.expect_only({"TipAltitude", "TipValue", "Width"});
    engine.tent_peak_m = kMetres * number_or(tent, "TipAltitude", 25);
    engine.tent_half_width_m = kMetres * number_or(tent, "Width", 15);
    for (double& channel : engine.absorption) channel *= number_or(tent, "TipValue", 1);
  }
  if (const double factor = number_or(sky, "MultiScatteringFactor", 1); factor != 1)
    notes.push_back("MultiScatteringFactor is not 1: skyfit's multiple scattering has no factor");
  return engine;
}

}  // namespace skyfit::fit
