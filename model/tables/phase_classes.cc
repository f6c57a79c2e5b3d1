// SPDX-License-Identifier: Apache-2.0
#include "model/tables/phase_classes.h"

#include <algorithm>
#include <optional>

namespace skyfit {

PhaseClasses phase_classes(const Atmosphere<double>& atmosphere) {
  PhaseClasses classes;
  std::optional<double> depolarisation;
  for (const Constituent<double>& c : atmosphere.constituents) {
    classes.of_constituent.push_back(PhaseClasses::kRayleighLike);
    if (!scatters(c)) continue;
    if (c.phase.type == PhaseType::kRayleigh &&
        c.phase.depolarisation == depolarisation.value_or(c.phase.depolarisation)) {
      depolarisation = c.phase.depolarisation;
      continue;
    }
    const auto at = std::ranges::find(classes.others, c.phase);
    classes.of_constituent.back() = 1 + static_cast<int>(at - classes.others.begin());
    if (at == classes.others.end()) classes.others.push_back(c.phase);
  }
  classes.depolarisation = depolarisation.value_or(0);
  if (classes.others.empty()) classes.others.emplace_back();
  return classes;
}

}  // namespace skyfit
