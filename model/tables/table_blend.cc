// SPDX-License-Identifier: Apache-2.0
#include "model/tables/table_blend.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string_view>

#include "model/atmosphere/parameters.h"

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
  require_same(same_table(a.rayleigh.profile, b.rayleigh.profile), "rayleigh.profile");
  require_same(same_table(a.mie.profile, b.mie.profile), "mie.profile");
  require_same(a.mie.phase.type == b.mie.phase.type, "mie.phase.type");
  require_same(a.mie.phase.lobe == b.mie.phase.lobe, "mie.phase.lobe");
  require_same(same_table(a.mie.phase.table, b.mie.phase.table), "mie.phase");
  require_same(a.ozone.profile == b.ozone.profile && same_table(a.ozone.table, b.ozone.table),
               "ozone.profile");
  require_same(same_table(a.ground_spectrum, b.ground_spectrum), "ground.spectrum");
}

// The same law with its coefficient stated at another wavelength.
PowerLaw<double> stated_at(const PowerLaw<double>& law, double wavelength_nm) {
  return {wavelength_nm, law.value * std::pow(wavelength_nm / law.wavelength_nm, -law.exponent),
          law.exponent};
}

Table interpolated(const Table& a, const Table& b, double share) {
  require_same(a.width == b.width && a.height == b.height && a.depth == b.depth, "size of tables");
  Table result{a.width, a.height, a.depth, std::vector<float>(a.rgba.size())};
  const auto part = static_cast<float>(share);
  for (std::size_t i = 0; i < result.rgba.size(); ++i)
    result.rgba[i] = (1 - part) * a.rgba[i] + part * b.rgba[i];
  return result;
}

}  // namespace

Atmosphere<double> interpolated_atmosphere(const Atmosphere<double>& a, const Atmosphere<double>& b,
                                           double share) {
  require_comparable(a, b);
  if (share <= 0) return a;
  if (share >= 1) return b;
  Atmosphere<double> end = b, result = a;
  end.rayleigh.scattering_per_m =
      stated_at(b.rayleigh.scattering_per_m, a.rayleigh.scattering_per_m.wavelength_nm);
  end.mie.scattering_per_m =
      stated_at(b.mie.scattering_per_m, a.mie.scattering_per_m.wavelength_nm);
  for (const ParameterInfo& info : parameter_table())
    set_parameter(result, info.id,
                  std::lerp(get_parameter(a, info.id), get_parameter(end, info.id), share));
  result.rayleigh.depolarisation =
      std::lerp(a.rayleigh.depolarisation, b.rayleigh.depolarisation, share);
  result.rayleigh.site_pressure_hpa =
      std::lerp(a.rayleigh.site_pressure_hpa, b.rayleigh.site_pressure_hpa, share);
  return result;
}

AtmosphereTables interpolated_tables(const AtmosphereTables& a, const AtmosphereTables& b,
                                     double share) {
  require_same(a.color.nodes == b.color.nodes, "wavelengths of tables");
  require_same(a.sky_rays.mapping == b.sky_rays.mapping, "sky model of tables");
  return {interpolated_atmosphere(a.atmosphere, b.atmosphere, share),
          a.color,
          a.sizes,
          interpolated(a.optical_depth, b.optical_depth, share),
          interpolated(a.irradiance, b.irradiance, share),
          interpolated(a.rayleigh_like, b.rayleigh_like, share),
          interpolated(a.single_mie, b.single_mie, share),
          interpolated(a.phase, b.phase, share),
          {a.sky_rays.mapping, interpolated(a.sky_rays.air, b.sky_rays.air, share),
           interpolated(a.sky_rays.aerosol, b.sky_rays.aerosol, share)}};
}

}  // namespace skyfit
