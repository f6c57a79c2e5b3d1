// SPDX-License-Identifier: Apache-2.0
// What the models of the literature share: every wavelength on its own, values and derivatives by
// one templated code on dual numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"
#include "model/geometry/ray.h"
#include "model/geometry/view.h"
#include "model/sky_model.h"

namespace skyfit::literature {

inline View view_of(const Atmosphere<double>& a, const SkyPoint& point) {
  return skyfit::view_of(a.bottom_radius_m, a.top_radius_m - a.bottom_radius_m, point);
}

// Checks atmosphere, points and derivatives for a model; throws std::invalid_argument.
void check_request(std::string_view model, const Atmosphere<double>& atmosphere,
                   std::span<const SkyPoint> points, std::span<const Parameter> derivatives);

// The sun above the horizon and the eye no higher than `highest_m`; throws std::invalid_argument
// that says so.
void check_daylight(std::string_view model, std::span<const SkyPoint> points, double highest_m);

// Closed forms that need no tables of their own; the model is valid for the observers of `limits`
// in the atmosphere.
SkyRayTables closed_form(SkyRayMapping mapping, const DaylightLimits& limits,
                         const Atmosphere<double>& atmosphere);

// Exponential profiles of what scatters; throws std::invalid_argument that names another.
void check_exponential(std::string_view model, const Atmosphere<double>& atmosphere);

// The models of the literature know air with Rayleigh's phase function and one aerosol, and any
// absorbers besides. The places of the two in the atmosphere's list; -1: there is none.
struct AirAndAerosol {
  int air = -1, aerosol = -1;
};
template <class T>
AirAndAerosol air_and_aerosol(const Atmosphere<T>& atmosphere) {
  AirAndAerosol roles;
  for (std::size_t i = 0; i < atmosphere.constituents.size(); ++i) {
    const Constituent<T>& c = atmosphere.constituents[i];
    if (!scatters(c)) continue;
    (c.phase.type == PhaseType::kRayleigh ? roles.air : roles.aerosol) = static_cast<int>(i);
  }
  return roles;
}

// The optics of such an atmosphere by the names of the two. What is missing is 0.
template <int N>
struct ClearAir : Optics<N> {
  Dual<N> air;                                     // Rayleigh scattering at density 1, 1/m
  Dual<N> aerosol_scattering;                      // 1/m
  Dual<N> aerosol_extinction;                      // 1/m
  Dual<N> air_scale_height, aerosol_scale_height;  // m
  double depolarisation = 0;
  PhaseFunction<Dual<N>> phase;                // of the aerosol
  int air_profile = -1, aerosol_profile = -1;  // of the shells

  struct Densities {
    Dual<N> air, aerosol;
  };
  Densities densities(double height) const {
    const skyfit::Densities<N> all = Optics<N>::densities(height);
    return {air_profile < 0 ? Dual<N>() : all[static_cast<std::size_t>(air_profile)],
            aerosol_profile < 0 ? Dual<N>() : all[static_cast<std::size_t>(aerosol_profile)]};
  }
};

template <int N>
ClearAir<N> clear_air(const Shells& shells, const Atmosphere<Dual<N>>& atmosphere,
                      const WavelengthNode& node) {
  ClearAir<N> air;
  static_cast<Optics<N>&>(air) = true_optics_at(shells, atmosphere, node);
  const AirAndAerosol roles = air_and_aerosol(atmosphere);
  for (const Scatterer<N>& s : air.scatterers) {
    const auto place = static_cast<int>(s.constituent), profile = static_cast<int>(s.profile);
    if (place == roles.air) {
      air.air = s.scattering;
      air.air_profile = profile;
      air.air_scale_height = air.shape[s.profile][0];
      air.depolarisation = s.phase.depolarisation;
    } else {
      air.aerosol_scattering = s.scattering;
      const Constituent<Dual<N>>& c = atmosphere.constituents[s.constituent];
      const Dual<N> albedo = single_scattering_albedo_at(c, node.wavelength_nm);
      air.aerosol_extinction = albedo.v > 0 ? s.scattering / albedo : Dual<N>();
      air.aerosol_profile = profile;
      air.aerosol_scale_height = air.shape[s.profile][0];
      air.phase = s.phase;
    }
  }
  return air;
}

// The same without derivatives at the nodes of a colour rule, without absorption: what a renderer
// needs of closed forms.
struct AirAtNodes {
  std::array<double, 4> air{}, aerosol{};  // scattering at density 1, 1/m
  // Of what is not there: the thickness of the atmosphere.
  double air_scale_height_m = 0, aerosol_scale_height_m = 0;
};
AirAtNodes air_at_nodes(const Atmosphere<double>& atmosphere,
                        std::span<const WavelengthNode, 4> nodes);

// How many derivatives are carried at once: of closed forms all; of tables seven, for their memory
// (270 MB while those of Bruneton are made), and because eight doubles fill a register.
inline constexpr int kAllAtOnce = kDerivativesAtOnce;
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
  struct Texels {
    int width = 0, height = 0, depth = 0;  // width varies fastest
    std::vector<float> values;
  };
  Texels air, aerosol, gathered;  // the last empty where a model has none
};

// Whether models without absorption depend on a parameter.
inline bool can_fit_without_absorption(const Parameter& parameter) {
  return parameter.quantity() != Quantity::kSingleScatteringAlbedo &&
         parameter.quantity() != Quantity::kColumn;
}

// The effective atmosphere of models without absorption.
template <class T>
Atmosphere<T> without_absorption(Atmosphere<T> atmosphere) {
  for (Constituent<T>& c : atmosphere.constituents) {
    if (!scatters(c)) {
      c.amount = T(0.0);
    } else if (c.phase.type == PhaseType::kSizeDistribution) {
      c.phase.particles.absorbs = false;
    } else {
      // What is stated as extinction: as much of it as scatters at the wavelength of the amount.
      if (c.amount_type != AmountType::kScattering)
        c.amount *= c.albedo_spectrum ? T(c.albedo_spectrum->at(c.wavelength_nm))
                                      : c.single_scattering_albedo;
      c.single_scattering_albedo = T(1.0);
      c.albedo_spectrum = nullptr;
    }
  }
  return atmosphere;
}

}  // namespace skyfit::literature
