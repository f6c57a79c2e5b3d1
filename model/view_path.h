// SPDX-License-Identifier: Apache-2.0
// One view ray prepared for any number of suns: its nodes at the solver's levels, the weights with
// which the source of multiple scattering at the nodes adds up to radiance, and that source as a
// Fourier series for every sun of the grid.
#pragma once

#include <vector>

#include "model/diffuse_field.h"
#include "model/ray.h"
#include "model/sun_grid.h"

namespace skyfit {

struct ViewPath {
  ViewRay ray;
  std::vector<RayPoint> nodes;  // ascending in s; empty when the ray misses the atmosphere
  struct Sample {
    RayPoint point;
    double weight;        // of the quadrature along s, metres
    PathColumns columns;  // from the entry
    int first = 0;        // interpolation between the nodes first .. first + count - 1
    int count = 0;
    double share[4] = {};
  };
  std::vector<Sample> samples;  // of the smooth source of multiple scattering
  PathColumns columns_to_end;
};
ViewPath view_path(const Shells& shells, const std::vector<double>& heights, double altitude,
                   double mu);

// Per wavelength. Layout of series: [node][mode][sun][slice].
template <int N>
struct PathSource {
  std::vector<Dual<N>> air_weight,
      aerosol_weight;  // per node, sr^0: radiance = sum weight * source
  int air_modes = 0, aerosol_modes = 0;
  std::vector<double> air_series, aerosol_series;
};

// One row of a field, [slice][sun], turned into [sun][slice].
std::vector<double> suns_first(const double* row, const FieldShape& shape);

template <int N>
PathSource<N> path_source(const Shells& shells, const Optics<N>& optics, const ViewPath& path,
                          const DiffuseField& field, int moments);

}  // namespace skyfit
