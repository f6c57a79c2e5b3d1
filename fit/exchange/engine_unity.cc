// SPDX-License-Identifier: Apache-2.0
// Unity's Physically Based Sky: opacities toward the zenith, altitudes at which 0.1 % of the
// density is left, tints as single scattering albedos, Cornette & Shanks' lobe (Unity Technologies,
// manual of the High Definition Render Pipeline, "Physically Based Sky Volume Override reference").
// It has no absorber but ozone of a fixed layer, which is on.
#include <cmath>
#include <nlohmann/json.hpp>

#include "fit/exchange/engine_files.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kComponent = "PhysicallyBasedSky";
const double kScaleHeights = -std::log(0.001);  // to the maximum altitude

double opacity(double per_m, double scale_height_m) {
  return 1 - std::exp(-per_m * scale_height_m);
}

double coefficient(const PresetReader& sky, std::string_view field, double if_none,
                   double scale_height_m) {
  const double value = number_or(sky, field, if_none);
  if (!(value < 1)) sky.fail_value(field, "an opacity from 0 to 1, 1 not included");
  return -std::log(1 - value) / scale_height_m;
}

}  // namespace

std::string unity_text(const EngineAtmosphere& engine, const ExportFacts& facts) {
  const double air = engine.rayleigh_scale_height_m, aerosol = engine.mie_scale_height_m;
  const double extinction = engine.mie_scattering[1] + engine.mie_absorption[1];
  const double albedo = extinction > 0 ? engine.mie_scattering[1] / extinction : 1;
  Json sky;
  sky["planetaryRadius"] = engine.bottom_radius_m;
  sky["airDensityR"] = opacity(engine.rayleigh_scattering[0], air);
  sky["airDensityG"] = opacity(engine.rayleigh_scattering[1], air);
  sky["airDensityB"] = opacity(engine.rayleigh_scattering[2], air);
  sky["airTint"] = {1, 1, 1};
  sky["airMaximumAltitude"] = kScaleHeights * air;
  sky["aerosolDensity"] = opacity(extinction, aerosol);
  sky["aerosolTint"] = {albedo, albedo, albedo};
  sky["aerosolMaximumAltitude"] = kScaleHeights * aerosol;
  sky["aerosolAnisotropy"] = engine.g;
  sky["groundTint"] = engine.ground_albedo;
  Json json;
  json["skyfit"] = {{"preset", facts.preset}, {"loss", facts.loss}};
  json["PhysicallyBasedSky"] = sky;
  json["DirectionalLight"] = {
      {"rotationX", 90 - facts.sun_zenith * kDegreesPerRadian},
      {"rotationY", facts.sun_azimuth * kDegreesPerRadian - 180},
      {"angularDiameter", 2 * facts.star.angular_radius_rad() * kDegreesPerRadian}};
  return json.dump(2) + "\n";
}

std::optional<EngineAtmosphere> read_unity(std::string_view text, std::string_view source,
                                           std::vector<std::string>& notes) {
  if (text.find('"' + std::string(kComponent) + '"') == text.npos) return {};
  const PresetDocument document(text, source);
  const PresetReader sky = document.root().object(kComponent);
  sky.expect_only({"planetaryRadius", "airDensityR", "airDensityG", "airDensityB", "airTint",
                   "airMaximumAltitude", "aerosolDensity", "aerosolTint", "aerosolMaximumAltitude",
                   "aerosolAnisotropy", "groundTint"});
  EngineAtmosphere engine;
  engine.lobe = PhaseType::kCornetteShanks;
  engine.bottom_radius_m = number_or(sky, "planetaryRadius", 6378759);
  engine.rayleigh_scale_height_m = number_or(sky, "airMaximumAltitude", 55261.973) / kScaleHeights;
  engine.mie_scale_height_m = number_or(sky, "aerosolMaximumAltitude", 8289.296) / kScaleHeights;
  engine.top_radius_m = engine.bottom_radius_m + 100e3;
  const double air = engine.rayleigh_scale_height_m;
  engine.rayleigh_scattering = {coefficient(sky, "airDensityR", 0.04534, air),
                                coefficient(sky, "airDensityG", 0.10237241, air),
                                coefficient(sky, "airDensityB", 0.23264056, air)};
  const double extinction =
      coefficient(sky, "aerosolDensity", 0.01192748, engine.mie_scale_height_m);
  const Rgb tint = rgb_or(sky, "aerosolTint", {0.9, 0.9, 0.9});
  for (std::size_t k = 0; k < 3; ++k) {
    if (tint[k] > 1) sky.fail_value("aerosolTint", "numbers from 0 to 1");
    engine.mie_scattering[k] = extinction * tint[k];
    engine.mie_absorption[k] = extinction * (1 - tint[k]);
  }
  engine.g = number_or(sky, "aerosolAnisotropy", 0.8);
  engine.absorption = kUnityOzone;
  engine.ground_albedo = rgb_or(sky, "groundTint", {0.4, 0.4, 0.4});
  if (rgb_or(sky, "airTint", {1, 1, 1}) != Rgb{1, 1, 1})
    notes.push_back("airTint is not white: air that absorbs is not read");
  return engine;
}

}  // namespace skyfit::fit
