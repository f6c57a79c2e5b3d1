// SPDX-License-Identifier: Apache-2.0
#include "model/literature/preetham.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "model/literature/evaluate.h"
#include "model/numerics/angles.h"
#include "model/shared/preetham.h"

namespace skyfit {

// Found by the formulas of model/shared/preetham.glsl.
template <int N>
Dual<N> cos(const Dual<N>& x) {
  return x.chain(std::cos(x.v), -std::sin(x.v));
}
template <int N>
Dual<N> tan(const Dual<N>& x) {
  const double tangent = std::tan(x.v);
  return x.chain(tangent, 1 + tangent * tangent);
}

namespace {

constexpr std::string_view kName = "preetham";
constexpr double kUnitWavelength = 550;  // nm

constexpr double kHighest = 3e3;  // m
constexpr double kLeastTurbidity = 1.7, kMostTurbidity = 10;

template <int N>
std::array<Dual<N>, 3> xyz_of(const Dual<N>& t, double mu, double gamma, double sun_zenith) {
  SharedPreetham<Dual<N>> shared;
  const Dual<N> luminance = shared.preetham_luminance(t, mu, gamma, sun_zenith),
                x = shared.preetham_x(t, mu, gamma, sun_zenith),
                y = shared.preetham_y(t, mu, gamma, sun_zenith);
  return {luminance * x / y, luminance, luminance * (Dual<N>(1.0) - x - y) / y};
}

template <int N>
Dual<N> turbidity_of(const Shells& shells, const Atmosphere<Dual<N>>& atmosphere) {
  const auto air = literature::clear_air(shells, atmosphere, {kUnitWavelength, 0});
  const auto column = [&](int profile, const Dual<N>& scale_height) {
    if (profile < 0) return Dual<N>();
    const Column unit = air.profiles[static_cast<std::size_t>(profile)].vertical_column();
    return scale_height.chain(unit.value, unit.by_shape[0]);
  };
  return Dual<N>(1.0) + air.aerosol_extinction *
                            column(air.aerosol_profile, air.aerosol_scale_height) /
                            (air.air * column(air.air_profile, air.air_scale_height));
}

void check_view(const SkyPoint& point) {
  check_model_value(kName, point.view_zenith < 0.5 * std::numbers::pi, "view zenith (deg)",
                    point.view_zenith * kDegreesPerRadian, "below 90: the model has the sky alone");
}

// Whether there is air. Throws std::domain_error where its turbidity is not of those of the paper.
bool has_air(double turbidity) {
  if (std::isnan(turbidity)) return false;
  if (turbidity >= kLeastTurbidity && turbidity <= kMostTurbidity) return true;
  throw std::domain_error(
      fmt::format("{} model: turbidity (tau_R + tau_M) / tau_R = {:.9g}: must be in {} .. {}",
                  kName, turbidity, kLeastTurbidity, kMostTurbidity));
}

}  // namespace

double preetham_turbidity(const Atmosphere<double>& atmosphere) {
  return turbidity_of(shells_of(atmosphere, Keep::kScatterers), seeded<0>(atmosphere, {})).v;
}

PreethamModel::PreethamModel(const SpectralData& spectra) {
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

SkyValues PreethamModel::radiance(const Atmosphere<double>& atmosphere,
                                  std::span<const WavelengthNode> wavelengths,
                                  std::span<const SkyPoint> points,
                                  std::span<const Parameter> derivatives) const {
  literature::check_request(kName, atmosphere, points, derivatives);
  literature::check_daylight(kName, points, kHighest);
  for (const SkyPoint& point : points) check_view(point);
  const bool dark = !has_air(preetham_turbidity(atmosphere));
  const Shells shells = shells_of(atmosphere, Keep::kScatterers);
  return literature::evaluate<literature::kAllAtOnce>(
      atmosphere, wavelengths, points.size(), derivatives,
      [&]<int N>(const Atmosphere<Dual<N>>& air, const WavelengthNode& node,
                 std::span<Dual<N>> out) {
        const Dual<N> turbidity = turbidity_of(shells, air);
        const std::array<double, 3> from_xyz = radiance_from_xyz(node.wavelength_nm);
        for (std::size_t i = 0; i < points.size(); ++i) {
          out[i] = Dual<N>(0.0);
          if (dark) continue;
          const double nu = literature::view_of(atmosphere, points[i]).nu;
          const std::array<Dual<N>, 3> xyz = xyz_of(turbidity, std::cos(points[i].view_zenith),
                                                    std::acos(nu), points[i].sun_zenith);
          for (std::size_t c = 0; c < 3; ++c) out[i] += from_xyz[c] * xyz[c];
        }
      });
}

std::array<double, 3> PreethamModel::radiance_from_xyz(double wavelength_nm) const {
  const double u = wavelength_nm / kUnitWavelength;
  std::array<double, 3> sum{};
  for (std::size_t c = 0; c < 3; ++c)
    sum[c] = power_from_xyz_[0][c] + u * (power_from_xyz_[1][c] + u * power_from_xyz_[2][c]);
  return sum;
}

std::optional<SkyRayTables> PreethamModel::sky_rays(
    const Atmosphere<double>& atmosphere, std::span<const WavelengthNode, 4> nodes) const {
  literature::check_request(kName, atmosphere, {}, {});
  literature::check_exponential(kName, atmosphere);
  SkyRayTables rays =
      literature::closed_form(SkyRayMapping::kPreetham, {std::string(kName), kHighest}, atmosphere);
  const double turbidity = preetham_turbidity(atmosphere);
  // Without air any turbidity does: radiance_from_xyz is 0.
  rays.preetham.turbidity = has_air(turbidity) ? turbidity : kLeastTurbidity;
  if (!has_air(turbidity)) return rays;
  for (std::size_t k = 0; k < 4; ++k)
    rays.preetham.radiance_from_xyz[k] = radiance_from_xyz(nodes[k].wavelength_nm);
  return rays;
}

bool PreethamModel::can_fit(const Parameter& parameter) const {
  return parameter.constituent() == "mie" && (parameter.quantity() == Quantity::kScattering ||
                                              parameter.quantity() == Quantity::kOpticalDepth ||
                                              parameter.quantity() == Quantity::kExtinction);
}

}  // namespace skyfit
