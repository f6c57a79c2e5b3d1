// SPDX-License-Identifier: Apache-2.0
#include "render/page/page_sliders.h"

#include <algorithm>
#include <cmath>

#include "model/atmosphere/atmosphere.h"
#include "model/tables/phase_classes.h"

namespace skyfit {
namespace {

// How far from the preset's value the ends are: by a factor, or where that is 0 by a difference.
struct Reach {
  double factor, difference;
};

Reach reach_of(Quantity quantity) {
  constexpr Reach kAmount{2, 0}, kLength{1.5, 0};
  switch (quantity) {
    case Quantity::kScattering:
    case Quantity::kExtinction:
    case Quantity::kOpticalDepth:
    case Quantity::kColumn:
    case Quantity::kVolume:
    case Quantity::kIndexImaginary:
      return kAmount;
    case Quantity::kPressure:
    case Quantity::kScaleHeight:
    case Quantity::kRadius:
      return kLength;
    case Quantity::kBase:
    case Quantity::kTop:
    case Quantity::kWidth:
      return {1.3, 0};
    case Quantity::kAngstromExponent:
      return {0, 1};
    case Quantity::kSingleScatteringAlbedo:
      return {0, 0.1};
    case Quantity::kPhaseG:
    case Quantity::kPhaseG1:
    case Quantity::kPhaseG2:
      return {0, 0.05};
    case Quantity::kPhaseWeight:
      return {0, 0.3};
    case Quantity::kAlbedo:
      return {0, 0.15};
    case Quantity::kIndexReal:
      return {0, 0.05};
  }
  return kAmount;
}

bool is_main(const Atmosphere<double>& atmosphere, const Parameter& parameter) {
  switch (parameter.quantity()) {
    case Quantity::kScattering:
    case Quantity::kExtinction:
    case Quantity::kOpticalDepth:
    case Quantity::kColumn:
    case Quantity::kPressure:
    case Quantity::kVolume:
    case Quantity::kSingleScatteringAlbedo:
    case Quantity::kPhaseG:
    case Quantity::kPhaseG1:
    case Quantity::kAlbedo:
      return true;
    case Quantity::kScaleHeight:
      return atmosphere.at(parameter.constituent()).phase.type != PhaseType::kRayleigh;
    default:
      return false;
  }
}

// A page's tables have one class of light for each phase function; where two constituents share
// one, another value would part them.
bool shares_its_phase(const Atmosphere<double>& atmosphere, const PhaseClasses& phases,
                      const Parameter& parameter) {
  if (parameter.quantity() != Quantity::kPhaseG && parameter.quantity() != Quantity::kPhaseG1)
    return false;
  const Constituent<double>* const own = &atmosphere.at(parameter.constituent());
  const auto kind = [&](const Constituent<double>& c) {
    return phases.of_constituent[static_cast<std::size_t>(&c - atmosphere.constituents.data())];
  };
  return std::ranges::any_of(atmosphere.constituents, [&](const Constituent<double>& other) {
    return &other != own && scatters(other) && kind(other) == kind(*own);
  });
}

}  // namespace

std::vector<Parameter> main_parameters(const Atmosphere<double>& atmosphere) {
  std::vector<Parameter> parameters = parameters_of(atmosphere);
  const PhaseClasses phases = phase_classes(atmosphere);
  std::erase_if(parameters, [&](const Parameter& p) {
    return !is_main(atmosphere, p) || shares_its_phase(atmosphere, phases, p);
  });
  return parameters;
}

std::vector<PageSlider> page_sliders(const Atmosphere<double>& atmosphere,
                                     std::span<const Parameter> parameters) {
  std::vector<PageSlider> sliders;
  for (const Parameter& parameter : parameters) {
    const double value = get_parameter(atmosphere, parameter);
    const ParameterInfo info = parameter_info(parameter);
    const Reach reach = reach_of(parameter.quantity());
    const bool logarithmic = reach.factor > 0;
    const double low = logarithmic ? value / reach.factor : value - reach.difference,
                 high = logarithmic ? value * reach.factor : value + reach.difference;
    const PageSlider slider{parameter, std::max(low, std::min(info.lower, value)), value,
                            std::min(high, std::max(info.upper, value)), logarithmic};
    if (slider.low < slider.high && (!logarithmic || slider.low > 0)) sliders.push_back(slider);
  }
  return sliders;
}

std::array<double, 2> PageSlider::tabulated() const {
  if (low == value) return {half_way(value, high), high};
  if (high == value) return {low, half_way(value, low)};
  return {low, high};
}

double PageSlider::half_way(double from, double to) const {
  return logarithmic ? std::sqrt(from * to) : 0.5 * (from + to);
}

std::array<double, 2> change_shares(const PageSlider& slider, double value) {
  const auto even = [&](double x) {
    return slider.logarithmic ? std::log(x / slider.value) : x - slider.value;
  };
  const auto [first, second] = slider.tabulated();
  const double at = even(value), a = even(first), b = even(second);
  return {at * (at - b) / (a * (a - b)), at * (at - a) / (b * (b - a))};
}

}  // namespace skyfit
