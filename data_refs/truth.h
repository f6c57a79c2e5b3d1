// SPDX-License-Identifier: Apache-2.0
// Radiances that other methods computed for atmospheres that are known in full: Monte Carlo in
// spherical geometry, discrete ordinates in plane-parallel geometry; truth/*.csv say how. One
// wavelength, seen from the ground, as spectral radiances under the sun at 1 au.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "data_refs/samples.h"
#include "model/atmosphere/preset.h"

namespace skyfit::refs {

struct TruthEntry {
  std::string_view name;  // "truth:earth-550nm-ground"
  std::string_view description;
};
std::span<const TruthEntry> truth_references();

// Of one of truth_references(); one scan per sun.
Reference truth_reference(std::string_view name);

// The atmosphere that the table was computed for.
Preset truth_preset(std::string_view name);

}  // namespace skyfit::refs
