// SPDX-License-Identifier: Apache-2.0
// Slant columns: the integral of a relative density along a straight ray from a point to the top of
// the atmosphere, in metres, in spherical geometry.
#pragma once

#include <array>

#include "model/atmosphere/linear_profile.h"

namespace skyfit {

// Derivatives by the parameters of a profile's shape: the scale height, or base and top.
inline constexpr std::size_t kMostShapes = 2;
using ByShape = std::array<double, kMostShapes>;

// A column and its derivatives by the shape (1).
struct Column {
  double value = 0;
  ByShape by_shape{};
};

// exp(-h / H) from height h upward to height top. mu is the cosine of the zenith angle at the
// point. A ray with mu < 0 must miss the ground-less planet below it: it passes its tangent point
// and leaves, whatever the height of that point. Chapman's function for r / H >> 1, as an expansion
// in H / r to second order about the error function; relative error below 1e-7 for r / H > 300.
Column exponential_column(double bottom_radius, double height, double mu, double top,
                          double scale_height);

// A profile that is linear between heights, from height h upward, mu >= 0 or tangent as above; by
// Gauss's rule in each linear piece, relative error below 1e-8.
double linear_column(const LinearProfile& profile, double bottom_radius, double height, double mu,
                     double top);

}  // namespace skyfit
