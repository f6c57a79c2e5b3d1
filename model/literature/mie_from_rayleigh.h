// SPDX-License-Identifier: Apache-2.0
// Single Mie scattering that tables do not keep, after Bruneton & Neyret 2008: in the proportion to
// all other light that another wavelength, "red", has,
//   M = R (M_red / R_red) (beta_R,red / beta_M,red) (beta_M / beta_R).
#pragma once

#include "model/literature/evaluate.h"
#include "model/literature/grid.h"

namespace skyfit::literature {

// Into `mie`, texel by texel. No light where R_red or beta_M,red is zero.
template <int N, int kRank>
void take_mie_from_rayleigh(const ClearAir<N>& air, const Grid<N, kRank>& rayleigh,
                            const ClearAir<N>& red_air, const Grid<N, kRank>& red_rayleigh,
                            const Grid<N, kRank>& red_mie, Grid<N, kRank>& mie) {
  const Dual<N> from = air.air * red_air.aerosol_scattering;
  const bool any = from.v > 0;
  const Dual<N> factor = any ? red_air.air * air.aerosol_scattering / from : Dual<N>(0.0);
  for (std::size_t i = 0; i < mie.count(); ++i) {
    const Dual<N>& red = red_rayleigh[i];
    mie[i] = red.v > 0 ? factor * rayleigh[i] * red_mie[i] / red : Dual<N>(0.0);
  }
}

}  // namespace skyfit::literature
