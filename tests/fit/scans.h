// SPDX-License-Identifier: Apache-2.0
// Spectral scans that a sky model made, with known parameters, pointing and noise.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "data_refs/spectra.h"
#include "fit/problem/sky_values.h"
#include "model/atmosphere/preset.h"

namespace skyfit::fit {

// The air that toy_sky.h knows, in the place of that of measured skies.
inline Preset power_law_air() { return {"power law", {}, {}, {}}; }

struct SyntheticScans {
  std::vector<double> sun_zenith_deg = {30, 60};
  std::vector<double> view_zenith_deg = {20, 45, 70};
  int azimuths = 8;
  std::vector<double> wavelength_nm = {420, 500, 600, 680};
  double sun_distance_au = 1.01;
  std::vector<double> azimuth_offset_deg = {0, 0};
  double scale = 1;  // measured over true
  double noise = 0;  // relative, Gaussian
  unsigned int seed = 1;
};

inline refs::Reference synthetic_scans(const SkyModel& model, const Atmosphere<double>& atmosphere,
                                       const SyntheticScans& how) {
  constexpr double kDegree = std::numbers::pi / 180;
  refs::Reference reference;
  reference.name = "synthetic scans";
  reference.description = "made by the model";
  reference.quantity = refs::Quantity::kSpectralRadiance;
  for (std::size_t scan = 0; scan < how.sun_zenith_deg.size(); ++scan) {
    refs::Scan facts;
    facts.name = "scan " + std::to_string(scan + 1);
    facts.sun_azimuth = (100 + 40 * static_cast<double>(scan)) * kDegree;
    facts.sun_distance_au = how.sun_distance_au;
    reference.scans.push_back(facts);
    for (const double view : how.view_zenith_deg) {
      for (int k = 0; k < how.azimuths; ++k) {
        for (const double nm : how.wavelength_nm) {
          refs::Sample sample;
          sample.sun_zenith = how.sun_zenith_deg[scan] * kDegree;
          sample.view_zenith = view * kDegree;
          sample.relative_azimuth =
              std::remainder(2 * std::numbers::pi * (k + 0.3) / how.azimuths, 2 * std::numbers::pi);
          sample.wavelength_nm = nm;
          sample.scan = static_cast<int>(scan);
          sample.value = 1;
          reference.samples.push_back(sample);
        }
      }
    }
  }
  const Dataset data = dataset(reference, refs::standard_spectral_data(), {true, 0, {}, 0});
  SkyState state = start_state(atmosphere, static_cast<int>(how.sun_zenith_deg.size()));
  for (std::size_t scan = 0; scan < state.instrument.size(); ++scan) {
    state.instrument[scan][static_cast<std::size_t>(Instrument::kAzimuthOffset)] =
        how.azimuth_offset_deg[scan] * kDegree;
    state.instrument[scan][static_cast<std::size_t>(Instrument::kScale)] = how.scale;
  }
  const SampleValues values = sky_values(model, data, state, {});
  std::mt19937 generator(how.seed);
  std::normal_distribution<double> normal(0, 1);
  for (std::size_t r = 0; r < data.samples.size(); ++r) {
    reference.samples[data.samples[r].index].value =
        values.value(static_cast<Eigen::Index>(r)) * (1 + how.noise * normal(generator));
  }
  return reference;
}

}  // namespace skyfit::fit
