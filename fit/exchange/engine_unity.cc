// SPDX-License-Identifier: Apache-2.0
// Unity's Physically Based Sky, type Custom Planet, of HDRP 17: opacities toward the zenith,
// altitudes at which 0.1 % of the density is left, tints as single scattering albedos, Cornette &
// Shanks' lobe, ozone of a fixed spectrum in a tent (Unity Technologies, Graphics,
// com.unity.render-pipelines.high-definition, PhysicallyBasedSky.cs, and the manual's "Physically
// Based Sky Volume Override reference"). The planet's radius is that of the Visual Environment.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "fit/exchange/engine_files.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kComponent = "PhysicallyBasedSky";
const double kScaleHeights = -std::log(0.001);  // to the maximum altitude
// Absorption at the tip of the layer, 1/m, of ozoneDensityDimmer 1, its most.
constexpr Rgb kOzone = {0.65e-6, 1.88e-6, 0.08e-6};
constexpr double kEarthRadius = 6.3781e6;
// Of the types for the Earth, whatever the air's values are.
constexpr Rgb kEarthAir = {5.8e-6, 13.5e-6, 33.1e-6};
constexpr double kEarthAirHeight = 8000, kEarthAerosolHeight = 1200, kEarthOzoneBase = 20e3,
                 kEarthOzoneWidth = 20e3, kKilometre = 1000;

double opacity(double per_m, double scale_height_m) {
  return 1 - std::exp(-per_m * scale_height_m);
}

// `if_none`: the coefficient where the field is missing.
double coefficient(const PresetReader& sky, std::string_view field, double if_none,
                   double scale_height_m) {
  if (!sky.has(field)) return if_none;
  const double value = number_or(sky, field, 0);
  if (!(value < 1)) sky.fail_value(field, "an opacity from 0 to 1, 1 not included");
  return -std::log(1 - value) / scale_height_m;
}

}  // namespace

// Its aerosol is grey.
void restrict_to_unity(EngineAtmosphere& engine) {
  const double extinction = engine.mie_scattering[1] + engine.mie_absorption[1],
               scattering = engine.mie_scattering[1];
  engine.mie_scattering.fill(scattering);
  engine.mie_absorption.fill(extinction - scattering);
  const double ozone = std::min(engine.absorption[1] / kOzone[1], 1.0);
  for (std::size_t k = 0; k < 3; ++k) engine.absorption[k] = ozone * kOzone[k];
  // The layer begins at the ground or above it.
  engine.tent_half_width_m = std::min(engine.tent_half_width_m, engine.tent_peak_m);
}

std::string unity_text(const EngineAtmosphere& engine, const ExportFacts& facts) {
  const double air = engine.rayleigh_scale_height_m, aerosol = engine.mie_scale_height_m;
  const double extinction = engine.mie_scattering[1] + engine.mie_absorption[1];
  const double albedo = extinction > 0 ? engine.mie_scattering[1] / extinction : 1;
  Json sky;
  sky["type"] = "Custom";
  sky["airDensityR"] = opacity(engine.rayleigh_scattering[0], air);
  sky["airDensityG"] = opacity(engine.rayleigh_scattering[1], air);
  sky["airDensityB"] = opacity(engine.rayleigh_scattering[2], air);
  sky["airTint"] = {1, 1, 1};
  sky["airMaximumAltitude"] = kScaleHeights * air;
  sky["aerosolDensity"] = opacity(extinction, aerosol);
  sky["aerosolTint"] = {albedo, albedo, albedo};
  sky["aerosolMaximumAltitude"] = kScaleHeights * aerosol;
  sky["aerosolAnisotropy"] = engine.g;
  sky["ozoneDensityDimmer"] = engine.absorption[1] / kOzone[1];
  sky["ozoneMinimumAltitude"] = engine.tent_peak_m - engine.tent_half_width_m;
  sky["ozoneLayerWidth"] = 2 * engine.tent_half_width_m;
  sky["groundTint"] = engine.ground_albedo;
  Json json;
  json["skyfit"] = {{"preset", facts.preset}, {"loss", facts.loss}};
  json["PhysicallyBasedSky"] = sky;
  json["VisualEnvironment"] = {{"planetRadius", engine.bottom_radius_m / kKilometre}};
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
  const PresetReader root = document.root(), sky = root.object(kComponent);
  sky.expect_only({"type", "planetaryRadius", "airDensityR", "airDensityG", "airDensityB",
                   "airTint", "airMaximumAltitude", "aerosolDensity", "aerosolTint",
                   "aerosolMaximumAltitude", "aerosolAnisotropy", "ozoneDensityDimmer",
                   "ozoneMinimumAltitude", "ozoneLayerWidth", "groundTint"});
  const std::string type = sky.has("type") ? sky.text("type") : "Custom";
  if (type != "Custom" && type != "EarthAdvanced" && type != "EarthSimple")
    sky.fail_value("type", "Custom, EarthAdvanced or EarthSimple");
  const bool custom = type == "Custom", simple = type == "EarthSimple";
  EngineAtmosphere engine;
  engine.lobe = PhaseType::kCornetteShanks;
  engine.bottom_radius_m = number_or(sky, "planetaryRadius", kEarthRadius);
  if (root.has("VisualEnvironment")) {
    engine.bottom_radius_m = kKilometre * number_or(root.object("VisualEnvironment"),
                                                    "planetRadius", kEarthRadius / kKilometre);
  }
  engine.top_radius_m = engine.bottom_radius_m + 100e3;
  const auto altitude = [&](bool own, std::string_view field, double scale_height_m) {
    return own ? number_or(sky, field, kScaleHeights * scale_height_m) / kScaleHeights
               : scale_height_m;
  };
  engine.rayleigh_scale_height_m = altitude(custom, "airMaximumAltitude", kEarthAirHeight);
  engine.mie_scale_height_m = altitude(!simple, "aerosolMaximumAltitude", kEarthAerosolHeight);
  engine.rayleigh_scattering = kEarthAir;
  if (custom) {
    const double height = engine.rayleigh_scale_height_m;
    engine.rayleigh_scattering = {coefficient(sky, "airDensityR", kEarthAir[0], height),
                                  coefficient(sky, "airDensityG", kEarthAir[1], height),
                                  coefficient(sky, "airDensityB", kEarthAir[2], height)};
  } else {
    notes.push_back("type is " + type + ": its air and ozone layer are the program's own");
  }
  const double extinction = coefficient(sky, "aerosolDensity", 10e-6, engine.mie_scale_height_m);
  const Rgb tint = rgb_or(sky, "aerosolTint", {0.9, 0.9, 0.9});
  for (std::size_t k = 0; k < 3; ++k) {
    if (tint[k] > 1) sky.fail_value("aerosolTint", "numbers from 0 to 1");
    engine.mie_scattering[k] = extinction * tint[k];
    engine.mie_absorption[k] = extinction * (1 - tint[k]);
  }
  engine.g = sky.has("aerosolAnisotropy") ? sky.number("aerosolAnisotropy") : 0.8;
  const double dimmer = simple ? 1 : number_or(sky, "ozoneDensityDimmer", 1);
  for (std::size_t k = 0; k < 3; ++k) engine.absorption[k] = dimmer * kOzone[k];
  const double base = custom ? number_or(sky, "ozoneMinimumAltitude", kEarthOzoneBase)
                             : kEarthOzoneBase,
               width =
                   custom ? number_or(sky, "ozoneLayerWidth", kEarthOzoneWidth) : kEarthOzoneWidth;
  engine.tent_half_width_m = 0.5 * width;
  engine.tent_peak_m = base + 0.5 * width;
  engine.ground_albedo = rgb_or(sky, "groundTint", {0.12, 0.10, 0.09});
  if (rgb_or(sky, "airTint", {1, 1, 1}) != Rgb{1, 1, 1})
    notes.push_back("airTint is not white: air that absorbs is not read");
  return engine;
}

}  // namespace skyfit::fit
