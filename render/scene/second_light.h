// SPDX-License-Identifier: Apache-2.0
// The light beside the first sun's in a frame: a second sun's or the moon's.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "model/photometry/second_light.h"
#include "render/render.h"

namespace skyfit {

struct SecondLight {
  double zenith, azimuth;  // radians; azimuth relative to the first sun's
  double share;            // of the first sun's illuminance, above the air
  std::shared_ptr<const SpectralData> spectra = nullptr;  // SecondSun's
  // Angular radius of a moon's disc, rad; none of a sun, whose disc is as wide as the first's.
  std::optional<double> moon_radius = {};

  bool has_own_color() const { return spectra != nullptr || moon_radius; }
  ColorRule rule(const ColorRule& first) const {
    if (moon_radius) return moonlight_color_rule(first);
    return spectra ? color_rule_under(*spectra, first) : first;
  }
  LuminanceRule rule(const LuminanceRule& first) const {
    if (moon_radius) return moonlight_luminance_rule(first);
    return spectra ? luminance_rule_under(*spectra, first) : first;
  }
};

// The first sun is so far away that its rays are parallel.
inline std::optional<SecondLight> second_light(const FrameOptions& options) {
  if (const auto& sun = options.second_sun)
    return SecondLight{sun->zenith, sun->azimuth, sun->irradiance, sun->spectra};
  if (!options.moon || !options.moon->lights) return {};
  const Moon& moon = *options.moon;
  const double between =
      std::cos(options.sun_zenith) * std::cos(moon.zenith) +
      std::sin(options.sun_zenith) * std::sin(moon.zenith) * std::cos(moon.azimuth);
  const double phase = std::acos(std::clamp(-between, -1.0, 1.0)),
               sine = moon.radius_m / moon.distance_m;
  return SecondLight{.zenith = moon.zenith,
                     .azimuth = moon.azimuth,
                     .share = moon_illuminance_share(phase) *
                              std::pow(sine / (kMoonRadius_m / kMoonDistance_m), 2),
                     .moon_radius = std::asin(sine)};
}

}  // namespace skyfit
