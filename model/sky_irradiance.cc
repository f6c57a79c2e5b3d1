// SPDX-License-Identifier: Apache-2.0
// Irradiances of any sky model: the integral of its radiance, and the sun's beam.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"
#include "model/atmosphere/refraction.h"
#include "model/numerics/gauss.h"
#include "model/sky_model.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;

// Directions and weights whose weighted sum of radiances is the irradiance of a horizontal surface.
struct Hemisphere {
  std::vector<SkyPoint> points;
  std::vector<double> weights;
};

// docs/theory (8.7).
// Gauss's rule in zenith angle, above and below the sun (or the horizon, where the sun is down),
// and in azimuth, both gathered where the aureole is by the cube of the variable. Rings share a
// zenith angle, which is what a solution costs most for.
Hemisphere upper_hemisphere(double altitude_m, double sun_zenith) {
  constexpr int kRings = 16, kAzimuths = 32;
  const GaussRule ring = gauss_legendre(kRings), azimuth = gauss_legendre(kAzimuths);
  const double peak = std::min(sun_zenith, 0.5 * kPi);
  Hemisphere hemisphere;
  for (const double reach : {-peak, 0.5 * kPi - peak}) {
    for (int i = 0; reach != 0 && i < kRings; ++i) {
      const double x = ring.node[i], zenith = peak + reach * x * x * x;
      const double band =
          ring.weight[i] * 3 * x * x * std::abs(reach) * std::sin(zenith) * std::cos(zenith);
      for (int k = 0; k < kAzimuths; ++k) {
        const double y = azimuth.node[k];
        hemisphere.points.push_back({altitude_m, sun_zenith, zenith, kPi * y * y * y});
        hemisphere.weights.push_back(band * 2 * kPi * 3 * y * y * azimuth.weight[k]);
      }
    }
  }
  return hemisphere;
}

using DualIrradiance = Dual<kDerivativesAtOnce>;

struct DirectBeam {
  double mu_s;               // cosine of the zenith angle from which it arrives
  DualIrradiance on_normal;  // on a surface that faces it
};

// exp(-optical depth) toward the sun, the beam itself: nothing of the forward peak is cut off.
DirectBeam beam_through(const Shells& shells, const Atmosphere<double>& atmosphere,
                        const WavelengthNode& wavelength, double height, double mu_s,
                        std::span<const Parameter> derivatives) {
  const ViewRay to_sun = view_ray(shells.bottom_radius, shells.top, height, mu_s);
  if (to_sun.hits_ground) return {mu_s, {}};
  PathColumns columns;
  if (to_sun.length > 0) {
    columns = columns_along(shells, to_sun, ray_point(to_sun, shells.bottom_radius, to_sun.length));
  }
  const auto seeded_atmosphere = seeded<kDerivativesAtOnce>(atmosphere, derivatives);
  return {mu_s, exp(-true_optics_at(shells, seeded_atmosphere, wavelength).optical_depth(columns))};
}

DirectBeam direct_beam(const Atmosphere<double>& atmosphere, const WavelengthNode& wavelength,
                       double altitude_m, double sun_zenith,
                       std::span<const Parameter> derivatives) {
  return beam_through(shells_of(atmosphere, Keep::kWhatMatters, derivatives), atmosphere,
                      wavelength, altitude_m, std::cos(sun_zenith), derivatives);
}

DirectBeam refracted_beam(const Atmosphere<double>& atmosphere, const WavelengthNode& wavelength,
                          double altitude_m, double sun_zenith,
                          std::span<const Parameter> derivatives) {
  const Refraction refraction(atmosphere, wavelength.wavelength_nm);
  const double height = refraction.refractive_height(altitude_m),
               apparent = refraction.apparent_zenith(height, sun_zenith);
  DirectBeam beam =
      beam_through(refraction.refracted(shells_of(atmosphere, Keep::kWhatMatters, derivatives)),
                   atmosphere, wavelength, height, std::cos(apparent), derivatives);
  const double index = refraction.refractive_index(height);
  beam.on_normal = beam.on_normal * (index * index * refraction.beam_spread(height, apparent));
  return beam;
}

// The integral of the radiances at one wavelength.
DualIrradiance diffuse_of(const Hemisphere& hemisphere, const SkyValues& sky, int wavelength) {
  DualIrradiance sum;
  for (int i = 0; i < sky.points; ++i) {
    sum.v += hemisphere.weights[i] * sky.at(i, wavelength);
    for (int p = 0; p < sky.parameters; ++p) {
      sum.d[p] += hemisphere.weights[i] * sky.derivative_at(p, i, wavelength);
    }
  }
  return sum;
}

SkyValues irradiance_of(const Hemisphere& hemisphere, const SkyValues& sky,
                        const std::vector<DirectBeam>& beams) {
  SkyValues result{kIrradianceCount, sky.wavelengths, sky.parameters, {}, {}};
  result.value.resize(static_cast<std::size_t>(result.points) * result.wavelengths);
  result.derivative.resize(result.value.size() * result.parameters);
  for (int w = 0; w < result.wavelengths; ++w) {
    const DirectBeam& beam = beams[static_cast<std::size_t>(w)];
    const DualIrradiance horizontal = std::max(beam.mu_s, 0.0) * beam.on_normal;
    const DualIrradiance diffuse = diffuse_of(hemisphere, sky, w);
    const auto put = [&](Irradiance which, const DualIrradiance& value) {
      const std::size_t at = static_cast<std::size_t>(which) * result.wavelengths + w;
      result.value[at] = value.v;
      for (int p = 0; p < result.parameters; ++p) {
        result.derivative[p * result.value.size() + at] = value.d[p];
      }
    };
    put(kDirectNormal, beam.on_normal);
    put(kDirectHorizontal, horizontal);
    put(kDiffuseHorizontal, diffuse);
    put(kGlobalHorizontal, horizontal + diffuse);
  }
  return result;
}

}  // namespace

SkyValues SkyModel::irradiance(const Atmosphere<double>& atmosphere,
                               std::span<const WavelengthNode> wavelengths, double altitude_m,
                               double sun_zenith, std::span<const Parameter> derivatives) const {
  const Hemisphere hemisphere = upper_hemisphere(altitude_m, sun_zenith);
  return in_batches<kDerivativesAtOnce>(derivatives, [&](std::span<const Parameter> batch) {
    const SkyValues sky = radiance(atmosphere, wavelengths, hemisphere.points, batch);
    std::vector<DirectBeam> beams;
    for (const WavelengthNode& node : wavelengths) {
      beams.push_back(refracts() ? refracted_beam(atmosphere, node, altitude_m, sun_zenith, batch)
                                 : direct_beam(atmosphere, node, altitude_m, sun_zenith, batch));
    }
    return irradiance_of(hemisphere, sky, beams);
  });
}

}  // namespace skyfit
