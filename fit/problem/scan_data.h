// SPDX-License-Identifier: Apache-2.0
// The samples of absolute or spectral scans, arranged for a model that gives all wavelengths of a
// direction at once.
//
// value of a sample = sum_k weight[k] * radiance per unit solar irradiance at node k, over the
// square of the sun's distance in au. A spectral radiance has one node, weighted with the sun's
// irradiance at 1 au there; a luminance has those of a luminance rule.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data_refs/samples.h"
#include "model/photometry/photometry.h"
#include "model/sky_model.h"

namespace skyfit::fit {

// What samples share a wavelength (0: luminance).
struct Channel {
  double wavelength_nm = 0;
  std::vector<int> node;
  std::vector<double> weight;
};

// One direction of one scan, as the instrument states it. Under a sun that moves during the scan it
// is a direction from the sun, and `stated` that of its first sample.
struct Look {
  int scan;
  SkyPoint stated;
};

// A direction under one sun, for which the model is evaluated.
struct Ray {
  int scan;
  SkyPoint stated;
  double sun_azimuth;  // radians from north, 0 where it is not known
};

struct ScanInfo {
  int number = 0;  // the reference's
  std::string name;
  std::string time_utc;                    // empty: not known
  double sun_zenith = 0, sun_azimuth = 0;  // of its begin, radians; azimuth from north, else 0
  double inverse_distance2 = 1;            // au^-2
};

struct ScanRow {
  std::size_t sample;  // index into the reference's samples
  int look, ray, channel;
  double value, sigma;  // in the reference's unit; sigma includes the sample's weight
};

struct ScanData {
  std::vector<WavelengthNode> nodes;
  std::vector<Channel> channels;  // ascending wavelength
  std::vector<ScanInfo> scans;    // all of the reference, also those without a row
  std::vector<Look> looks;        // sorted by scan
  std::vector<Ray> rays;          // those of a look follow each other
  std::vector<ScanRow> rows;      // sorted by look, then channel
  std::vector<int> rows_per_look() const;
};

// sigma^2 = floor^2 + (relative * value)^2 for samples that state none.
struct NoiseModel {
  double relative = 0.05;
  double floor = 0;  // in the reference's unit
};

struct ScanSelection {
  bool with_weightless = false;  // also samples of weight 0, those near the sun and negative ones
  double exclude_sun = 0;        // radians
  NoiseModel noise;
  int largest_channels = 0;  // > 0: at most so many wavelengths, evenly chosen, for a search
};

// Throws std::invalid_argument for a reference of relative luminance, values that are not finite
// and > 0, and wavelengths outside the tables; with_weightless leaves such samples out.
ScanData scan_data(const refs::Reference& reference, const SpectralData& spectra,
                   const ScanSelection& selection);

}  // namespace skyfit::fit
