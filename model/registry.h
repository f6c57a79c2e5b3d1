// SPDX-License-Identifier: Apache-2.0
// The sky models by name.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "model/sky_model.h"

namespace skyfit {

struct SkyModelEntry {
  std::string_view name;
  std::string_view meaning;  // one line, with the source
  // `threads` >= 1; results do not depend on it. `spectra`: what a model that speaks of luminance
  // needs to speak of radiance. `transfer`: of `reference` and `tables`; the others are scalar.
  std::unique_ptr<SkyModel> (*make)(const SpectralData& spectra, int threads, Transfer transfer);
};
// Every model, the yardstick first.
std::span<const SkyModelEntry> sky_models();

// Throws std::invalid_argument that lists the known names.
std::unique_ptr<SkyModel> make_sky_model(std::string_view name, const SpectralData& spectra,
                                         int threads, Transfer transfer = Transfer::kVector);

}  // namespace skyfit
