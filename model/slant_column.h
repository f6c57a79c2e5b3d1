// SPDX-License-Identifier: Apache-2.0
// Slant columns: the integral of a relative density along a straight ray from a point to the top of
// the atmosphere, in metres, in spherical geometry and closed form.
#pragma once

namespace skyfit {

// A column and its derivative by the scale height (1).
struct Column {
  double value = 0;
  double by_scale_height = 0;
};

// exp(-h / H) from height h upward to height top. mu is the cosine of the zenith angle at the
// point. A ray with mu < 0 must miss the ground-less planet below it: it passes its tangent point
// and leaves, whatever the height of that point. Chapman's function for r / H >> 1, as an expansion
// in H / r to second order about the error function; relative error below 1e-7 for r / H > 300.
Column exponential_column(double bottom_radius, double height, double mu, double top,
                          double scale_height);

// The ozone tent (0 at 10 km, 1 at 25 km, 0 at 40 km) from height h upward, mu >= 0 or tangent as
// above; by Gauss's rule in each linear piece, relative error below 1e-9.
double tent_column(double bottom_radius, double height, double mu, double top);

inline constexpr double kTentBottom = 10e3, kTentPeak = 25e3, kTentTop = 40e3;

}  // namespace skyfit
