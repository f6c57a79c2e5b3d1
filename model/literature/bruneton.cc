// SPDX-License-Identifier: Apache-2.0
#include "model/literature/bruneton.h"

namespace skyfit {

BrunetonMethod::BrunetonMethod(const BrunetonChoices& with, const WavelengthNode& red_node)
    : choices(with), red(red_node), name(kName) {
  if (choices.transmittance == BrunetonTransmittance::kInHalfFloats)
    name.append(":").append(kHalfTransmittance);
  if (choices.in_scatter == BrunetonInScatter::kInHalfFloats)
    name.append(":").append(kHalfInScatter);
  if (choices.mie == BrunetonMie::kFromRayleigh) name.append(":").append(kMieFromRayleigh);
}

BrunetonChoices bruneton_choices(std::span<const std::string_view> names) {
  BrunetonChoices choices;
  for (const std::string_view name : names) {
    if (name == BrunetonMethod::kHalfTransmittance)
      choices.transmittance = BrunetonTransmittance::kInHalfFloats;
    if (name == BrunetonMethod::kHalfInScatter)
      choices.in_scatter = BrunetonInScatter::kInHalfFloats;
    if (name == BrunetonMethod::kMieFromRayleigh) choices.mie = BrunetonMie::kFromRayleigh;
  }
  return choices;
}

}  // namespace skyfit
