// SPDX-License-Identifier: Apache-2.0
#include "cli/sky_page_file.h"

#include <algorithm>
#include <cmath>

#include "cli/progress.h"
#include "data_refs/spectra.h"
#include "fit/result/record.h"

namespace skyfit::cli {

std::vector<PageSlider> usual_sliders(const Preset& preset, const std::string& source) {
  if (preset.fit.is_object() && preset.fit.contains("covariance"))
    return fitted_sliders(preset, preset, source);
  return page_sliders(preset.atmosphere, main_parameters(preset.atmosphere));
}

std::vector<PageSlider> fitted_sliders(const Preset& preset, const Preset& fitted,
                                       const std::string& source) {
  const fit::FittedCovariance covariance = fit::fitted_covariance(fitted, source);
  for (const Parameter& parameter : covariance.parameters)
    require_parameter(preset.atmosphere, parameter);
  std::vector<PageSlider> sliders = page_sliders(preset.atmosphere, covariance.parameters);
  for (PageSlider& slider : sliders) {
    const auto at =
        std::ranges::find(covariance.parameters, slider.parameter) - covariance.parameters.begin();
    slider.sigma = std::sqrt(covariance.matrix(at, at));
  }
  return sliders;
}

SkyPage make_sky_page(const Preset& preset, const std::vector<PageSlider>& sliders, int threads) {
  Progress progress("making the page of the sky");
  return sky_page({.preset = preset,
                   .spectra = refs::spectral_data_of(preset.atmosphere),
                   .sliders = sliders,
                   .threads = threads,
                   .progress = [&](double done) { progress.show(done, preset.name); }});
}

}  // namespace skyfit::cli
