// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "render/features/feature_rows.h"
#include "render/glsl/light_matrices.h"
#include "render/scene/second_light.h"

namespace skyfit {
namespace {

constexpr std::string_view kGroup = "Scene";

using Defines = std::vector<std::string>;
using Json = nlohmann::ordered_json;

Defines second_light_defines(const FeatureShader& shader) {
  const auto light = second_light(shader.options);
  if (!light) return {};
  Defines defined = {"SECOND_SUN"};
  if (light->has_own_color()) {
    const std::array<double, 16> alike = alike_nodes(shader.color, light->rule(shader.color));
    defined.push_back(fmt::format("SECOND_COLOR {:.9g}", fmt::join(alike, ", ")));
  }
  if (light->moon_radius) defined.push_back(fmt::format("MOON_RADIUS {:.9g}", *light->moon_radius));
  return defined;
}

RenderFeature shadows() {
  return with_value(
      [](auto& options) -> auto& { return options.shadows; },
      {.name = "shadows",
       .group = kGroup,
       .options = {{.name = "--shadows",
                    .meaning = "Shadows of the terrain, under each sun, on the ground and in the "
                               "air, and of --clouds in the air",
                    .excludes = {"--overview-m"}}},
       .defines = [](const FeatureShader& shader) {
         Defines defined;
         if (shader.has_shadow_maps) defined.emplace_back("SHADOWS");
         const bool of_clouds = shader.options.shadows && !shader.options.clouds.empty();
         if (of_clouds) defined.emplace_back("CLOUD_SHADOWS");
         return defined;
       }});
}

RenderFeature refraction() {
  return with_value(
      [](auto& options) -> auto& { return options.refraction; },
      {.name = "refraction",
       .group = kGroup,
       .options = {{.name = "--refraction",
                    .meaning = "Ground, horizon and limb stand where air refracts them to, suns' "
                               "discs there and as flat; light falls along straight rays"}},
       .defines = [](const FeatureShader& shader) {
         return shader.options.refraction ? Defines{"REFRACTION"} : Defines{};
       }});
}

RenderFeature clouds() {
  return {
      .name = "clouds",
      .group = kGroup,
      .options = {{.name = "--clouds",
                   .type = "COVER[,ALTITUDE[,OPACITY]]",
                   .meaning = fmt::format(
                       "A sheet of clouds: fraction of the sky, altitude in metres, opacity; may "
                       "be repeated, up to {} sheets of different altitudes, in any order",
                       kMostCloudLayers),
                   .repeats = true}},
      .numbers =
          [](const FrameOptions& options) {
            Json sheets;
            for (const CloudLayer& sheet : options.clouds)
              sheets.push_back({sheet.altitude_m, sheet.cover, sheet.opacity});
            return sheets;
          },
      .defines =
          [](const FeatureShader& shader) {
            const std::size_t sheets = shader.options.clouds.size();
            return sheets > 0 ? Defines{fmt::format("CLOUDS {}", sheets)} : Defines{};
          }};
}

RenderFeature second_sun() {
  return {
      .name = "second_sun",
      .group = kGroup,
      .options = {{.name = "--second-sun",
                   .type = "ZENITH,AZIMUTH,SHARE",
                   .meaning = "Another sun (degrees, from the first) and its share of the first's "
                              "illuminance above the air"},
                  {.name = "--second-sun-temperature-k",
                   .type = "KELVIN",
                   .meaning = "The second sun has the spectrum of a black body, 1000 to 100000 K; "
                              "by default that of the first",
                   .needs = {"--second-sun"},
                   .excludes = {"--second-sun-spectrum"}},
                  {.name = "--second-sun-spectrum",
                   .type = "FILE",
                   .meaning = "The second sun has the spectrum of a CSV with the columns "
                              "wavelength_nm (360 or less to 830 or more) and irradiance_w_m2_nm, "
                              "of which only the form counts",
                   .needs = {"--second-sun"}}},
      .numbers =
          [](const FrameOptions& options) {
            const auto& sun = options.second_sun;
            if (!sun) return Json();
            Json numbers = {sun->zenith, sun->azimuth, sun->irradiance};
            if (sun->spectra) {
              const Spectrum& irradiance = sun->spectra->solar_irradiance;
              numbers.push_back({irradiance.wavelength_nm, irradiance.value});
            }
            return numbers;
          },
      .defines =
          [](const FeatureShader& shader) {
            return shader.options.second_sun ? second_light_defines(shader) : Defines{};
          }};
}

RenderFeature moon() {
  return {
      .name = "moon",
      .group = kGroup,
      .options = {{.name = "--moon",
                   .type = "ZENITH,AZIMUTH[,DISTANCE,RADIUS]",
                   .meaning = "A moon (degrees, from the sun; metres)"},
                  {.name = "--moonlight",
                   .meaning = "The moon lights the scene, by its phase, and is drawn as a disc "
                              "with it; the moon is full opposite to the sun, as --sun-zenith-deg "
                              "130 --moon 50,180",
                   .needs = {"--moon"},
                   .excludes = {"--second-sun"}}},
      .numbers =
          [](const FrameOptions& options) {
            const auto& moon = options.moon;
            if (!moon) return Json();
            return Json{moon->zenith,   moon->azimuth,     moon->distance_m,
                        moon->radius_m, moon->reflectance, moon->lights};
          },
      .defines =
          [](const FeatureShader& shader) {
            const auto& moon = shader.options.moon;
            return moon && moon->lights ? second_light_defines(shader) : Defines{};
          }};
}

RenderFeature wind() {
  const FeatureLimits limits{0, 30, "m/s"};
  return with_value(
      [](auto& options) -> auto& { return options.wind_m_s; },
      {.name = "wind_m_s",
       .group = kGroup,
       .options = {{.name = "--wind-m-s",
                    .type = "SPEED",
                    .meaning =
                        fmt::format("Wind over the sea, 12.5 m above it, {}: how rough the sea is",
                                    limits.text())}},
       .caption = "wind",
       .limits = limits});
}

}  // namespace

std::vector<RenderFeature> scene_features() {
  return {shadows(), refraction(), clouds(), second_sun(), moon(), wind()};
}

}  // namespace skyfit
