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

constexpr double kFirstNm = 300, kLastNm = 2500, kStepNm = 5, kInfraredNm = 690;

// Close together where ozone and the air change fast; between them quantities per unit solar
// irradiance are linear in wavelength.
constexpr std::array<double, 18> kNodesNm = {300, 310, 320, 335, 350, 380,  420,  470,  530,
                                             570, 600, 650, 690, 800, 1000, 1300, 1700, 2500};

// W/m^2 of the sun at 1 au beyond 2500 nm: a black body of its temperature (Planck), which in
// wavelength falls as its fourth power at last.
double solar_tail() {
  const Star sun;
  constexpr double kFarNm = 100000, kRatio = 1.01;
  double sum = 0;
  for (double nm = kLastNm; nm < kFarNm; nm *= kRatio) {
    const double middle = nm * std::sqrt(kRatio);
    sum += nm * (kRatio - 1) *
           black_body_irradiance(middle, sun.temperature_k, sun.angular_radius_rad());
  }
  return sum;
}

struct FineBin {
  double wavelength_nm, irradiance;  // W/m^2
};

// Bins of 5 nm; those at the ends are half as wide, and the tail beyond is added to the last.
std::vector<FineBin> solar_bins(const SpectralData& data) {
  if (!data.solar_irradiance.covers(kFirstNm) || !data.solar_irradiance.covers(kLastNm)) {
    throw std::invalid_argument(
        "broadband irradiance: expected a star whose spectrum reaches from 300 to 2500 nm");
  }
  std::vector<FineBin> bins;
  for (double nm = kFirstNm; nm <= kLastNm; nm += kStepNm) {
    const double width = nm == kFirstNm || nm == kLastNm ? 0.5 * kStepNm : kStepNm;
    bins.push_back({nm, width * data.solar_irradiance.at(nm)});
  }
  bins.back().irradiance += solar_tail();
  return bins;
}

}  // namespace

double relative_air_mass(double sun_zenith) {
  return 1 / (std::cos(sun_zenith) +
              0.50572 * std::pow(96.07995 - sun_zenith * kDegreesPerRadian, -1.6364));
}

double broadband_gas_absorptance(double air_mass, double precipitable_water_mm) {
  constexpr double kMmPerCm = 10;
  const double water = air_mass * precipitable_water_mm / kMmPerCm;  // cm along the path
  const double of_water = 2.4959 * water / (std::pow(1 + 79.034 * water, 0.6828) + 6.385 * water);
  const double of_mixed_gases = 1 - std::exp(-0.0127 * std::pow(air_mass, 0.26));
  return 1 - (1 - of_water) * (1 - of_mixed_gases);
}

BroadbandRule broadband_rule(const SpectralData& data, double sun_zenith,
                             double precipitable_water_mm) {
  if (!(sun_zenith >= 0 && sun_zenith < 0.5 * std::numbers::pi) ||
      !(precipitable_water_mm >= 0 && std::isfinite(precipitable_water_mm))) {
    throw std::invalid_argument(fmt::format(
        "broadband irradiance: sun zenith {:.6g} deg, precipitable water {:.6g} mm: must be 0 to "
        "90 deg and >= 0 mm",
        sun_zenith * kDegreesPerRadian, precipitable_water_mm));
  }
  const std::vector<FineBin> bins = solar_bins(data);
  double all = 0, infrared = 0;
  for (const FineBin& bin : bins) {
    all += bin.irradiance;
    if (bin.wavelength_nm > kInfraredNm) infrared += bin.irradiance;
  }
  const double absorbed =
      broadband_gas_absorptance(relative_air_mass(sun_zenith), precipitable_water_mm);
  const double infrared_left = std::max(0.0, 1 - absorbed * all / infrared);
  BroadbandRule rule{spectral_nodes(data, {kNodesNm.begin(), kNodesNm.end()}),
                     std::vector<double>(kNodesNm.size())};
  std::size_t k = 0;
  for (const FineBin& bin : bins) {
    while (k + 2 < kNodesNm.size() && bin.wavelength_nm > kNodesNm[k + 1]) ++k;
    const double share = (bin.wavelength_nm - kNodesNm[k]) / (kNodesNm[k + 1] - kNodesNm[k]);
    const double left = bin.irradiance * (bin.wavelength_nm > kInfraredNm ? infrared_left : 1.0);
    rule.weight[k] += (1 - share) * left;
    rule.weight[k + 1] += share * left;
  }
  return rule;
}

}  // namespace skyfit
