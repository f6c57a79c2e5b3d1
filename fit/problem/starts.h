// SPDX-License-Identifier: Apache-2.0
// Where a multi-start fit begins: the same atmosphere with different phase functions. Two lobes
// have several minima, one has one; see the list in starts.cc.
#pragma once

#include <string>
#include <vector>

#include "fit/problem/free_parameters.h"

namespace skyfit::fit {

struct Start {
  std::string name;  // "g1 0.78, g2 0.2, weight 0.7"
  Atmosphere<double> atmosphere;
};

// `count` starts; one when no phase parameter is free. With `own_first` the first
// one is the atmosphere as it is. Beyond the list a low-discrepancy sequence continues it.
std::vector<Start> choose_starts(const Atmosphere<double>& atmosphere,
                                 const std::vector<FreeParameter>& parameters, int count,
                                 bool own_first);

}  // namespace skyfit::fit
