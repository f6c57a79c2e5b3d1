// SPDX-License-Identifier: Apache-2.0
// What the figures of measured skies show of a fit.
#pragma once

#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "render/plot/samples_csv.h"

namespace skyfit::plot {

struct MeasuredScan {
  std::string name, time_utc;                                      // either may be empty
  double luminance_error_percent = 0, spectral_error_percent = 0;  // NaN: not known
};

struct MeasuredUnknown {
  std::string name, unit;
  int scan = 0;  // from 1; 0: all scans share it
  double fitted = 0;
  double sigma = std::numeric_limits<double>::quiet_NaN();
};

struct MeasuredOutcome {
  std::string title;
  bool spectral = true;             // else cd/m^2
  std::vector<Sample> samples;      // that have a direction
  std::vector<Sample> irradiances;  // the others
  std::string irradiance_unit;      // of these
  std::vector<MeasuredScan> scans;
  std::vector<MeasuredUnknown> unknowns;
  std::vector<std::string> covariance_unknowns;
  std::vector<std::vector<double>> covariance;  // empty when singular
};

// One direction of one scan with its luminance: of spectra the sum of 683 y_bar radiance over the
// wavelengths at hand by the trapezoidal rule. cd/m^2.
struct MeasuredDirection {
  int scan;
  double sun_zenith_deg, view_zenith_deg, relative_azimuth_deg, scattering_angle_deg;
  double measured, model;
  bool counted;  // some sample of it has a weight
};
// What the samples of a direction share while the sun moves: the scan, view minus sun zenith angle
// and relative azimuth, in 1e-3 deg.
using DirectionKey = std::tuple<int, long, long>;
DirectionKey direction_key(int scan, double sun_zenith_deg, double view_zenith_deg,
                           double relative_azimuth_deg);

std::vector<MeasuredDirection> directions_of(const MeasuredOutcome& outcome);

}  // namespace skyfit::plot
