// SPDX-License-Identifier: Apache-2.0
#include "model/tables/table_blend.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"

namespace skyfit {
namespace {

void require_same(bool same, std::string_view field) {
  if (!same)
    throw std::invalid_argument(fmt::format(
        "{}: differs: expected the same in atmospheres with others between them", field));
}

template <class Function>
bool same_table(const Function& a, const Function& b) {
  return a == b || (a && b && a->table() == b->table());
}

void require_comparable(const Atmosphere<double>& a, const Atmosphere<double>& b) {
  require_same(a.bottom_radius_m == b.bottom_radius_m, "planet.bottom_radius_m");
  require_same(a.top_radius_m == b.top_radius_m, "planet.top_radius_m");
  require_same(a.constituents.size() == b.constituents.size(), "constituents");
  for (const Constituent<double>& x : a.constituents) {
    const Constituent<double>* const found = b.find(x.name);
    require_same(found != nullptr, x.name);
    const Constituent<double>& y = *found;
    require_same(x.amount_type == y.amount_type, x.name + ".amount");
    require_same(x.absorber == y.absorber, x.name + ".absorber");
    require_same(same_table(x.spectrum, y.spectrum), x.name + ".spectrum");
    require_same(same_table(x.albedo_spectrum, y.albedo_spectrum),
                 x.name + ".single_scattering_albedo");
    require_same(x.profile.type == y.profile.type && x.profile.of == y.profile.of &&
                     x.profile.corners == y.profile.corners &&
                     x.profile.numbers == y.profile.numbers &&
                     same_table(x.profile.table, y.profile.table),
                 x.name + ".profile");
    require_same(x.phase.type == y.phase.type, x.name + ".phase.type");
    require_same(x.phase.lobe == y.phase.lobe, x.name + ".phase.lobe");
    require_same(same_spectrum(x.phase.particles, y.phase.particles),
                 x.name + ".phase.refractive_index");
    require_same(
        same_table(x.phase.table, y.phase.table) && x.phase.by_wavelength == y.phase.by_wavelength,
        x.name + ".phase");
  }
  const PhaseClasses phases = phase_classes(a), others = phase_classes(b);
  const auto at_b = [&](std::size_t i) {
    return b.find(a.constituents[i].name) - b.constituents.data();
  };
  for (std::size_t i = 0; i < a.constituents.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool same = phases.of_constituent[i] == phases.of_constituent[j],
                 as_same = others.of_constituent[at_b(i)] == others.of_constituent[at_b(j)];
      require_same(same == as_same, fmt::format("whether {} and {} have one phase function",
                                                a.constituents[j].name, a.constituents[i].name));
    }
  }
  require_same(a.star == b.star, "star");
  require_same(a.sea == b.sea, "ground.sea");
  require_same(same_table(a.ground_spectrum, b.ground_spectrum), "ground.spectrum");
}

// The same with its amount stated at another wavelength.
Constituent<double> stated_at(Constituent<double> c, double wavelength_nm) {
  if (!is_at_wavelength(c.amount_type)) return c;
  c.amount *= relative_coefficient_at(with_scalar<Dual<0>>(c), wavelength_nm).v;
  c.wavelength_nm = wavelength_nm;
  return c;
}

Table interpolated(const Table& a, const Table& b, double share) {
  require_same(a.width == b.width && a.height == b.height && a.depth == b.depth, "size of tables");
  Table result{a.width, a.height, a.depth, std::vector<float>(a.rgba.size())};
  const auto part = static_cast<float>(share);
  for (std::size_t i = 0; i < result.rgba.size(); ++i)
    result.rgba[i] = (1 - part) * a.rgba[i] + part * b.rgba[i];
  return result;
}

// Of one colour rule.
FormulaSky interpolated(FormulaSky a, const FormulaSky& b, double share) {
  a.turbidity = std::lerp(a.turbidity, b.turbidity, share);
  return a;
}

}  // namespace

Atmosphere<double> interpolated_atmosphere(const Atmosphere<double>& a, const Atmosphere<double>& b,
                                           double share) {
  require_comparable(a, b);
  if (share <= 0) return a;
  if (share >= 1) return b;
  Atmosphere<double> result = a;
  const auto mix = [&](double x, double y) { return std::lerp(x, y, share); };
  for (Constituent<double>& c : result.constituents) {
    const Constituent<double> end = stated_at(b.at(c.name), c.wavelength_nm);
    c.amount = mix(c.amount, end.amount);
    c.angstrom_exponent = mix(c.angstrom_exponent, end.angstrom_exponent);
    c.temperature_k = mix(c.temperature_k, end.temperature_k);
    c.co2_ppm = mix(c.co2_ppm, end.co2_ppm);
    c.site_pressure_hpa = mix(c.site_pressure_hpa, end.site_pressure_hpa);
    c.single_scattering_albedo = mix(c.single_scattering_albedo, end.single_scattering_albedo);
    c.profile.scale_height_m = mix(c.profile.scale_height_m, end.profile.scale_height_m);
    c.profile.base_m = mix(c.profile.base_m, end.profile.base_m);
    c.profile.top_m = mix(c.profile.top_m, end.profile.top_m);
    c.phase.g = mix(c.phase.g, end.phase.g);
    c.phase.g1 = mix(c.phase.g1, end.phase.g1);
    c.phase.g2 = mix(c.phase.g2, end.phase.g2);
    c.phase.weight = mix(c.phase.weight, end.phase.weight);
    SizeDistribution<double>& particles = c.phase.particles;
    particles.radius_um = mix(particles.radius_um, end.phase.particles.radius_um);
    particles.width = mix(particles.width, end.phase.particles.width);
    particles.index_real = mix(particles.index_real, end.phase.particles.index_real);
    particles.index_imaginary = mix(particles.index_imaginary, end.phase.particles.index_imaginary);
    c.phase.depolarisation = mix(c.phase.depolarisation, end.phase.depolarisation);
  }
  result.ground_albedo = mix(a.ground_albedo, b.ground_albedo);
  return result;
}

AtmosphereTables interpolated_tables(const AtmosphereTables& a, const AtmosphereTables& b,
                                     double share) {
  require_same(a.color.nodes == b.color.nodes, "wavelengths of tables");
  require_same(a.sky_rays.mapping == b.sky_rays.mapping, "sky model of tables");
  require_same(a.phases.of_constituent == b.phases.of_constituent,
               "order of the constituents of tables");
  Atmosphere<double> atmosphere = interpolated_atmosphere(a.atmosphere, b.atmosphere, share);
  PhaseClasses phases = phase_classes(atmosphere);
  return {std::move(atmosphere),
          std::move(phases),
          a.color,
          a.sizes,
          interpolated(a.heights, b.heights, share),
          interpolated(a.optical_depth, b.optical_depth, share),
          interpolated(a.irradiance, b.irradiance, share),
          interpolated(a.rayleigh_like, b.rayleigh_like, share),
          interpolated(a.single, b.single, share),
          interpolated(a.phase, b.phase, share),
          {a.sky_rays.mapping, interpolated(a.sky_rays.air, b.sky_rays.air, share),
           interpolated(a.sky_rays.aerosol, b.sky_rays.aerosol, share), a.sky_rays.nielsen,
           a.sky_rays.oneil, interpolated(a.sky_rays.formula, b.sky_rays.formula, share),
           a.sky_rays.limits, interpolated(a.sky_rays.gathered, b.sky_rays.gathered, share),
           a.sky_rays.bruneton}};
}

}  // namespace skyfit
