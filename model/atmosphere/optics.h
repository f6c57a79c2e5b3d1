// SPDX-License-Identifier: Apache-2.0
// The atmosphere at one wavelength, with derivatives by the parameters that seeded it.
// The forward peak of the aerosol's phase function is cut off (delta-M, Wiscombe 1977): the share f
// = chi_L of the scattering is taken as not scattered at all, and the moments that are left are
// (chi - f) / (1 - f). Single scattering keeps the true phase function under the cut extinction
// (TMS, Nakajima & Tanaka 1988).
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "model/atmosphere/phase_moments.h"
#include "model/atmosphere/profile.h"
#include "model/numerics/dual.h"
#include "model/photometry/photometry.h"

namespace skyfit {

// Columns from one point to another of air, aerosol and ozone, metres of their reference density.
struct PathColumns {
  Column air, aerosol, ozone;  // ozone by the scale height of the air, see Profiles

  PathColumns& operator+=(const PathColumns& o) {
    auto add = [](Column& a, const Column& b) {
      a.value += b.value;
      a.by_scale_height += b.by_scale_height;
    };
    add(air, o.air);
    add(aerosol, o.aerosol);
    add(ozone, o.ozone);
    return *this;
  }
  PathColumns operator-() const {
    return {{-air.value, -air.by_scale_height},
            {-aerosol.value, -aerosol.by_scale_height},
            {-ozone.value, -ozone.by_scale_height}};
  }
};

// Relative densities of the three at one height.
template <int N>
struct Densities {
  Dual<N> air, aerosol, ozone;
};

template <int N>
struct Optics {
  Profiles profiles;
  Dual<N> air;                      // Rayleigh scattering = extinction at h = 0, 1/m
  Dual<N> air_scale_height;         // m
  Dual<N> aerosol_extinction;       // cut, at h = 0, 1/m
  Dual<N> aerosol_extinction_true;  // what weakens the sun's beam itself
  Dual<N> aerosol_scattering;       // true, at h = 0, 1/m: for single scattering
  Dual<N> aerosol_scattering_cut;
  Dual<N> aerosol_scale_height;
  Dual<N> ozone;  // absorption where the profile is 1, 1/m
  Dual<N> ground_albedo;
  double depolarisation = 0;
  std::array<double, 3> air_moments{};  // the others are 0
  AerosolPhase<Dual<N>> phase;
  std::vector<Dual<N>> moments;  // of the cut phase function

  Densities<N> densities(double height) const {
    return densities_by([height](const Profile& profile) { return profile.density(height); });
  }
  // At a level of a grid, see Profile::density_at_level().
  Densities<N> densities_at_level(double low, double height, double high) const {
    return densities_by(
        [=](const Profile& profile) { return profile.density_at_level(low, height, high); });
  }

  Dual<N> optical_depth(const PathColumns& c) const {
    Dual<N> tau(air.v * c.air.value + aerosol_extinction.v * c.aerosol.value +
                ozone.v * c.ozone.value);
    const double by_air_height = air.v * c.air.by_scale_height + ozone.v * c.ozone.by_scale_height;
    const double by_aerosol_height = aerosol_extinction.v * c.aerosol.by_scale_height;
    for (std::size_t p = 0; p < N; ++p) {
      tau.d[p] = air.d[p] * c.air.value + aerosol_extinction.d[p] * c.aerosol.value +
                 ozone.d[p] * c.ozone.value + by_air_height * air_scale_height.d[p] +
                 by_aerosol_height * aerosol_scale_height.d[p];
    }
    return tau;
  }

 private:
  template <class DensityOf>
  Densities<N> densities_by(DensityOf density_of) const {
    auto at = [&](const Profile& profile, const Dual<N>& scale_height) {
      const Density rho = density_of(profile);
      return scale_height.chain(rho.value, rho.by_scale_height);
    };
    const Dual<N> air_density = at(profiles.air, air_scale_height);
    return {air_density, at(profiles.aerosol, aerosol_scale_height),
            profiles.ozone == profiles.air ? air_density : at(profiles.ozone, air_scale_height)};
  }
};

// With the true phase function, nothing of its peak cut off; without its moments.
template <int N>
Optics<N> uncut_optics_at(const Atmosphere<Dual<N>>& a, const WavelengthNode& node) {
  constexpr double kMoleculesPerDobson = 2.687e20;  // 1/m^2
  auto at = [&](const PowerLaw<Dual<N>>& law) {
    return law.value * exp(law.exponent * -std::log(node.wavelength_nm / law.wavelength_nm));
  };
  Optics<N> o;
  o.profiles = profiles_of(a);
  o.air = at(a.rayleigh.scattering_per_m) * (a.rayleigh.site_pressure_hpa / kStandardPressureHpa);
  o.air_scale_height = a.rayleigh.scale_height_m;
  o.depolarisation = a.rayleigh.depolarisation;
  o.air_moments = rayleigh_moments(o.depolarisation);
  o.phase = a.mie.phase;
  o.aerosol_scattering = o.aerosol_scattering_cut = at(a.mie.scattering_per_m);
  o.aerosol_extinction_true = o.aerosol_extinction =
      o.aerosol_scattering / a.mie.single_scattering_albedo;
  o.aerosol_scale_height = a.mie.scale_height_m;
  const Dual<N> column = a.ozone.column_du * (kMoleculesPerDobson * node.ozone_cross_section_m2);
  const Column unit = o.profiles.ozone.vertical_column();
  o.ozone = column / a.rayleigh.scale_height_m.chain(unit.value, unit.by_scale_height);
  o.ground_albedo = ground_albedo_at(a, node.wavelength_nm);
  return o;
}

template <int N>
Optics<N> optics_at(const Atmosphere<Dual<N>>& a, const WavelengthNode& node, int moment_count) {
  Optics<N> o = uncut_optics_at(a, node);
  o.moments = aerosol_phase_moments(a.mie.phase, moment_count + 1);
  const Dual<N> cut = o.moments.back();
  o.moments.pop_back();
  for (Dual<N>& chi : o.moments) chi = (chi - cut) / (Dual<N>(1.0) - cut);
  o.aerosol_scattering_cut = o.aerosol_scattering * (Dual<N>(1.0) - cut);
  o.aerosol_extinction = o.aerosol_extinction_true - o.aerosol_scattering * cut;
  return o;
}

}  // namespace skyfit
