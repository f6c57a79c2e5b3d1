// SPDX-License-Identifier: Apache-2.0
// Exact derivatives of the reference model equal central differences, parameter by parameter, in
// the middle of the bounds (by day and in twilight) and at them (by day: a twilight takes many
// times as long), looking up, along the horizon, down, and from space.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data_refs/spectra.h"
#include "model/registry.h"
#include "model/sky_model.h"
#include "tests/atmospheres.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Central differences with a step of 2e-5 are themselves off by the third derivative (1e-6 in thick
// haze), and by the order at which the two sums over orders end; both far below this share of the
// largest derivative of the list of points.
constexpr double kDifference = 1e-5;

const std::vector<double> kDay = {0, 40, 75, 86};  // sun zenith angles, deg
const std::vector<double> kDayAndTwilight = {0, 40, 75, 88, 90, 93};

std::vector<SkyPoint> points(const std::vector<double>& suns = kDayAndTwilight) {
  std::vector<SkyPoint> list;
  for (const double sun : suns) {
    for (const double view : {0.0, 50.0, 85.0, 90.0}) {
      for (const double azimuth : {20.0, 130.0})
        list.push_back({0, sun * kDegree, view * kDegree, azimuth * kDegree});
    }
  }
  for (const double view : {30.0, 91.0, 120.0, 180.0})
    list.push_back({8e3, 50 * kDegree, view * kDegree, 1});
  for (const double view : {150.0, 159.0, 180.0})
    list.push_back({8e5, 50 * kDegree, view * kDegree, 1});
  return list;
}

Atmosphere<double> atmosphere(PhaseType type) {
  Atmosphere<double> a;
  set_scattering(a.at("mie"), 550, 1.5e-4, 1.1);
  a.at("mie").phase = {type, 0.7, 0.75, 0.2, 0.4};
  return a;
}

// `side` 0: central differences; 1 or -1: one-sided ones of second order, into the bounds.
void expect_exact(const Atmosphere<double>& a, Parameter parameter,
                  const std::vector<double>& suns = kDayAndTwilight, int side = 0) {
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  const std::vector<WavelengthNode> nodes =
      spectral_nodes(refs::standard_spectral_data(), {460, 600});
  const std::vector<SkyPoint> list = points(suns);
  const SkyValues exact = model->radiance(a, nodes, list, {&parameter, 1});
  const ParameterInfo info = parameter_info(parameter);
  const double step =
      2e-5 * std::max(std::abs(get_parameter(a, parameter)), 1e-3 * (info.upper - info.lower));
  auto at = [&](double value) {
    Atmosphere<double> b = a;
    set_parameter(b, parameter, value);
    return model->radiance(b, nodes, list, {});
  };
  const double middle = get_parameter(a, parameter);
  const SkyValues one = at(middle + (side == 0 ? 1 : side) * step),
                  other = at(middle + (side == 0 ? -1 : 2 * side) * step);
  for (std::size_t i = 0; i < exact.value.size(); ++i) {
    const double difference =
        side == 0 ? (one.value[i] - other.value[i]) / (2 * step)
                  : side * (4 * one.value[i] - other.value[i] - 3 * exact.value[i]) / (2 * step);
    // A derivative is compared with the radiance that it changes over the parameter's own size as
    // well: where it crosses zero, a relative error has no meaning.
    const double scale = std::max(std::abs(difference),
                                  exact.value[i] / std::max(std::abs(middle), 0.1 * info.upper));
    EXPECT_NEAR(exact.derivative[i], difference, kDifference * scale)
        << info.name << " at point " << i / nodes.size() << " wavelength " << i % nodes.size();
  }
}

TEST(SlowDerivatives, OfEveryParameterWithTwoLobes) {
  const Atmosphere<double> a = atmosphere(PhaseType::kTwoLobe);
  for (const Parameter& id : standard_parameters()) {
    if (has_parameter(a, id)) expect_exact(a, id);
  }
}

TEST(Derivatives, OfTheAsymmetryOfOneLobe) {
  expect_exact(atmosphere(PhaseType::kCornetteShanks), Parameter::kMiePhaseG);
  expect_exact(atmosphere(PhaseType::kHenyeyGreenstein), Parameter::kMiePhaseG);
}

// Near the bounds, so that both differences stay physical.
TEST(SlowDerivatives, NearTheBounds) {
  for (const Parameter& id : standard_parameters()) {
    for (const double share : {0.002, 0.998}) {
      Atmosphere<double> a = atmosphere(PhaseType::kTwoLobe);
      if (!has_parameter(a, id)) continue;
      const ParameterInfo info = parameter_info(id);
      set_parameter(a, id, info.lower + share * (info.upper - info.lower));
      expect_exact(a, id, kDay);
    }
  }
}

TEST(SlowDerivatives, AtTheBounds) {
  for (const Parameter& id : standard_parameters()) {
    for (const int side : {1, -1}) {
      Atmosphere<double> a = atmosphere(PhaseType::kTwoLobe);
      if (!has_parameter(a, id)) continue;
      set_parameter(a, id, side > 0 ? parameter_info(id).lower : parameter_info(id).upper);
      expect_exact(a, id, kDay, side);
    }
  }
}

TEST(Derivatives, ComeWithTheSameValues) {
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 1);
  const Atmosphere<double> a = atmosphere(PhaseType::kTwoLobe);
  const std::vector<WavelengthNode> nodes = spectral_nodes(refs::standard_spectral_data(), {550});
  const std::vector<Parameter> two = {Parameter::kMieScattering, Parameter::kGroundAlbedo};
  const SkyValues plain = model->radiance(a, nodes, points(), {});
  const SkyValues with = model->radiance(a, nodes, points(), two);
  constexpr double kEndOfOrders = 1e-5;  // the derivatives may ask for one more order of scattering
  for (std::size_t i = 0; i < plain.value.size(); ++i) {
    EXPECT_NEAR(with.value[i], plain.value[i], kEndOfOrders * plain.value[i]);
  }
}

}  // namespace
}  // namespace skyfit
