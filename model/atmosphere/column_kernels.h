// SPDX-License-Identifier: Apache-2.0
// Slant columns and sums along rays for many points at a time, with the widest vectors that the
// processor has (Highway, dispatched when the program runs). The same formulas as
// model/atmosphere/slant_column.h; lengths in metres.
#pragma once

#include <cstddef>

#include "model/atmosphere/linear_profile.h"

namespace skyfit::kernels {

struct Sphere {
  double bottom_radius, top;  // top is a height
};

// Columns of exp(-h / H) upward to the top and their derivatives by H, as exponential_column().
void exponential_columns(const Sphere& sphere, double scale_height, std::size_t count,
                         const double* height, const double* mu, double* value,
                         double* by_scale_height);

// Columns of a profile that is linear between corners, as linear_column().
void linear_columns(const Sphere& sphere, const LinearProfile& profile, std::size_t count,
                    const double* height, const double* mu, double* value);

// exp(-h / H)
void exponential_densities(double scale_height, std::size_t count, const double* height,
                           double* density);

// Sums over samples of a ray: with e = exp(-optical depth) weight and for each of the two densities
// rho, sum e rho, the same times each of the six columns (air, aerosol and ozone, then their
// derivatives by scale height), and times the height: 2 x 8 numbers.
struct RaySums {
  double plain, by_column[6], by_height;
};
void ray_sums(std::size_t count, const double* weight, const double* height,
              const double* const densities[2], const double* const columns[6],
              const double extinction[3], RaySums sums[2]);

}  // namespace skyfit::kernels
