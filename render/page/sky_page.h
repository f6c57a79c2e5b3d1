// SPDX-License-Identifier: Apache-2.0
// A preset's sky as one page for a browser: HTML, style, program, shaders and tables in one file,
// WebGL 2, nothing from a network. The light is that of the model `reference` at the four
// wavelengths of a colour rule, from its look-up tables (model/tables/tables.h) of fewer texels
// than a renderer's; the shaders are render/shaders/atmosphere.glsl and model/shared/, compiled as
// GLSL ES 3.00. docs/view.md says what the page shows.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/atmosphere/preset.h"
#include "model/photometry/photometry.h"
#include "model/tables/tables.h"
#include "render/page/page_sliders.h"

namespace skyfit {

// Texels of the page's tables.
inline constexpr TableSizes kPageSizes = {.optical_depth_mu = 128,
                                          .optical_depth_r = 64,
                                          .irradiance_mu_s = 48,
                                          .irradiance_r = 12,
                                          .scattering_r = 24,
                                          .scattering_ground = 12,
                                          .scattering_sky = 48,
                                          .scattering_mu_s = 48,
                                          .scattering_azimuth = 16,
                                          .outside_sky = 4,
                                          .outside_mu_s = 8,
                                          .outside_azimuth = 4};

struct SkyPageRequest {
  const Preset& preset;
  const SpectralData& spectra;  // under the preset's star
  std::vector<PageSlider> sliders;
  int threads = 1;
  std::function<void(double)> progress = [](double) {};  // 0..1
};

// |luminance of the page / that of the model reference - 1|, the largest of 450 skies each: views
// 0 to 89 deg from the zenith, suns 0 to 88 deg, observers at the ground, 1.5 km and 10 km.
struct SkyPageErrors {
  double preset = 0;
  // Of each slider: at the worse of its ends, and half-way between the preset's value and an end;
  // views from the ground.
  std::vector<double> at_end, half_way;
};

struct SkyPage {
  std::string html;  // UTF-8
  SkyPageErrors errors;
};

// Throws std::invalid_argument where the model cannot do the atmosphere or one with a slider at its
// end, with the slider's name.
SkyPage sky_page(const SkyPageRequest& request);

}  // namespace skyfit
