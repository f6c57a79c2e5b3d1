// SPDX-License-Identifier: Apache-2.0
// A sky in closed form for the tests of the fit: single scattering of a plane-parallel, well mixed
// atmosphere seen from the ground, plus a isotropic share of the light that the ground throws back.
// Fast, smooth, and differentiated exactly by Jets; not meant to be true.
//
//   L = m (omega P)(nu) tau exp(-tau m_s) (1 - exp(-d)) / d + albedo mu_s exp(-tau m_s)
//       (1 - exp(-tau m)) / (4 pi),   d = tau (m - m_s), m = 1 / cos(view), m_s = 1 / cos(sun),
// times the ozone's exp(-tau_O3 m_s). The scale heights enter through the optical depths alone.
#pragma once

#include <ceres/jet.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "model/atmosphere/parameter_field.h"
#include "model/sky_model.h"

namespace skyfit::fit {

template <class T>
T toy_cornette_shanks(const T& g, double nu) {
  using std::pow;
  return 3.0 / (8.0 * std::numbers::pi) * (1.0 - g * g) * (1.0 + nu * nu) /
         ((2.0 + g * g) * pow(1.0 + g * g - 2.0 * g * nu, 1.5));
}

class ToySky : public SkyModel {
 public:
  static constexpr int kPlaces = 16;  // at least as many as standard_parameters()
  using Jet = ceres::Jet<double, kPlaces>;
  mutable std::atomic<int> value_calls = 0, derivative_calls = 0;

  std::string_view name() const override { return "toy"; }

  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override {
    ++(derivatives.empty() ? value_calls : derivative_calls);
    validate(atmosphere);
    SkyValues sky;
    sky.points = static_cast<int>(points.size());
    sky.wavelengths = static_cast<int>(wavelengths.size());
    sky.parameters = static_cast<int>(derivatives.size());
    sky.value.resize(points.size() * wavelengths.size());
    sky.derivative.resize(sky.value.size() * derivatives.size());
    for (std::size_t i = 0; i < sky.value.size(); ++i) {
      const Jet value = radiance_at(atmosphere, wavelengths[i % wavelengths.size()],
                                    points[i / wavelengths.size()]);
      sky.value[i] = value.a;
      for (std::size_t p = 0; p < derivatives.size(); ++p) {
        sky.derivative[p * sky.value.size() + i] = value.v[place_of(derivatives[p])];
      }
    }
    return sky;
  }

 private:
  // Among the standard parameters.
  static int place_of(const Parameter& id) {
    return static_cast<int>(std::ranges::find(standard_parameters(), id) -
                            standard_parameters().begin());
  }

  static Jet radiance_at(const Atmosphere<double>& atmosphere, const WavelengthNode& node,
                         const SkyPoint& point) {
    const auto p = [&](Parameter id) { return Jet(get_parameter(atmosphere, id), place_of(id)); };
    const double ratio = node.wavelength_nm / 550;
    const double nu = std::sin(point.sun_zenith) * std::sin(point.view_zenith) *
                          std::cos(point.relative_azimuth) +
                      std::cos(point.sun_zenith) * std::cos(point.view_zenith);
    const Jet rayleigh = p(Parameter::kRayleighScattering) * std::pow(ratio, -4.08) *
                         p(Parameter::kRayleighScaleHeight);
    const Jet mie = p(Parameter::kMieScattering) *
                    exp(-p(Parameter::kMieAngstromExponent) * std::log(ratio)) *
                    p(Parameter::kMieScaleHeight);
    Jet phase;
    if (atmosphere.at("mie").phase.type == PhaseType::kTwoLobe) {
      phase = p(Parameter::kMiePhaseWeight) * toy_cornette_shanks(p(Parameter::kMiePhaseG1), nu) +
              (1.0 - p(Parameter::kMiePhaseWeight)) *
                  toy_cornette_shanks(p(Parameter::kMiePhaseG2), nu);
    } else {
      phase = toy_cornette_shanks(p(Parameter::kMiePhaseG), nu);
    }
    const Jet tau = rayleigh + mie / p(Parameter::kMieSingleScatteringAlbedo);
    const double m = 1 / std::cos(point.view_zenith), m_s = 1 / std::cos(point.sun_zenith);
    const Jet d = tau * (m - m_s);
    const Jet slab = std::abs(d.a) < 1e-4 ? 1.0 - d * (0.5 - d / 6.0) : (1.0 - exp(-d)) / d;
    const Jet beam =
        exp(-tau * m_s - p(Parameter::kOzoneColumn) * 2.687e20 * node.ozone_cross_section_m2 * m_s);
    const Jet source = rayleigh * (3 / (16 * std::numbers::pi) * (1 + nu * nu)) + mie * phase;
    return beam * (m * source * slab + p(Parameter::kGroundAlbedo) / m_s * (1.0 - exp(-tau * m)) /
                                           (4 * std::numbers::pi));
  }
};

}  // namespace skyfit::fit
