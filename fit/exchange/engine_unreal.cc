// SPDX-License-Identifier: Apache-2.0
// Unreal's SkyAtmosphere: kilometres, a scale in 1/km times a colour, Henyey & Greenstein's lobe,
// linear sRGB as red, green and blue light, but the ground's albedo in 8 bit of sRGB. Defaults are
// those of the component (Epic Games, API reference of USkyAtmosphereComponent). Read are JSON and
// the text that the editor copies (T3D: lines NAME=VALUE, what is not there has its default).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "fit/exchange/engine_files.h"
#include "fit/exchange/srgb.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"
#include "model/photometry/srgb_transfer.h"

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

constexpr std::array<std::string_view, 16> kProperties = {"BottomRadius",
                                                          "AtmosphereHeight",
                                                          "GroundAlbedo",
                                                          "MultiScatteringFactor",
                                                          "RayleighScatteringScale",
                                                          "RayleighScattering",
                                                          "RayleighExponentialDistribution",
                                                          "MieScatteringScale",
                                                          "MieScattering",
                                                          "MieAbsorptionScale",
                                                          "MieAbsorption",
                                                          "MieAnisotropy",
                                                          "MieExponentialDistribution",
                                                          "OtherAbsorptionScale",
                                                          "OtherAbsorption",
                                                          "OtherTentDistribution"};
// Of the component, but not of the atmosphere.
constexpr std::array<std::string_view, 10> kOfThePicture = {
    "TransformMode",
    "SkyLuminanceFactor",
    "SkyAndAerialPerspectiveLuminanceFactor",
    "TraceSampleCountScale",
    "HeightFogContribution",
    "AerialPespectiveViewDistanceScale",
    "AerialPerspectiveStartDepth",
    "TransmittanceMinLightElevationAngle",
    "bHoldout",
    "bRenderInMainPass"};

// An array of red, green and blue, or the engine's R, G, B and A.
Rgb color_or(const PresetReader& object, std::string_view field, const Rgb& if_none) {
  if (!object.has_object(field)) return rgb_or(object, field, if_none);
  const PresetReader color = object.object(field);
  color.expect_only({"R", "G", "B", "A"});
  return {number_or(color, "R", 0), number_or(color, "G", 0), number_or(color, "B", 0)};
}

// The ground's, as 0 .. 255 of sRGB where it is the engine's.
Rgb ground_color(const PresetReader& sky) {
  constexpr double kWhite = 255;
  Rgb color = color_or(sky, "GroundAlbedo", {170, 170, 170});
  if (sky.has("GroundAlbedo") && !sky.has_object("GroundAlbedo")) return color;
  for (double& channel : color) {
    if (channel > kWhite) sky.fail_value("GroundAlbedo", "R, G and B from 0 to 255");
    channel = srgb_decoded(channel / kWhite);
  }
  return color;
}

// The value of a line of T3D: (NAME=VALUE,..), a number, or anything else as text.
nlohmann::json t3d_value(std::string_view text) {
  if (text.starts_with('(') && text.ends_with(')')) {
    nlohmann::json object = nlohmann::json::object();
    for (const std::string_view part : split(text.substr(1, text.size() - 2), ',')) {
      const std::size_t equals = part.find('=');
      if (equals == part.npos) return std::string(text);
      object[std::string(part.substr(0, equals))] = t3d_value(part.substr(equals + 1));
    }
    return object;
  }
  const std::string number(text);
  char* end = nullptr;
  const double value = std::strtod(number.c_str(), &end);
  if (number.empty() || *end != '\0') return number;
  return value;
}

// Properties that do not belong to the component, as those of its actor, are left out.
PresetDocument t3d_document(std::string_view text, std::string_view source) {
  const std::string component(kComponent);
  nlohmann::json sky = nlohmann::json::object();
  PresetDocument::Lines lines;
  int number = 0;
  for (const std::string_view row : split(text, '\n')) {
    ++number;
    const std::string_view line = trim(row);
    const std::string name(line.substr(0, line.find('=')));
    if (std::ranges::find(kProperties, name) == kProperties.end() || name.size() == line.size())
      continue;
    sky[name] = t3d_value(line.substr(name.size() + 1));
    lines[component + "." + name] = number;
  }
  return PresetDocument::of_value({{component, sky}}, source, lines);
}

bool is_t3d(std::string_view text) {
  return text.find("SkyAtmosphereComponent") != text.npos && text.find("Begin Object") != text.npos;
}

Rgb scaled(const PresetReader& object, const std::string& name, double scale, const Rgb& color) {
  const double per_km = number_or(object, name + "Scale", scale);
  Rgb value = color_or(object, name, color);
  for (double& channel : value) channel *= per_km / kMetres;
  return value;
}

}  // namespace

std::string unreal_text(const EngineAtmosphere& engine, const ExportFacts& facts) {
  Json sky;
  sky["BottomRadius"] = engine.bottom_radius_m / kMetres;
  sky["AtmosphereHeight"] = (engine.top_radius_m - engine.bottom_radius_m) / kMetres;
  for (std::size_t k = 0; k < 3; ++k)
    sky["GroundAlbedo"][std::string(1, "RGB"[k])] =
        std::lround(255 * srgb_encoded(std::min(engine.ground_albedo[k], 1.0)));
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
  if (!is_t3d(text) && text.find('"' + std::string(kComponent) + '"') == text.npos) return {};
  const PresetDocument document =
      is_t3d(text) ? t3d_document(text, source) : PresetDocument(text, source);
  const PresetReader sky = document.root().object(kComponent);
  std::vector<std::string_view> known(kProperties.begin(), kProperties.end());
  known.insert(known.end(), kOfThePicture.begin(), kOfThePicture.end());
  sky.expect_only(known);
  for (const std::string_view name : kOfThePicture) {
    if (sky.has(name)) notes.push_back(std::string(name) + " is not read: it is not the air's");
  }
  EngineAtmosphere engine;
  engine.lobe = PhaseType::kHenyeyGreenstein;
  engine.bottom_radius_m = kMetres * number_or(sky, "BottomRadius", 6360);
  engine.top_radius_m = engine.bottom_radius_m + kMetres * number_or(sky, "AtmosphereHeight", 60);
  engine.ground_albedo = ground_color(sky);
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
