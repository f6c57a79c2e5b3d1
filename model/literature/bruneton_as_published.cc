// SPDX-License-Identifier: Apache-2.0
// What the tables are without the repairs of Sperlhofer 2011, section 5.1.
#include "model/literature/bruneton_tables.h"
#include "model/literature/mie_from_rayleigh.h"
#include "model/numerics/half.h"

namespace skyfit::literature {

template <int N>
void BrunetonTables<N>::round_to_half() {
  if (choices_.transmittance == BrunetonTransmittance::kInHalfFloats) {
    half_transmittance_ = optical_depth_;
    for (std::size_t i = 0; i < half_transmittance_.count(); ++i) {
      half_transmittance_[i] = exp(-optical_depth_[i]);
      half_transmittance_[i].v = rounded_to_half(half_transmittance_[i].v);
    }
  }
  if (choices_.in_scatter == BrunetonInScatter::kInHalfFloats) {
    for (Grid<N, 4>* table : {&rayleigh_like_, &single_mie_}) {
      for (std::size_t i = 0; i < table->count(); ++i)
        (*table)[i].v = rounded_to_half((*table)[i].v);
    }
  }
}

template <int N>
void BrunetonTables<N>::take_mie_from_rayleigh(const BrunetonTables& red) {
  literature::take_mie_from_rayleigh(air_, rayleigh_like_, red.air_, red.rayleigh_like_,
                                     red.single_mie_, single_mie_);
}

template void BrunetonTables<0>::round_to_half();
template void BrunetonTables<kTablesAtOnce>::round_to_half();
template void BrunetonTables<0>::take_mie_from_rayleigh(const BrunetonTables& red);
template void BrunetonTables<kTablesAtOnce>::take_mie_from_rayleigh(const BrunetonTables& red);

}  // namespace skyfit::literature
