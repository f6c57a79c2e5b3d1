// SPDX-License-Identifier: Apache-2.0
// What the air does to light between the levels of the diffuse field, for eight wavelengths (lanes)
// at a time: sources per moment, transmittances, the sun's beam, and their derivatives.
//
// Along a ray the diffuse source J is linear in optical depth; x is that of the layer:
//   I = t I_far + near J_near + far J_far, t = exp(-x), near = 1 - (1 - t) / x, far = (1 - t) / x -
//   t.
// The source of the beam is linear in optical depth times the beam, which falls exponentially:
//   I = near_b q_near + far_b q_far, near_b = x T_near A(y), far_b = x T_near B(y),
//   y = x + log(T_near / T_far), A = integral (1 - u) exp(-y u) du, B = integral u exp(-y u) du,
// u = 0 .. 1, T the beam's transmittance at both ends; at the edge of the planet's shadow, where
// one is 0, the beam is taken as linear.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "model/atmosphere/optics.h"
#include "model/numerics/batch_blocks.h"
#include "model/solver/streams.h"

namespace skyfit {

// The beam's weights for the rays of one layer that look one way, [ray][sun], and how they change
// with the layer's depth x and the sun's depths at the near and the far end.
struct BeamWeights {
  Batch near, far;
  std::array<Batch, 3> near_slope, far_slope;  // empty without derivatives
};

struct LayerMedium {
  int moments = 0;
  std::size_t suns = 0, parameters = 0;
  std::vector<double> sun_mu;
  // Source per extinction of the moment l at a level: sum over scatterers of share chi_l.
  // Of a scattering matrix, docs/theory (13.18), [l]; empty without one.
  struct Matrix {
    Batch alpha, zeta, gamma;
  };
  struct Scatterer {
    bool polarises = false;  // as Rayleigh scattering does
    Batch chi;               // [l]
    Matrix matrix;
    std::vector<Batch> share;          // per level, one element: of the extinction
    std::vector<Batch> share_tangent;  // per level: [parameter]
  };
  std::vector<Scatterer> scatterers;
  // The parameters that change the moments of a scatterer, and how: [l].
  struct PhaseTangent {
    std::size_t scatterer, parameter;
    Batch chi;
    Matrix matrix;
  };
  std::vector<PhaseTangent> phase_tangents;
  bool has_matrices() const;  // beside Rayleigh's
  // Per level.
  std::vector<Batch> sun_depth_tangent;  // [sun][parameter]
  Batch ground_beam;                     // [sun], transmittance
  Batch ground_albedo, ground_albedo_tangent;
  // Per layer.
  struct Layer {
    Batch t, near, far, near_slope, far_slope;  // [ray]
    Batch depth_tangent;                        // [ray][parameter]
    BeamWeights down, up;  // of rays that look up and see light that travels down; the others
  };
  std::vector<Layer> layers;
};

// Columns to the top of the streams's rays and of the suns at every level; they serve all
// wavelengths.
struct FieldColumns {
  std::vector<PathColumns> rays;  // [level][ray], upward
  std::vector<PathColumns> suns;  // [level][sun]
  std::vector<char> lit;          // [level][sun]: the planet is not in the way
};
FieldColumns field_columns(const Shells& shells, const std::vector<double>& heights,
                           const std::vector<double>& sun_mu, const Streams& streams);

// Which light the medium takes along the rays: I under the delta-M-scaled extinction, Q and U under
// Optics::polarised_extinction. The sun's beam is delta-M-scaled for both.
enum class MediumOf { kIntensity, kPolarised };

// `parameters` derivatives, the first ones of Dual<N>. The optics keep `moments` moments.
template <int N>
LayerMedium layer_medium(const std::array<const Optics<N>*, batch::kBatchWidth>& optics,
                         std::size_t parameters, const std::vector<double>& heights,
                         const std::vector<double>& sun_mu, const FieldColumns& columns,
                         const Streams& streams, int moments, MediumOf light);

}  // namespace skyfit
