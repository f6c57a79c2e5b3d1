// SPDX-License-Identifier: Apache-2.0
#include "model/literature/turbidity_sky.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <numbers>
#include <stdexcept>
#include <string>

#include "model/numerics/angles.h"

namespace skyfit::literature {
namespace {

constexpr double kUnitWavelength = 550;  // nm

}  // namespace

double turbidity_of(const Atmosphere<double>& atmosphere) {
  return turbidity_of(shells_of(atmosphere, Keep::kScatterers), seeded<0>(atmosphere, {})).v;
}

bool is_lit(const TurbidityDomain& domain, double turbidity) {
  if (std::isnan(turbidity)) return false;
  constexpr double kRounding = 1e-9;  // of the sums that make a turbidity
  if (turbidity >= domain.least - kRounding && turbidity <= domain.most + kRounding) return true;
  throw std::domain_error(
      fmt::format("{} model: turbidity (tau_R + tau_M) / tau_R = {:.9g}: must be in {} .. {}",
                  domain.model, turbidity, domain.least, domain.most));
}

bool is_aerosol_amount(const Parameter& parameter) {
  return parameter.constituent() == "mie" && (parameter.quantity() == Quantity::kScattering ||
                                              parameter.quantity() == Quantity::kOpticalDepth ||
                                              parameter.quantity() == Quantity::kExtinction);
}

SpectrumOfXyz::SpectrumOfXyz(const SpectralData& spectra) {
  const XyzRule sum = xyz_sum_5nm(spectra);
  Eigen::Matrix3d xyz_from_power = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < sum.nodes.size(); ++k) {
    const double u = sum.nodes[k].wavelength_nm / kUnitWavelength;
    const Eigen::RowVector3d powers(1, u, u * u);
    for (int c = 0; c < 3; ++c)
      xyz_from_power.row(c) += sum.weight[static_cast<std::size_t>(c)][k] * powers;
  }
  const Eigen::Matrix3d inverse = xyz_from_power.inverse();
  for (int power = 0; power < 3; ++power) {
    for (int c = 0; c < 3; ++c)
      power_from_xyz_[static_cast<std::size_t>(power)][static_cast<std::size_t>(c)] =
          inverse(power, c);
  }
}

std::array<double, 3> SpectrumOfXyz::at(double wavelength_nm) const {
  const double u = wavelength_nm / kUnitWavelength;
  std::array<double, 3> sum{};
  for (std::size_t c = 0; c < 3; ++c)
    sum[c] = power_from_xyz_[0][c] + u * (power_from_xyz_[1][c] + u * power_from_xyz_[2][c]);
  return sum;
}

void check_formula_points(const TurbidityDomain& domain, std::span<const SkyPoint> points) {
  check_daylight(domain.model, points, domain.highest_m);
  for (const SkyPoint& point : points) {
    check_model_value(domain.model, point.view_zenith < 0.5 * std::numbers::pi, "view zenith (deg)",
                      point.view_zenith * kDegreesPerRadian,
                      "below 90: the model has the sky alone");
  }
}

SkyRayTables rays_of_formula(const TurbidityDomain& domain, SkyRayMapping mapping,
                             const SpectrumOfXyz& spectrum, const Atmosphere<double>& atmosphere,
                             std::span<const WavelengthNode, 4> nodes) {
  check_request(domain.model, atmosphere, {}, {});
  check_exponential(domain.model, atmosphere);
  SkyRayTables rays =
      closed_form(mapping, {std::string(domain.model), domain.highest_m}, atmosphere);
  const double turbidity = turbidity_of(atmosphere);
  const bool lit = is_lit(domain, turbidity);
  // Of a dark sky any turbidity does: radiance_from_xyz is 0.
  rays.formula.turbidity = lit ? turbidity : domain.least;
  if (!lit) return rays;
  for (std::size_t k = 0; k < 4; ++k)
    rays.formula.radiance_from_xyz[k] = spectrum.at(nodes[k].wavelength_nm);
  return rays;
}

}  // namespace skyfit::literature
