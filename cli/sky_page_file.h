// SPDX-License-Identifier: Apache-2.0
// The page of a preset's sky that `skyfit view` and `skyfit report` write.
#pragma once

#include <string>
#include <vector>

#include "model/atmosphere/preset.h"
#include "render/page/sky_page.h"

namespace skyfit::cli {

// Those of the parameters that the preset's fit left uncertain, with their sigmas; of a preset
// without a fit, main_parameters(). `source` is the preset as the user names it.
std::vector<PageSlider> usual_sliders(const Preset& preset, const std::string& source);

// Of the parameters that another preset's fit left uncertain. Throws std::invalid_argument with one
// line where that has no fit, or the preset lacks one of its parameters.
std::vector<PageSlider> fitted_sliders(const Preset& preset, const Preset& fitted,
                                       const std::string& source);

// Throws what sky_page() throws.
SkyPage make_sky_page(const Preset& preset, const std::vector<PageSlider>& sliders, int threads);

}  // namespace skyfit::cli
