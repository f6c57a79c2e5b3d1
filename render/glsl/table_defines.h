// SPDX-License-Identifier: Apache-2.0
// What render/shaders/atmosphere.glsl is compiled for: what stays the same as long as an atmosphere
// does.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "model/tables/tables.h"

namespace skyfit {

// Names and values, for #define: what is the same between any two atmospheres of a sequence.
std::vector<std::string> table_defines(const AtmosphereTables& tables);

// Of an atmosphere that does not change: with the heights of its tables.
std::vector<std::string> lasting_table_defines(const AtmosphereTables& tables);

// g, g1, g2 and weight of the phase functions behind the Rayleigh-like one; of another Rayleigh
// phase function its depolarisation, 0, 0, 0.
std::vector<std::array<double, 4>> phase_parameters(const PhaseClasses& phases);

}  // namespace skyfit
