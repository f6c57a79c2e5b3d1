// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/relief.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "render/gl/terrain/blend.h"
#include "render/gl/terrain/noise.h"

namespace skyfit {
namespace {

constexpr double kEarthRadius = 6360e3;
// Two scales of mountains: 400 and 2500 cycles per radius.
constexpr double kMountainHeight = 3250, kMountainLength = kEarthRadius / 400;
constexpr double kCragHeight = 750, kCragLength = kEarthRadius / 2500;
constexpr double kHillHeight = 260;
constexpr double kPlainHeight = 25;
constexpr double kRoughness = 0.12;  // of the plain at the site
constexpr double kShore = 0.0015;    // of land_value(): a coast some 8 km wide
constexpr double kShoreRise = 25;    // m of above_water_m over it
constexpr double kBoulder = 3.2, kBoulderHeight = 0.35;
constexpr double kSpots = 1500;
constexpr double kFinest = 0.1;  // no detail below, m

// Reflectances at about 440, 510, 560 and 630 nm of light that comes out of clear sea water; what
// its surface reflects is added in surface_light.glsl.
constexpr NodeValues kSea = {0.038, 0.020, 0.009, 0.004};
// Relative reflectances of land; only their ratios matter.
constexpr NodeValues kGrass = {0.32, 0.52, 0.86, 0.64};
constexpr NodeValues kSteppe = {0.58, 0.84, 1.10, 1.28};
constexpr NodeValues kRock = {0.66, 0.74, 0.80, 0.84};
constexpr NodeValues kSnow = {2.6, 2.6, 2.57, 2.55};

// The ranges do not follow the lattice of the noise.
glm::dvec3 bend(const glm::dvec3& p) {
  constexpr double kLength = 55e3, kStrength = 14e3;
  const glm::dvec3 q = p / kLength;
  return kStrength *
         gradient_noises({q, q + glm::dvec3(17.3, 5.1, 9.7), q + glm::dvec3(3.9, 31.7, 12.2)});
}

double land_value(const glm::dvec3& p, double resolution) {
  return fractal_noise(p + glm::dvec3(1.7e6), 5.2e6, std::max(resolution, 500.0)) - 0.02;
}

// How much of its relief the ground of a dry planet has: basins are smoother than the land.
double basin(double continent) { return 0.35 + 0.65 * smoothstep(-0.15, 0.15, continent); }

glm::dvec3 fibonacci_direction(int index, int count) {
  const double z = 1 - (2 * index + 1.0) / count;
  const double turn = index * std::numbers::pi * (3 - std::sqrt(5.0));
  const double s = std::sqrt(1 - z * z);
  return {s * std::cos(turn), s * std::sin(turn), z};
}

}  // namespace

Relief::Relief(double bottom_radius_m, const NodeValues& ground_albedo, bool sea)
    : radius_m_(bottom_radius_m),
      albedo_(ground_albedo),
      sea_(sea),
      scale_(bottom_radius_m / kEarthRadius) {
  settle_on_a_coast();
  balance_materials();
}

// The site stands where the land behind it and the sea before it differ most; the sun's azimuth is
// that of the water.
void Relief::settle_on_a_coast() {
  constexpr int kCandidates = 3000;
  constexpr double kCoarse = 60e3, kFine = 500;
  const auto value = [](const glm::dvec3& direction, double resolution) {
    return land_value(glm::normalize(direction) * kEarthRadius, resolution);
  };
  const auto ahead = [](const glm::dvec3& from, const glm::dvec3& toward, double distance) {
    return glm::normalize(from + distance / kEarthRadius * toward);
  };
  double best = -1;
  for (int i = 0; i < kCandidates; ++i) {
    const glm::dvec3 here = fibonacci_direction(i, kCandidates);
    if (std::abs(value(here, kCoarse)) > 0.03) continue;
    const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3(0.31, 0.17, 0.93), here));
    const glm::dvec3 north = glm::cross(here, east);
    const auto slope = [&](const glm::dvec3& way) {
      return value(ahead(here, way, 100e3), kCoarse) - value(ahead(here, way, -100e3), kCoarse);
    };
    const glm::dvec3 downhill = -glm::normalize(east * slope(east) + north * slope(north));
    const double sea = std::max(value(ahead(here, downhill, 200e3), kCoarse),
                                value(ahead(here, downhill, 500e3), kCoarse));
    const double score = value(ahead(here, downhill, -200e3), kCoarse) - sea;
    if (score <= best) continue;
    best = score;
    coast_.z = here;
    coast_.x = downhill;
  }
  // Along that line to the shore itself.
  double inland = -250e3, offshore = 250e3;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (inland + offshore);
    (value(ahead(coast_.z, coast_.x, middle), kFine) > 0.5 * kShore ? inland : offshore) = middle;
  }
  coast_.z = ahead(coast_.z, coast_.x, inland);
  coast_.x = glm::normalize(coast_.x - glm::dot(coast_.x, coast_.z) * coast_.z);
  coast_.y = glm::cross(coast_.z, coast_.x);
  // Not straight over the water: the coast runs into the picture.
  constexpr double kTurn = 0.8;
  const glm::dvec3 seaward = coast_.x;
  coast_.x = std::cos(kTurn) * seaward + std::sin(kTurn) * coast_.y;
  coast_.y = glm::cross(coast_.z, coast_.x);
}

Elevation Relief::elevation(const glm::dvec3& direction, double resolution_m) const {
  const double resolution = std::max(resolution_m / scale_, kFinest);
  const glm::dvec3 p = direction * kEarthRadius;
  const double distance = glm::length(direction - coast_.z) * kEarthRadius;
  const double near_site = 1 - smoothstep(80e3, 400e3, distance);
  const double beach = 1 - smoothstep(300, 600, distance);
  const double continent = land_value(p, resolution);
  const double above_water =
      sea_ ? kShoreRise * std::max(continent / kShore, 2 * beach - 1) : kMountainHeight;
  if (above_water <= 0) return {0, above_water};
  const double land = sea_ ? smoothstep(0, 2 * kShore, continent) : basin(continent);
  const double fading = smoothstep(200, 5e3, distance);
  double roughness = kRoughness * (1 + fractal_noise(p, 9, resolution));
  if (resolution < kBoulder) {
    // Boulders: where the noise is high, it breaks through the ground.
    const double stone = fractal_noise(p + glm::dvec3(31), kBoulder, resolution);
    roughness += 0.55 * kBoulderHeight * smoothstep(0.42, 0.62, stone) +
                 kBoulderHeight * std::max(stone - 0.5, 0.0);
  }
  const double range = fractal_noise(p + glm::dvec3(0, 9e6, 0), 1.3e6, std::max(resolution, 1e4));
  const double mountains = std::max(smoothstep(-0.02, 0.6, range), 0.75 * near_site);
  const glm::dvec3 bent = p + bend(p);
  const double massif =
      smoothstep(-0.6, 0.7, fractal_noise(bent + glm::dvec3(6e5), 70e3, std::max(resolution, 2e3)));
  double height = kPlainHeight * (1 + fractal_noise(p, 30e3, resolution));
  height += kHillHeight * (0.6 + fractal_noise(bent + glm::dvec3(4e5), 7e3, resolution));
  height += kMountainHeight * mountains * massif *
            ridged_noise(bent, kMountainLength, std::max(resolution, 2 * resolution - 6e3));
  height += kCragHeight * (0.3 + mountains) *
            ridged_noise(bent + glm::dvec3(9e5), kCragLength, resolution);
  return {std::max(fading * land * height, 0.0) +
              roughness *
                  (sea_ ? std::max(smoothstep(0, 0.1 * kShore, continent), 2 * beach - 1) : 1.0),
          above_water};
}

NodeValues Relief::material(const glm::dvec3& direction, double height_m, double steepness,
                            double resolution_m) const {
  if (!sea_) return dry_material(direction, steepness, resolution_m);
  const double resolution = std::max(resolution_m / scale_, kFinest);
  const glm::dvec3 p = direction * kEarthRadius;
  const double patches =
      fractal_noise(p + glm::dvec3(2e5, 0, 7e5), 2.4e6, std::max(resolution, 8e3));
  const double spots = fractal_noise(p, kSpots, resolution);
  const double grain = fractal_noise(p + glm::dvec3(50), 3, resolution);
  // Where a vertex stands for a whole mountain, the lines between the materials are as wide as its
  // height.
  const double blur = kMountainHeight * 0.3 * std::min(resolution / 15e3, 1.0);
  NodeValues soil =
      mix(kGrass, kSteppe, smoothstep(-0.2, 0.7, patches + 0.5 * spots + 0.3 * grain));
  soil = mix(soil, kRock, smoothstep(900 - blur, 1900 + blur, height_m + 500 * spots));
  soil = mix(soil, kRock, smoothstep(0.04, 0.14, steepness));
  // The crests beside a vertex are higher than what it stands for.
  const double crests = std::min(0.2 * resolution, 400.0);
  const double snow = smoothstep(2100 - blur, 2700 + blur, height_m + crests + 500 * spots);
  soil = mix(soil, kSnow, snow * (1 - smoothstep(0.12, 0.35, steepness)));
  for (double& value : soil) value *= std::max(1 + 0.4 * grain + 0.15 * spots, 0.2);
  return soil;
}

// Dust, thinner on slopes, over rock: one colour, lighter and darker.
NodeValues Relief::dry_material(const glm::dvec3& direction, double steepness,
                                double resolution_m) const {
  const double resolution = std::max(resolution_m / scale_, kFinest);
  const glm::dvec3 p = direction * kEarthRadius;
  const double patches =
      fractal_noise(p + glm::dvec3(2e5, 0, 7e5), 2.4e6, std::max(resolution, 8e3));
  const double spots = fractal_noise(p, kSpots, resolution);
  const double grain = fractal_noise(p + glm::dvec3(50), 3, resolution);
  double value = 1 + 0.25 * patches + 0.1 * spots + 0.25 * grain;
  value *= 1 - 0.3 * smoothstep(0.03, 0.12, steepness);
  value = std::max(value, 0.2);
  return {value, value, value, value};
}

NodeValues Relief::reflectance(const glm::dvec3& direction, double height_m, double steepness,
                               double resolution_m) const {
  return reflectance_of(material(direction, height_m, steepness, resolution_m));
}

NodeValues Relief::reflectance_of(const NodeValues& material) const {
  NodeValues land;
  for (std::size_t k = 0; k < 4; ++k) land[k] = std::min(brightness_[k] * material[k], 1.0);
  return land;
}

double Relief::rock(const glm::dvec3& direction, double height_m, double steepness,
                    double resolution_m) const {
  const double resolution = std::max(resolution_m / scale_, kFinest);
  const double spots = fractal_noise(direction * kEarthRadius, kSpots, resolution);
  const double high = sea_ ? smoothstep(900, 1900, height_m + 500 * spots) : 0;
  return std::max(high, smoothstep(0.04, 0.14, steepness));
}

void Relief::add_inputs(CacheKey& key) const {
  key.text("relief").value(radius_m_).value(albedo_).value(sea_);
}

double Relief::highest_m() const {
  // A ridge is at most 1.2 times its first octave; noise of amplitude 1 stays within 1.5.
  return 1.2 * (kMountainHeight + 1.3 * kCragHeight) + 2.5 * kPlainHeight + 2.1 * kHillHeight;
}

void Relief::balance_materials() {
  constexpr int kDirections = 4000, kHalvings = 40;
  constexpr double kResolution = 2e3, kBrightest = 1e3;
  std::vector<NodeValues> places;  // on land
  for (int i = 0; i < kDirections; ++i) {
    const glm::dvec3 direction = fibonacci_direction(i, kDirections);
    const Elevation at = elevation(direction, kResolution * scale_);
    if (at.above_water_m > 0)
      places.push_back(material(direction, at.height_m, 0, kResolution * scale_));
  }
  const double land_share = static_cast<double>(places.size()) / kDirections;
  double albedo = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    albedo += albedo_[k] / 4;
    water_[k] = std::min(kSea[k], albedo_[k]);
  }
  // Land has its colour times that of the albedo, and makes up for the dark sea.
  const auto set_brightness = [&](double brightness) {
    for (std::size_t k = 0; k < 4; ++k)
      brightness_[k] = albedo > 0 ? brightness * albedo_[k] / albedo : 0;
  };
  const auto mean = [&] {
    double sum = 0;
    for (const double part : water_) sum += 0.25 * (1 - land_share) * part;
    for (const NodeValues& at : places) {
      for (const double part : reflectance_of(at)) sum += 0.25 * part / kDirections;
    }
    return sum;
  };
  double low = 0, high = kBrightest;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    set_brightness(middle);
    (mean() < albedo ? low : high) = middle;
  }
  set_brightness(high);
  // Where land cannot, the sea follows.
  const double missing = albedo - mean();
  if (land_share < 1)
    for (double& value : water_) value = std::min(value + missing / (1 - land_share), 1.0);
}

}  // namespace skyfit
