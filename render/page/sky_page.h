// SPDX-License-Identifier: Apache-2.0
// A preset's sky as one page for a browser: HTML, style, program, shaders and tables in one file,
// WebGL 2, nothing from a network. The light is that of the model `reference` at the four
// wavelengths of a colour rule, from its look-up tables (model/tables/tables.h) of fewer texels
// than a renderer's; the shaders are render/shaders/atmosphere.glsl and model/shared/, compiled as
// GLSL ES 3.00. docs/view.md says what the page shows.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "model/atmosphere/preset.h"
#include "model/geometry/sky_point.h"
#include "model/photometry/photometry.h"
#include "model/tables/tables.h"
#include "render/page/page_sliders.h"

namespace skyfit {

struct SkyPageRequest {
  const Preset& preset;
  const SpectralData& spectra;  // under the preset's star
  std::vector<PageSlider> sliders;
  int threads = 1;
  std::function<void(double)> progress = [](double) {};  // 0..1, from several threads
};

inline constexpr std::size_t kMostPageBytes = 8'000'000;

// |luminance of the page / that of the model reference - 1|, the largest of 756 skies each: views
// 5 to 89 deg and suns 0 to 88 deg from the zenith. And where that is.
struct WorstError {
  double error = 0;
  SkyPoint at;
};
inline constexpr std::array kComparedAltitudes_m = {0.0, 1500.0, 10000.0};
struct SkyPageErrors {
  std::array<WorstError, kComparedAltitudes_m.size()> preset{};  // by altitude
  // Of each slider, from the ground: at values for which the page has tables, its ends among them;
  // half-way between these and the preset's value.
  std::vector<double> tabulated, half_way;
};

struct SkyPage {
  std::string html;  // UTF-8
  SkyPageErrors errors;
};

// Throws std::invalid_argument where the model cannot do the atmosphere or one with a slider at its
// end, with the slider's name, and where the page would have more than kMostPageBytes.
SkyPage sky_page(const SkyPageRequest& request);

}  // namespace skyfit
