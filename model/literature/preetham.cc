// SPDX-License-Identifier: Apache-2.0
#include "model/literature/preetham.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <numbers>
#include <stdexcept>

#include "model/literature/evaluate.h"
#include "model/numerics/angles.h"
#include "model/shared/shared.h"

namespace skyfit {
namespace {

constexpr std::string_view kName = "preetham";
constexpr double kUnitWavelength = 550;  // nm

// a T + b
struct Line {
  double slope, offset;
  template <class T>
  T at(const T& turbidity) const {
    return slope * turbidity + T(offset);
  }
};
// A to E of F, appendix A.2.
using Distribution = std::array<Line, 5>;
constexpr Distribution kLuminance = {{{0.1787, -1.4630},
                                      {-0.3554, 0.4275},
                                      {-0.0227, 5.3251},
                                      {0.1206, -2.5771},
                                      {-0.0670, 0.3703}}};
constexpr Distribution kChromaticityX = {{{-0.0193, -0.2592},
                                          {-0.0665, 0.0008},
                                          {-0.0004, 0.2125},
                                          {-0.0641, -0.8989},
                                          {-0.0033, 0.0452}}};
constexpr Distribution kChromaticityY = {{{-0.0167, -0.2608},
                                          {-0.0950, 0.0092},
                                          {-0.0079, 0.2102},
                                          {-0.0441, -1.6537},
                                          {-0.0109, 0.0529}}};

// [T^2 T 1] M [Zs^3 Zs^2 Zs 1], appendix A.2.
using ZenithMatrix = std::array<std::array<double, 4>, 3>;
constexpr ZenithMatrix kZenithX = {{{0.00166, -0.00375, 0.00209, 0},
                                    {-0.02903, 0.06377, -0.03202, 0.00394},
                                    {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr ZenithMatrix kZenithY = {{{0.00275, -0.00610, 0.00317, 0},
                                    {-0.04214, 0.08970, -0.04153, 0.00516},
                                    {0.15346, -0.26756, 0.06670, 0.26688}}};

struct Direction {
  double mu, gamma, sun_zenith;
};

// F(Z, gamma) / F(0, Z_sun)
template <class T>
T relative(const Distribution& distribution, const T& t, const Direction& at) {
  using std::exp;
  const auto f = [&](double mu, double gamma) {
    const T a = distribution[0].at(t), b = distribution[1].at(t), c = distribution[2].at(t),
            d = distribution[3].at(t), e = distribution[4].at(t);
    const double nu = std::cos(gamma);
    return (T(1.0) + a * exp(b * (1 / mu))) * (T(1.0) + c * exp(d * gamma) + e * (nu * nu));
  };
  return f(at.mu, at.gamma) / f(1, at.sun_zenith);
}

template <class T>
T zenith_chromaticity(const ZenithMatrix& m, const T& t, double sun) {
  const auto row = [&](std::size_t k) {
    return ((m[k][0] * sun + m[k][1]) * sun + m[k][2]) * sun + m[k][3];
  };
  return (row(0) * t + T(row(1))) * t + T(row(2));
}

// cd/m^2, appendix A.2.
template <int N>
Dual<N> zenith_luminance(const Dual<N>& t, double sun) {
  const Dual<N> chi = (Dual<N>(4.0 / 9) - t * (1.0 / 120)) * (std::numbers::pi - 2 * sun);
  const double tangent = std::tan(chi.v);
  return 1000 * ((4.0453 * t - Dual<N>(4.9710)) * chi.chain(tangent, 1 + tangent * tangent) -
                 0.2155 * t + Dual<N>(2.4192));
}

template <int N>
std::array<Dual<N>, 3> xyz_of(const Dual<N>& t, const Direction& at) {
  const Dual<N> luminance = zenith_luminance(t, at.sun_zenith) * relative(kLuminance, t, at),
                x = zenith_chromaticity(kZenithX, t, at.sun_zenith) *
                    relative(kChromaticityX, t, at),
                y = zenith_chromaticity(kZenithY, t, at.sun_zenith) *
                    relative(kChromaticityY, t, at);
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

void check_turbidity(double turbidity) {
  if (turbidity >= 1.7 && turbidity <= 10) return;
  throw std::domain_error(
      fmt::format("{} model: turbidity (tau_R + tau_M) / tau_R = {:.9g}: must be in 1.7 .. 10",
                  kName, turbidity));
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
  literature::check_daylight(kName, points, 0);
  for (const SkyPoint& point : points) check_view(point);
  check_turbidity(preetham_turbidity(atmosphere));
  const Shells shells = shells_of(atmosphere, Keep::kScatterers);
  return literature::evaluate<literature::kAllAtOnce>(
      atmosphere, wavelengths, points.size(), derivatives,
      [&]<int N>(const Atmosphere<Dual<N>>& air, const WavelengthNode& node,
                 std::span<Dual<N>> out) {
        const Dual<N> turbidity = turbidity_of(shells, air);
        const double u = node.wavelength_nm / kUnitWavelength;
        for (std::size_t i = 0; i < points.size(); ++i) {
          const double nu = literature::view_of(atmosphere, points[i]).nu;
          const std::array<Dual<N>, 3> xyz = xyz_of(
              turbidity, {std::cos(points[i].view_zenith), std::acos(nu), points[i].sun_zenith});
          out[i] = Dual<N>(0.0);
          for (std::size_t c = 0; c < 3; ++c) {
            out[i] +=
                (power_from_xyz_[0][c] + u * (power_from_xyz_[1][c] + u * power_from_xyz_[2][c])) *
                xyz[c];
          }
        }
      });
}

bool PreethamModel::can_fit(const Parameter& parameter) const {
  return parameter.constituent() == "mie" && (parameter.quantity() == Quantity::kScattering ||
                                              parameter.quantity() == Quantity::kOpticalDepth ||
                                              parameter.quantity() == Quantity::kExtinction);
}

}  // namespace skyfit
