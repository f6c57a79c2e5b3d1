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

// For samples of a ray: e[i] = exp(-sum_k extinction[k] columns[k][i]) weight[i].
void weighted_transmittances(std::size_t count, const double* weight, std::size_t columns_count,
                             const double* const* columns, const double* extinction, double* e);

// out[i] = x[i] y[i]; returns sum_i out[i].
double product_and_sum(std::size_t count, const double* x, const double* y, double* out);

// sum_i x[i] y[i]
double dot(std::size_t count, const double* x, const double* y);

}  // namespace skyfit::kernels
