// SPDX-License-Identifier: Apache-2.0
// The samples of all scans of a fit, arranged for a model that gives all wavelengths of a direction
// at once. A relative luminance is a luminance here; its scale is the likelihood's.
//
// value of a sample = sum_k weight[k] * radiance per unit solar irradiance at node k, over the
// square of the sun's distance in au. A spectral radiance has one node, weighted with the sun's
// irradiance at 1 au there; a luminance has those of a luminance rule.
//
// An irradiance is the same of the model's irradiances (SkyModel::irradiance): an illuminance by
// the nodes of a luminance rule, one of all wavelengths by those of a broadband rule, whose weights
// depend on its sun and the water vapour of the scan. It may stand beside the samples of a sky.
//
// A reading of polarisation is a sample of its own in the channel of its radiance: Q / I, U / I or
// sqrt(Q^2 + U^2) / I of the sums of that weight. Neither the sun's distance nor a scale matters to
// it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data_refs/samples.h"
#include "model/photometry/photometry.h"
#include "model/sky_model.h"

namespace skyfit::fit {

// What samples share: a wavelength, or 0 of luminances and of irradiances (those of all wavelengths
// share a sun).
struct Channel {
  double wavelength_nm = 0;
  std::vector<int> node;
  std::vector<double> weight;
};

// One direction of one scan, as the instrument states it. Under a sun that moves during the scan it
// is a direction from the sun, and `stated` that of its first sample.
struct LineOfSight {
  int scan;
  SkyPoint stated;
};

// A line of sight under one sun, for which the model is evaluated.
struct View {
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

// A sample of the reference in its place.
struct Sample {
  std::size_t index;  // in the reference
  int line_of_sight, view, channel;
  double value, sigma;  // in the reference's unit; sigma includes the sample's weight
  std::optional<refs::Polarisation> polarisation = {};  // what is read; nothing: the radiance
  std::optional<Irradiance> irradiance = {};            // which, where the quantity is one
  bool beside_sky = false;                              // an irradiance among samples of a sky
};

struct Dataset {
  std::vector<WavelengthNode> nodes;
  std::vector<Channel> channels;  // ascending wavelength; then of irradiances
  std::vector<ScanInfo> scans;    // all of the reference, also those without a sample
  // By scan; those of irradiances beside a sky come after all others, as do views and samples.
  std::vector<LineOfSight> lines_of_sight;
  std::vector<View> views;      // those of a line of sight follow each other
  std::vector<Sample> samples;  // by line of sight, channel, and polarisation after radiance
  int scan_of(const Sample& sample) const {
    return lines_of_sight[static_cast<std::size_t>(sample.line_of_sight)].scan;
  }
  std::vector<int> samples_per_line_of_sight() const;
};

// sigma^2 = floor^2 + (relative * value)^2 for samples that state none.
struct NoiseModel {
  double relative = 0.05;
  double floor = 0;  // in the reference's unit
};

// Sigma of a reading of polarisation that states none: one percentage point.
inline constexpr double kPolarisationSigma = 0.01;

struct Selection {
  bool with_weightless = false;  // also samples of weight 0, those near the sun and negative ones
  double exclude_sun = 0;        // radians
  NoiseModel noise;
  int largest_channels = 0;  // > 0: at most so many wavelengths, evenly chosen, for a search
  bool with_polarisation = false;
};

SkyPoint sky_point(const refs::Sample& sample);

// Throws std::invalid_argument `reference: sample N: field = value: must be ...` for values that
// are not finite and > 0 and wavelengths outside the tables; with_weightless leaves such samples
// out.
Dataset dataset(const refs::Reference& reference, const SpectralData& spectra,
                const Selection& selection);
// Indices of the samples that are readings of polarisation, those that are irradiances beside a
// sky, and all others.
std::vector<int> polarisations(const Dataset& data);
std::vector<int> irradiances_beside_sky(const Dataset& data);
std::vector<int> radiances(const Dataset& data);
// Without the irradiances beside a sky.
Dataset only_sky(Dataset data);
// The samples of these indices, which ascend.
Dataset only_samples(const Dataset& data, const std::vector<int>& indices);
// The samples of one scan.
Dataset only_scan(Dataset data, int scan);

}  // namespace skyfit::fit
