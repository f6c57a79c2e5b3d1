// SPDX-License-Identifier: Apache-2.0
// The atmosphere at one wavelength, with derivatives by the parameters that seeded it.
// The forward peak of a phase function is cut off (delta-M, Wiscombe 1977): the share f = chi_L of
// the scattering is taken as not scattered at all, and the moments that are left are (chi - f) /
// (1 - f). Single scattering keeps the true phase function under the delta-M-scaled extinction
// (TMS, Nakajima & Tanaka 1988).
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "model/atmosphere/phase_moments.h"
#include "model/atmosphere/shells.h"
#include "model/atmosphere/wavelength_node.h"
#include "model/numerics/dual.h"

namespace skyfit {

// A constituent that scatters.
template <int N>
struct Scatterer {
  std::size_t constituent;       // its place in the atmosphere's list
  std::size_t profile;           // of the shells
  Dual<N> scattering;            // true, where the density is 1, 1/m: for single scattering
  Dual<N> scaled_scattering;     // delta-M-scaled
  PhaseFunction<Dual<N>> phase;  // true, at the wavelength
  std::vector<Dual<N>> moments;  // of the delta-M-scaled phase function; further ones are 0
  // Those of the delta-M-scaled scattering matrix of particles, docs/theory (13.18), where it is
  // taken; empty otherwise.
  struct {
    std::vector<Dual<N>> alpha, zeta, gamma;
  } matrix;
};

// Whether it has Rayleigh's phase matrix. Of the others, where no matrix of theirs is taken,
// polarised light stays as it is in part, docs/theory (13.8), and becomes unpolarised otherwise.
template <int N>
bool polarises(const Scatterer<N>& s) {
  return s.phase.type == PhaseType::kRayleigh;
}

// Relative densities of all profiles at one height.
template <int N>
using Densities = std::array<Dual<N>, kMostConstituents>;

template <int N>
struct Optics {
  std::vector<Profile> profiles;
  std::vector<std::array<Dual<N>, kMostShapes>> shape;  // of each profile: its parameters, m
  // Where the density of a profile is 1, 1/m, of all its constituents; the second delta-M-scaled.
  std::vector<Dual<N>> extinction, scaled_extinction;
  // What Q and U lose along a ray: scatterers without a matrix do not take what they scatter
  // forward, docs/theory (13.8).
  std::vector<Dual<N>> polarised_extinction;
  std::vector<Scatterer<N>> scatterers;
  Dual<N> ground_albedo;

  Densities<N> densities(double height) const {
    return densities_by([height](const Profile& profile) { return profile.density(height); });
  }
  // At a level of a grid, see Profile::density_at_level().
  Densities<N> densities_at_level(double low, double height, double high) const {
    return densities_by(
        [=](const Profile& profile) { return profile.density_at_level(low, height, high); });
  }

  Dual<N> optical_depth(const PathColumns& c) const { return optical_depth_by(extinction, c); }
  Dual<N> scaled_optical_depth(const PathColumns& c) const {
    return optical_depth_by(scaled_extinction, c);
  }
  // docs/theory (2.3) and (2.4). Of an extinction per profile, as those above.
  Dual<N> optical_depth_by(const std::vector<Dual<N>>& coefficient, const PathColumns& c) const {
    Dual<N> tau;
    for (std::size_t i = 0; i < c.size(); ++i) {
      tau.v += coefficient[i].v * c[i].value;
      for (std::size_t p = 0; p < N; ++p) tau.d[p] += coefficient[i].d[p] * c[i].value;
      for (std::size_t s = 0; s < profiles[i].shapes(); ++s) {
        const double by_shape = coefficient[i].v * c[i].by_shape[s];
        for (std::size_t p = 0; p < N; ++p) tau.d[p] += by_shape * shape[i][s].d[p];
      }
    }
    return tau;
  }

 private:
  template <class DensityOf>
  Densities<N> densities_by(DensityOf density_of) const {
    Densities<N> result;
    for (std::size_t i = 0; i < profiles.size(); ++i) {
      const Density rho = density_of(profiles[i]);
      result[i] = Dual<N>(rho.value);
      for (std::size_t s = 0; s < profiles[i].shapes(); ++s) {
        for (std::size_t p = 0; p < N; ++p) result[i].d[p] += rho.by_shape[s] * shape[i][s].d[p];
      }
    }
    return result;
  }
};

// docs/theory (2.1) and the table below it.
// The extinction of a constituent where its density is 1, 1/m, and how much of it is scattering.
template <int N>
struct Coefficients {
  Dual<N> extinction, scattering;
};
// Of particles with a size distribution, per volume, 1/um.
template <int N>
Coefficients<N> of_particles(const SizeDistribution<Dual<N>>& particles, double wavelength_nm) {
  const std::shared_ptr<const ParticleOptics> optics = optics_at(particles, wavelength_nm);
  const Dual<N> scattering = with_slopes(optics->scattering, particles);
  return {particles.absorbs ? with_slopes(optics->extinction, particles) : scattering, scattering};
}

// Of one that scatters: its single scattering albedo.
template <int N>
Dual<N> single_scattering_albedo_at(const Constituent<Dual<N>>& c, double wavelength_nm) {
  if (c.phase.type == PhaseType::kSizeDistribution) {
    const Coefficients<N> k = of_particles(c.phase.particles, wavelength_nm);
    return k.scattering / k.extinction;
  }
  return c.albedo_spectrum ? Dual<N>(c.albedo_spectrum->at(wavelength_nm))
                           : c.single_scattering_albedo;
}

// Of an amount that is_at_wavelength(): its coefficient at a wavelength over that at its own.
template <int N>
Dual<N> relative_coefficient_at(const Constituent<Dual<N>>& c, double wavelength_nm) {
  if (c.phase.type == PhaseType::kSizeDistribution) {
    const Coefficients<N> here = of_particles(c.phase.particles, wavelength_nm),
                          stated = of_particles(c.phase.particles, c.wavelength_nm);
    return c.amount_type == AmountType::kScattering ? here.scattering / stated.scattering
                                                    : here.extinction / stated.extinction;
  }
  if (c.spectrum) return Dual<N>(c.spectrum->at(wavelength_nm) / c.spectrum->at(c.wavelength_nm));
  return exp(c.angstrom_exponent * -std::log(wavelength_nm / c.wavelength_nm));
}

template <int N>
Coefficients<N> coefficients_at(const Constituent<Dual<N>>& c, const Dual<N>& vertical_column,
                                const WavelengthNode& node) {
  constexpr double kMoleculesPerDobson = 2.687e20;  // 1/m^2
  if (c.amount_type == AmountType::kColumn) {
    const double cross_section_m2 = c.absorber == Absorber::kOzone
                                        ? node.ozone_cross_section_m2
                                        : node.nitrogen_dioxide_cross_section_m2;
    return {c.amount * (kMoleculesPerDobson * cross_section_m2) / vertical_column, {}};
  }
  if (c.amount_type == AmountType::kOxygenPairs) {
    const double at_one_hpa =
        oxygen_pair_column(1, c.temperature_k) * node.oxygen_pair_cross_section_m5;
    return {c.amount * c.amount * at_one_hpa / vertical_column, {}};
  }
  if (c.amount_type == AmountType::kAirPressure) {
    const double depth_per_hpa =
        air_column_per_hpa(c.co2_ppm) * rayleigh_cross_section_m2(node.wavelength_nm, c.co2_ppm);
    const Dual<N> scattering = c.amount * depth_per_hpa / vertical_column;
    return {scattering, scattering};
  }
  if (c.amount_type == AmountType::kVolume) {
    const Coefficients<N> k = of_particles(c.phase.particles, node.wavelength_nm);
    const Dual<N> per_length = c.amount / vertical_column;
    return {per_length * k.extinction, per_length * k.scattering};
  }
  Dual<N> amount = c.amount * relative_coefficient_at(c, node.wavelength_nm);
  if (c.amount_type == AmountType::kOpticalDepth) amount /= vertical_column;
  amount = amount * (c.site_pressure_hpa / kStandardPressureHpa);
  const Dual<N> albedo = single_scattering_albedo_at(c, node.wavelength_nm);
  if (c.amount_type == AmountType::kScattering) return {amount / albedo, amount};
  return {amount, amount * albedo};
}

// With the true phase functions, nothing of their peaks cut off; without their moments. The shells
// are those of the atmosphere.
template <int N>
Optics<N> true_optics_at(const Shells& shells, const Atmosphere<Dual<N>>& a,
                         const WavelengthNode& node) {
  Optics<N> o;
  o.profiles = shells.profiles;
  o.shape.resize(o.profiles.size());
  o.extinction.resize(o.profiles.size());
  for (std::size_t i = 0; i < a.constituents.size(); ++i) {
    const Constituent<Dual<N>>& c = a.constituents[i];
    if (shells.profile_of[i] == Shells::kNone) continue;
    const auto at = static_cast<std::size_t>(shells.profile_of[i]);
    const VerticalProfile<Dual<N>> profile = own_profile(a, c);
    o.shape[at] = profile.type == ProfileType::kLayer
                      ? std::array{profile.base_m, profile.top_m}
                      : std::array{profile.scale_height_m, Dual<N>()};
    const Column unit = o.profiles[at].vertical_column();
    Dual<N> column(unit.value);
    for (std::size_t s = 0; s < o.profiles[at].shapes(); ++s) {
      for (std::size_t p = 0; p < N; ++p) column.d[p] += unit.by_shape[s] * o.shape[at][s].d[p];
    }
    const Coefficients<N> k = coefficients_at(c, column, node);
    o.extinction[at] += k.extinction;
    if (!scatters(c)) continue;
    o.scatterers.push_back(
        {i, at, k.scattering, k.scattering, phase_at(c.phase, node.wavelength_nm), {}, {}});
    if (c.amount_type == AmountType::kAirPressure)
      o.scatterers.back().phase.depolarisation = king_depolarisation(node.wavelength_nm, c.co2_ppm);
  }
  o.scaled_extinction = o.polarised_extinction = o.extinction;
  o.ground_albedo = ground_albedo_at(a, node.wavelength_nm);
  return o;
}

// docs/theory (13.8).
// The share of the scattering that goes forward with its polarisation: of particles by their
// scattering matrix, of others from the moments chi_1 and chi_2, the mean of (1 + nu)^2 / 4.
template <int N>
Dual<N> kept_polarisation(const PhaseFunction<Dual<N>>& phase, const std::vector<Dual<N>>& chi) {
  if (phase.type == PhaseType::kSizeDistribution) {
    const ParticleOptics::MatrixMoments m = phase.optics->matrix_moments(2);
    return 0.5 * (with_slopes(m.alpha, phase.particles) + with_slopes(m.zeta, phase.particles));
  }
  return Dual<N>(1.0 / 3) + chi[1] * 0.5 + chi[2] * (1.0 / 6);
}

// Which light is asked for: that of Q and U needs the scattering matrices of particles, radiance
// goes without.
enum class Wanted { kRadiance, kStokes };

// docs/theory (2.14).
template <int N>
Optics<N> optics_at(const Shells& shells, const Atmosphere<Dual<N>>& a, const WavelengthNode& node,
                    int moment_count, Wanted wanted = Wanted::kRadiance) {
  Optics<N> o = true_optics_at(shells, a, node);
  for (Scatterer<N>& s : o.scatterers) {
    s.moments = phase_moments(s.phase, moment_count + 1);
    const bool has_matrix =
        wanted == Wanted::kStokes && s.phase.type == PhaseType::kSizeDistribution;
    if (!polarises(s) && !has_matrix)
      o.polarised_extinction[s.profile] -= s.scattering * kept_polarisation(s.phase, s.moments);
    if (static_cast<int>(s.moments.size()) <= moment_count) continue;  // the rest is 0
    const Dual<N> cut = s.moments.back(), rest = Dual<N>(1.0) - cut;
    s.moments.pop_back();
    for (Dual<N>& chi : s.moments) chi = (chi - cut) / rest;
    s.scaled_scattering = s.scattering * rest;
    o.scaled_extinction[s.profile] -= s.scattering * cut;
    if (!has_matrix) continue;
    o.polarised_extinction[s.profile] -= s.scattering * cut;
    for (int l = 0; l < moment_count; ++l) {
      const ParticleOptics::MatrixMoments m = s.phase.optics->matrix_moments(l);
      const auto part = [&](const ParticleValue& value) {
        return with_slopes(value, s.phase.particles);
      };
      const Dual<N> peak = l < 2 ? Dual<N>() : cut;
      s.matrix.alpha.push_back((part(m.alpha) - peak) / rest);
      s.matrix.zeta.push_back((part(m.zeta) - peak) / rest);
      s.matrix.gamma.push_back(part(m.gamma) / rest);
    }
  }
  return o;
}

}  // namespace skyfit
