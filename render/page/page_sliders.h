// SPDX-License-Identifier: Apache-2.0
// Which parameters of an atmosphere a page lets its reader change, and how far.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "model/atmosphere/parameters.h"

namespace skyfit {

struct PageSlider {
  Parameter parameter;
  double low, value, high;           // low <= value <= high, low < high; in the parameter's unit
  bool logarithmic;                  // moves evenly in the logarithm
  std::optional<double> sigma = {};  // of a fit

  // The two values besides the preset's for which a page has tables: the ends, or where the
  // preset's value is an end, the other end and half-way to it. Ascending.
  std::array<double, 2> tabulated() const;
  // Half-way between two values, in what the slider is even in.
  double half_way(double from, double to) const;
};

// Amounts, scale heights and single scattering albedos of aerosols, the asymmetry of their only or
// narrower lobe where it is theirs alone, the ground's albedo: those of them that the atmosphere
// has.
std::vector<Parameter> main_parameters(const Atmosphere<double>& atmosphere);

// About the atmosphere's value and within the bounds of a fit: amounts from half to twice it,
// heights and radii from two thirds to one and a half, others by a difference. Parameters for which
// that is no range (an amount of 0) get none.
std::vector<PageSlider> page_sliders(const Atmosphere<double>& atmosphere,
                                     std::span<const Parameter> parameters);

// The shares of the changes at tabulated() that stand for a value of the slider: the parabola
// through them and no change at the preset's value, in what the slider is even in.
std::array<double, 2> change_shares(const PageSlider& slider, double value);

}  // namespace skyfit
