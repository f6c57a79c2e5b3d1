// SPDX-License-Identifier: Apache-2.0
// The diffuse field of the atmosphere for a list of local sun angles: successive orders of
// scattering until they no longer matter, in a plane-parallel column under a spherical direct beam
// (pseudo-spherical). Its Legendre moments are the source of multiple scattering; the caller
// integrates that source along spherical view rays, at the local sun. Azimuth is a Fourier series,
// zenith a double-Gauss rule, the source linear in optical depth within a layer.
#pragma once

#include <span>
#include <vector>

#include "model/optics.h"
#include "model/ray.h"
#include "model/stream_basis.h"

namespace skyfit {

// Heights of the levels, ascending from 0 to top, h_i = top (i / (count - 1))^2.
std::vector<double> level_heights(double top, int count);

// Layout of a field: for a mode m and a moment l, [level][slice][sun], sun fastest; slice 0 is the
// value, slice 1 + p the derivative by parameter p.
struct FieldShape {
  int levels = 0, slices = 0, suns = 0;
  std::size_t row() const { return static_cast<std::size_t>(slices) * suns; }
  std::size_t size() const { return row() * levels; }
};

struct DiffuseField {
  FieldShape shape;
  // moments[m][(l - m) * shape.size() + ...] = 2 pi integral Lambda_lm I_m dmu, I = sum_m (2 -
  // delta_m0) I_m cos m phi, mu and phi those of the direction in which one looks. Empty for the
  // modes that do not matter.
  std::vector<std::vector<double>> moments;
  std::vector<double> ground_irradiance;  // diffuse, on the ground, [slice][sun]
  std::vector<double> scale;              // largest moment of mode 0, [level][slice][sun]
  int orders = 0;                         // of scattering and reflection that were summed
};

struct DiffuseOptions {
  // An order of a mode ends the sum, and a mode is left out, when it changes no moment by more than
  // this share of the largest moment of mode 0 at the same level for the same sun (and the same
  // derivative).
  double tolerance = 3e-6;
  int max_orders = 2000;  // beyond: std::runtime_error
};

// The fields of several wavelengths, in parallel over wavelengths and modes on the calling arena's
// threads. All optics must keep the same number of moments as the basis.
template <int N>
std::vector<DiffuseField> solve_diffuse_fields(const Shells& shells,
                                               std::span<const Optics<N>> optics, int slices,
                                               const std::vector<double>& heights,
                                               const std::vector<double>& sun_mu,
                                               const StreamBasis& basis,
                                               const DiffuseOptions& options);

}  // namespace skyfit
