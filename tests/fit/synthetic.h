// SPDX-License-Identifier: Apache-2.0
// References that the toy sky made, with known parameters.
#pragma once

#include <numbers>
#include <random>
#include <vector>

#include "data_refs/samples.h"
#include "data_refs/spectra.h"
#include "fit/problem/sky_values.h"
#include "tests/atmospheres.h"
#include "tests/fit/toy_sky.h"

namespace skyfit::fit {

inline constexpr double kDegree = std::numbers::pi / 180;

inline Atmosphere<double> true_atmosphere(int lobes) {
  Atmosphere<double> atmosphere;
  atmosphere.at("rayleigh").amount = 1.25e-5;
  atmosphere.at("rayleigh").profile.scale_height_m = 8000;
  set_scattering(atmosphere.at("mie"), 550, 1.2e-4, 1.3);
  atmosphere.at("mie").single_scattering_albedo = 0.93;
  atmosphere.at("mie").phase.type = lobes == 2 ? PhaseType::kTwoLobe : PhaseType::kCornetteShanks;
  atmosphere.at("mie").phase.g = 0.6;
  atmosphere.at("mie").phase.g1 = 0.75;
  atmosphere.at("mie").phase.g2 = 0.3;
  atmosphere.at("mie").phase.weight = 0.4;
  atmosphere.ground_albedo = 0.2;
  return atmosphere;
}

// The principal plane every 5 deg to 80 deg at suns of 0, 20, 40 and 60 deg, with logarithmic
// noise.
inline refs::Reference synthetic_reference(const Atmosphere<double>& atmosphere, double noise) {
  refs::Reference reference;
  reference.name = "synthetic";
  reference.description = "toy sky";
  for (int scan = 0; scan < 4; ++scan) {
    for (int view = -80; view <= 80; view += 5) {
      refs::Sample sample;
      sample.sun_zenith = 20 * scan * kDegree;
      sample.view_zenith = std::abs(view) * kDegree;
      sample.relative_azimuth = view < 0 ? std::numbers::pi : 0;
      sample.scan = scan;
      sample.value = 1;
      reference.samples.push_back(sample);
    }
  }
  const Dataset data = dataset(reference, refs::standard_spectral_data(), {});
  const Eigen::VectorXd luminance =
      sky_values(ToySky(), data, start_state(atmosphere, 4), {}).value;
  std::mt19937 generator(12);
  std::normal_distribution<double> normal(0, noise);
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    reference.samples[data.samples[i].index].value =
        luminance(static_cast<Eigen::Index>(i)) * std::exp(noise > 0 ? normal(generator) : 0.0);
  }
  return reference;
}

}  // namespace skyfit::fit
