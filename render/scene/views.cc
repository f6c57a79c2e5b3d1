// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "model/numerics/angles.h"
#include "render/features/render_features.h"
#include "render/render.h"
#include "render/sky_map/mapped_frame.h"

namespace skyfit {
namespace {

constexpr std::array<NamedView, 8> kViews = {{
    {"ground",
     {2, 76 * kRadiansPerDegree, 0, 65 * kRadiansPerDegree},
     40 * kRadiansPerDegree,
     {},
     "2 m above a plain, toward the sun, about noon"},
    {"sunset",
     {2, 84 * kRadiansPerDegree, 0, 45 * kRadiansPerDegree},
     88 * kRadiansPerDegree,
     {},
     "2 m above a plain, toward a low sun"},
    {"away",
     {2, 80 * kRadiansPerDegree, 180 * kRadiansPerDegree, 60 * kRadiansPerDegree},
     75 * kRadiansPerDegree,
     {},
     "2 m above a plain, away from the sun"},
    {"valley",
     {350, 94 * kRadiansPerDegree, -100 * kRadiansPerDegree, 60 * kRadiansPerDegree},
     62 * kRadiansPerDegree,
     Site{-1.24989, -1.34078, 100 * kRadiansPerDegree},
     "in the mountains, along a valley"},
    {"10km",
     {10e3, 95 * kRadiansPerDegree, -80 * kRadiansPerDegree, 60 * kRadiansPerDegree},
     60 * kRadiansPerDegree,
     {},
     "from 10 km, over the mountains"},
    {"orbit",
     {400e3, 125 * kRadiansPerDegree, 150 * kRadiansPerDegree, 50 * kRadiansPerDegree},
     50 * kRadiansPerDegree,
     {},
     "from 400 km, down to the ground"},
    {"limb",
     {400e3, 106 * kRadiansPerDegree, -100 * kRadiansPerDegree, 40 * kRadiansPerDegree},
     70 * kRadiansPerDegree,
     {},
     "from 400 km, the planet's limb"},
    {"space",
     {11e6, 180 * kRadiansPerDegree, 90 * kRadiansPerDegree, 50 * kRadiansPerDegree},
     45 * kRadiansPerDegree,
     {},
     "from 11 000 km, the full disc"},
}};

constexpr int kMaxSide = 16384;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 26;
constexpr double kMaxLength = 1e12;                              // m
const double kWidestMoonDisc = std::sin(5 * kRadiansPerDegree);  // radius over distance
constexpr double kLeastBetweenClouds = 1;  // m: two sheets at one height have no order

void require(bool good, std::string_view name, double value, std::string_view expected) {
  if (!good)
    throw std::invalid_argument(
        fmt::format("render.{} = {:.9g}: must be {}", name, value, expected));
}

bool within(double value, double low, double high) { return value >= low && value <= high; }

// A zenith angle, and the azimuth that belongs to it.
void require_direction(std::string_view name, double zenith, double azimuth) {
  require(within(zenith, 0, std::numbers::pi), fmt::format("{}.zenith", name), zenith,
          "0 to 180 degrees in radians");
  require(std::isfinite(azimuth), fmt::format("{}.azimuth", name), azimuth, "finite");
}

void require_place(std::string_view name, double latitude, double longitude) {
  require(std::abs(latitude) <= std::numbers::pi / 2, fmt::format("{}.latitude", name), latitude,
          "-90 to 90 degrees in radians");
  require(std::abs(longitude) <= 2 * std::numbers::pi, fmt::format("{}.longitude", name), longitude,
          "-360 to 360 degrees in radians");
}

void require_material(std::string_view name, const OwnMaterial& material, const Scene& scene) {
  const auto expected = fmt::format("{:.9g} to {:.9g} m", kShortestRepeat, kLongestRepeat);
  require(within(material.near_m, kShortestRepeat, kLongestRepeat), fmt::format("{}.near_m", name),
          material.near_m, expected);
  require(within(material.far_m, kShortestRepeat, kLongestRepeat), fmt::format("{}.far_m", name),
          material.far_m, expected);
  if (!material.color.empty() && !scene.color_map.empty())
    throw std::invalid_argument(fmt::format(
        "render.{}.color = {}: must be none with a color_map, which has the ground's colours", name,
        material.color.string()));
}

void require_clouds(std::span<const CloudLayer> sheets) {
  require(sheets.size() <= kMostCloudLayers, "clouds, sheets", static_cast<double>(sheets.size()),
          fmt::format("at most {}", kMostCloudLayers));
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const CloudLayer& clouds = sheets[i];
    require(within(clouds.altitude_m, 1, 1e5), "clouds.altitude_m", clouds.altitude_m,
            "1 to 1e5 m");
    require(within(clouds.cover, 0, 1), "clouds.cover", clouds.cover, "0 to 1");
    require(within(clouds.opacity, 0, 1), "clouds.opacity", clouds.opacity, "0 to 1");
    for (const CloudLayer& before : sheets.first(i))
      require(std::abs(clouds.altitude_m - before.altitude_m) >= kLeastBetweenClouds,
              "clouds.altitude_m", clouds.altitude_m,
              fmt::format("at least {} m from that of every other sheet", kLeastBetweenClouds));
  }
}

}  // namespace

std::span<const NamedView> named_views() { return kViews; }

const NamedView& find_view(std::string_view name) {
  std::string known;
  for (const NamedView& view : kViews) {
    if (view.name == name) return view;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", view.name);
  }
  throw std::invalid_argument(fmt::format("view \"{}\": expected one of {}", name, known));
}

void validate(const FrameOptions& options) {
  const Camera& camera = options.camera;
  require(within(options.width, 1, kMaxSide), "width", options.width, "1 to 16384 pixels");
  require(within(options.height, 1, kMaxSide), "height", options.height, "1 to 16384 pixels");
  const std::int64_t pixels = std::int64_t{options.width} * options.height;
  require(pixels <= kMaxPixels, "width * height", static_cast<double>(pixels),
          "at most 67108864 pixels");
  require(within(options.samples_per_side, 1, 4), "samples_per_side", options.samples_per_side,
          "1 to 4");
  require(within(options.samples_per_quad, 1, 64), "samples_per_quad", options.samples_per_quad,
          "1 to 64");
  for (const RenderFeature& feature : render_features()) {
    if (!feature.limits) continue;
    if (const auto value = feature.get(options))
      require(feature.limits->hold(*value), feature.name, *value, feature.limits->text());
  }
  if (options.terrain.eye && options.shadows)
    throw std::invalid_argument("render.shadows = true: must be false with a terrain.eye");
  // That it is above the ground is known where there is a ground.
  require(within(camera.altitude_m, -1e5, 1e9), "camera.altitude_m", camera.altitude_m,
          "-1e5 to 1e9 m");
  require(within(camera.view_zenith, 0, std::numbers::pi), "camera.view_zenith", camera.view_zenith,
          "0 to pi");
  require(std::isfinite(camera.azimuth), "camera.azimuth", camera.azimuth, "finite");
  if (projection_of(options) == nullptr) {
    require(within(camera.vertical_fov, kRadiansPerDegree, 150 * kRadiansPerDegree),
            "camera.vertical_fov", camera.vertical_fov, "1 to 150 degrees in radians");
  } else if (options.terrain.eye) {
    throw std::invalid_argument("render.projection: must be perspective with a terrain.eye");
  }
  require(within(options.sun_zenith, 0, std::numbers::pi), "sun_zenith", options.sun_zenith,
          "0 to pi");
  if (options.site) {
    require_place("site", options.site->latitude, options.site->longitude);
    require(std::isfinite(options.site->sun_azimuth), "site.sun_azimuth", options.site->sun_azimuth,
            "finite");
  }
  if (const auto& sun = options.second_sun) {
    require_direction("second_sun", sun->zenith, sun->azimuth);
    require(within(sun->irradiance, 0, 1e3), "second_sun.irradiance", sun->irradiance,
            "0 to 1000 of the first sun's");
    if (options.moon && options.moon->lights)
      throw std::invalid_argument("render.moon.lights = true: must be false with a second_sun");
  }
  if (const auto& moon = options.moon) {
    require_direction("moon", moon->zenith, moon->azimuth);
    require(within(moon->radius_m, 1, kMaxLength), "moon.radius_m", moon->radius_m, "1 to 1e12 m");
    require(moon->distance_m > moon->radius_m && moon->distance_m <= kMaxLength, "moon.distance_m",
            moon->distance_m, "more than its radius and at most 1e12 m");
    require(within(moon->reflectance, 0, 1), "moon.reflectance", moon->reflectance, "0 to 1");
    if (moon->lights)
      require(moon->radius_m <= kWidestMoonDisc * moon->distance_m, "moon.radius_m", moon->radius_m,
              "that of a disc of at most 10 degrees, where the moon lights");
  }
  require_clouds(options.clouds);
}

void validate(const Scene& scene) {
  constexpr double kHighest = 1e5;  // m
  require_material("soil", scene.soil, scene);
  require_material("rock", scene.rock, scene);
  require(within(scene.lowest_m, -kHighest, kHighest), "lowest_m", scene.lowest_m, "-1e5 to 1e5 m");
  require(scene.highest_m > scene.lowest_m && scene.highest_m <= kHighest, "highest_m",
          scene.highest_m, "more than lowest_m and at most 1e5 m");
  require(within(scene.water_level_m, -kHighest, kHighest), "water_level_m", scene.water_level_m,
          "-1e5 to 1e5 m");
  if (scene.dem_edge_m)
    require(within(*scene.dem_edge_m, 0, 1e7), "dem_edge_m", *scene.dem_edge_m, "0 to 1e7 m");
  for (const RegionalDem& dem : scene.dems) {
    require(dem.band >= 0, "dem.band", dem.band, "0 or more");
    require(within(dem.zero_m, -kHighest, kHighest), "dem.zero_m", dem.zero_m, "-1e5 to 1e5 m");
  }
  for (const PlacedMesh& mesh : scene.meshes) {
    require_place("mesh", mesh.latitude, mesh.longitude);
    require(within(mesh.altitude_m, 0, 1e9), "mesh.altitude_m", mesh.altitude_m, "0 to 1e9 m");
    require(std::isfinite(mesh.heading), "mesh.heading", mesh.heading, "finite");
    require(within(mesh.scale, 1e-6, 1e9), "mesh.scale", mesh.scale, "1e-6 to 1e9");
    require(within(mesh.reflectance, 0, 1), "mesh.reflectance", mesh.reflectance, "0 to 1");
  }
}

}  // namespace skyfit
