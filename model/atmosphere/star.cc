// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/star.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include "model/numerics/angles.h"

namespace skyfit {
namespace {

constexpr double kShortest = 360, kLongest = 830;  // nm: what luminance and colour need
constexpr double kBrightest = 1e9;  // W m^-2 nm^-1; sums over wavelengths stay finite in float

std::optional<TableFault> irradiance_fault(const TwoColumns& table) {
  if (auto fault = ascending_fault(kIrradianceFormat, table, {})) return fault;
  if (!(table.x.front() > 0 && table.x.front() <= kShortest))
    return TableFault{0, 0, {}, fmt::format("a wavelength > 0 and <= {} nm", kShortest)};
  if (!(table.x.back() >= kLongest))
    return TableFault{
        0, table.x.size() - 1, {}, fmt::format("a wavelength >= {} nm, the last", kLongest)};
  for (std::size_t i = 0; i < table.y.size(); ++i) {
    if (!(table.y[i] >= 0 && table.y[i] <= kBrightest))
      return TableFault{
          1, i, {}, fmt::format("an irradiance from 0 to {} W m^-2 nm^-1", kBrightest)};
  }
  return {};
}

void expect(bool holds, std::string_view path, double value, std::string_view expectation) {
  if (!holds || !std::isfinite(value))
    throw std::invalid_argument(fmt::format("{} = {}: expected {}", path, value, expectation));
}

}  // namespace

const TableFormat kIrradianceFormat{{"wavelength_nm", "irradiance_w_m2_nm"}, irradiance_fault};

double Star::angular_radius_rad() const { return 0.5 * angular_diameter_deg * kRadiansPerDegree; }

void validate(const Star& star) {
  expect(star.distance_au >= 1e-3 && star.distance_au <= 1e3, "star.distance_au", star.distance_au,
         "a distance from 0.001 to 1000 au");
  expect(star.temperature_k >= 1000 && star.temperature_k <= 1e5, "star.temperature_k",
         star.temperature_k, "a temperature from 1000 to 100000 K");
  expect(star.angular_diameter_deg >= 1e-4 && star.angular_diameter_deg <= 10,
         "star.angular_diameter_deg", star.angular_diameter_deg, "an angle from 0.0001 to 10 deg");
  const auto [u1, u2] = star.limb_darkening;
  expect(u1 >= 0 && u1 <= 1, "star.limb_darkening[0]", u1, "a number from 0 to 1");
  expect(u2 >= -1 && u1 + u2 <= 1, "star.limb_darkening[1]", u2,
         "a number >= -1 whose sum with the first is <= 1");
  if (star.spectrum == StarSpectrum::kTabulated && star.table == nullptr)
    throw std::invalid_argument("star.spectrum = tabulated: expected a table");
}

// docs/theory (10.2).
double black_body_irradiance(double wavelength_nm, double temperature_k,
                             double angular_radius_rad) {
  constexpr double kPlanck = 6.62607015e-34, kLight = 299792458, kBoltzmann = 1.380649e-23;
  const double lambda = 1e-9 * wavelength_nm, sine = std::sin(angular_radius_rad);
  const double radiance = 2 * kPlanck * kLight * kLight / std::pow(lambda, 5) /
                          std::expm1(kPlanck * kLight / (lambda * kBoltzmann * temperature_k));
  return std::numbers::pi * radiance * sine * sine * 1e-9;
}

}  // namespace skyfit
