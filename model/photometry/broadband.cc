// SPDX-License-Identifier: Apache-2.0
#include "model/photometry/broadband.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "model/numerics/angles.h"

namespace skyfit {
namespace {

constexpr double kFirstNm = 300, kLastNm = 2500, kEndNm = 4000, kStepNm = 5;

// Close together where ozone and the air change fast; between them quantities per unit solar
// irradiance are linear in wavelength.
constexpr std::array<double, 18> kNodesNm = {300, 310, 320, 335, 350, 380,  420,  470,  530,
                                             570, 600, 650, 690, 800, 1000, 1300, 1700, 2500};

struct FineBin {
  double wavelength_nm, irradiance;  // W/m^2
};

// Bins of 5 nm, the first half as wide; beyond the table those of a black body of the sun's
// temperature.
std::vector<FineBin> solar_bins(const SpectralData& data) {
  if (!data.solar_irradiance.covers(kFirstNm) || !data.solar_irradiance.covers(kLastNm)) {
    throw std::invalid_argument(
        "broadband irradiance: expected a star whose spectrum reaches from 300 to 2500 nm");
  }
  const Star sun;
  std::vector<FineBin> bins;
  for (double nm = kFirstNm; nm <= kEndNm; nm += kStepNm) {
    const double irradiance =
        nm <= kLastNm ? data.solar_irradiance.at(nm)
                      : black_body_irradiance(nm, sun.temperature_k, sun.angular_radius_rad());
    bins.push_back({nm, (nm == kFirstNm ? 0.5 : 1.0) * kStepNm * irradiance});
  }
  return bins;
}

}  // namespace

double relative_air_mass(double sun_zenith) {
  return 1 / (std::cos(sun_zenith) +
              0.50572 * std::pow(96.07995 - sun_zenith * kDegreesPerRadian, -1.6364));
}

double gas_transmittance(const GasAbsorption& gases, double wavelength_nm, double air_mass,
                         double precipitable_water_mm) {
  constexpr double kCmPerMm = 0.1;
  const double water = gases.water_vapour.at_or_zero(wavelength_nm) * kCmPerMm *
                       precipitable_water_mm * air_mass,
               mixed = gases.mixed_gases.at_or_zero(wavelength_nm) * air_mass;
  return std::exp(-0.2385 * water / std::pow(1 + 20.07 * water, 0.45) -
                  1.41 * mixed / std::pow(1 + 118.3 * mixed, 0.45));
}

BroadbandRule broadband_rule(const SpectralData& data, const GasAbsorption& gases,
                             double sun_zenith, double precipitable_water_mm) {
  if (!(sun_zenith >= 0 && sun_zenith < 0.5 * std::numbers::pi) ||
      !(precipitable_water_mm >= 0 && std::isfinite(precipitable_water_mm))) {
    throw std::invalid_argument(fmt::format(
        "broadband irradiance: sun zenith {:.6g} deg, precipitable water {:.6g} mm: must be 0 to "
        "90 deg and >= 0 mm",
        sun_zenith * kDegreesPerRadian, precipitable_water_mm));
  }
  const double air_mass = relative_air_mass(sun_zenith);
  BroadbandRule rule{spectral_nodes(data, {kNodesNm.begin(), kNodesNm.end()}),
                     std::vector<double>(kNodesNm.size())};
  std::size_t k = 0;
  for (const FineBin& bin : solar_bins(data)) {
    while (k + 2 < kNodesNm.size() && bin.wavelength_nm > kNodesNm[k + 1]) ++k;
    const double share =
        std::min((bin.wavelength_nm - kNodesNm[k]) / (kNodesNm[k + 1] - kNodesNm[k]), 1.0);
    const double left = bin.irradiance * gas_transmittance(gases, bin.wavelength_nm, air_mass,
                                                           precipitable_water_mm);
    rule.weight[k] += (1 - share) * left;
    rule.weight[k + 1] += share * left;
  }
  return rule;
}

}  // namespace skyfit
