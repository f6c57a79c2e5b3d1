// SPDX-License-Identifier: Apache-2.0
// What the models of the literature share: every wavelength on its own, values and derivatives by
// one templated code on dual numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"
#include "model/geometry/ray.h"
#include "model/sky_model.h"

namespace skyfit::literature {

// Where the view ray of a point runs, and the sun at its beginning inside the atmosphere. Cosines.
struct View {
  ViewRay ray;
  double mu_s = 0;  // of the sun's zenith angle where the ray begins
  double nu = 0;    // of the angle between ray and sun
};
View view_of(const Atmosphere<double>& atmosphere, const SkyPoint& point);

// Checks atmosphere, points and derivatives for a model; throws std::invalid_argument.
void check_request(std::string_view model, const Atmosphere<double>& atmosphere,
                   std::span<const SkyPoint> points, std::span<const Parameter> derivatives);

// The sun above the horizon and the eye no higher than `highest_m`; throws std::invalid_argument
// that says so.
void check_daylight(std::string_view model, std::span<const SkyPoint> points, double highest_m);

// Exponential air and aerosol; throws std::invalid_argument that names the other.
void check_exponential(std::string_view model, const Atmosphere<double>& atmosphere);

// How many derivatives are carried at once: of closed forms all; of tables seven, for their memory
// (270 MB while those of Bruneton are made), and because eight doubles fill a register.
inline constexpr int kAllAtOnce = kParameterCount;
inline constexpr int kTablesAtOnce = 7;

// Calls radiance.operator()<N>(atmosphere, node, out) for every wavelength and every batch of
// derivatives; out[i] is the radiance of point i. N is 0 where no derivatives are asked for.
template <int kBatch, class Radiance>
SkyValues evaluate(const Atmosphere<double>& atmosphere,
                   std::span<const WavelengthNode> wavelengths, std::size_t points,
                   std::span<const Parameter> derivatives, const Radiance& radiance) {
  SkyValues sky{static_cast<int>(points),
                static_cast<int>(wavelengths.size()),
                static_cast<int>(derivatives.size()),
                {},
                {}};
  sky.value.resize(points * wavelengths.size());
  sky.derivative.resize(sky.value.size() * derivatives.size());
  const auto run = [&]<int N>(std::span<const Parameter> batch, std::size_t first) {
    const Atmosphere<Dual<N>> air = seeded<N>(atmosphere, batch);
    std::vector<Dual<N>> out(points);
    for (std::size_t w = 0; w < wavelengths.size(); ++w) {
      radiance.template operator()<N>(air, wavelengths[w], std::span<Dual<N>>(out));
      for (std::size_t i = 0; i < points; ++i) {
        const std::size_t cell = i * wavelengths.size() + w;
        sky.value[cell] = out[i].v;
        for (std::size_t p = 0; p < batch.size(); ++p)
          sky.derivative[(first + p) * sky.value.size() + cell] = out[i].d[p];
      }
    }
  };
  if (derivatives.empty()) run.template operator()<0>({}, 0);
  for (std::size_t first = 0; first < derivatives.size(); first += kBatch) {
    run.template operator()<kBatch>(
        derivatives.subspan(first, std::min<std::size_t>(kBatch, derivatives.size() - first)),
        first);
  }
  return sky;
}

// Light of a view ray, 1/sr.
template <int N>
struct RayLight {
  Dual<N> air, aerosol;  // by which of them it was scattered last
  Dual<N> ground;        // that which comes straight from there
  Dual<N> sum() const { return air + aerosol + ground; }
};

// What a renderer reads of a model's tables: those of rays to the sky, without phase functions, in
// single precision.
struct SkyRayTexels {
  int width = 0, height = 0, depth = 0;  // width varies fastest
  std::vector<float> air, aerosol;
};

// The atmosphere as models without absorption see it.
template <class T>
Atmosphere<T> without_absorption(Atmosphere<T> atmosphere) {
  atmosphere.mie.single_scattering_albedo = T(1.0);
  atmosphere.ozone.column_du = T(0.0);
  return atmosphere;
}

}  // namespace skyfit::literature
