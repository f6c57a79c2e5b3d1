// SPDX-License-Identifier: Apache-2.0
// samples.csv: what a fit leaves for every sample, and the one struct that figures are made of.
// Header, exactly:
// scan,sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,wavelength_nm,reference,sigma,model,residual,weight,
// followed by start_model where the start values are known, and by irradiance (kIrradianceNames of
// model/irradiance.h, empty of other samples) where there are irradiances. Numbers are the shortest
// that read back to the same double; residual is ln(model / reference), nan where one is not
// positive, and is not read back.
#pragma once

#include <cmath>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit::plot {

// Angles in degrees, where the instrument truly points according to the fit; azimuth 0 looks toward
// the sun's azimuth. `reference`, `sigma`, `model` and `start_model` share one unit (cd/m^2, that
// of a relative reference, W m^-2 sr^-1 nm^-1, lx or W/m^2); both models carry the scale of the
// scan, but for irradiances beside a sky.
struct Sample {
  int scan = 1;  // from 1
  double sun_zenith_deg = 0;
  double view_zenith_deg = 0;
  double relative_azimuth_deg = 0;
  double wavelength_nm = 0;  // 0: a luminance
  double reference = 0;
  double sigma = 0;  // what one sample scatters by; 0 where it was not fitted
  double model = 0;
  double weight = 1;                                              // >= 0; 0: shown, not counted
  double start_model = std::numeric_limits<double>::quiet_NaN();  // NaN: not known
  std::string irradiance = {};  // which; empty: a radiance or luminance

  double residual() const { return std::log(model / reference); }
  bool operator==(const Sample&) const = default;
};

// Those that are no irradiances, and those that are.
std::vector<Sample> directions_only(std::span<const Sample> samples);
std::vector<Sample> irradiances_only(std::span<const Sample> samples);

// Weighted root mean square of the residuals, percent; NaN when no sample has weight.
double rms_log_percent(std::span<const Sample> samples);

// The column start_model is written when every sample has one.
std::string samples_to_csv(std::span<const Sample> samples);

// Throws std::invalid_argument `source:line: field = value: expected ...`; `source` is the name
// that the message shows.
std::vector<Sample> parse_samples_csv(std::string_view text, std::string_view source);

// Appears whole or not at all. Throws std::runtime_error with one line that names the file.
void write_samples_csv(const std::filesystem::path& file, std::span<const Sample> samples);
std::vector<Sample> read_samples_csv(const std::filesystem::path& file);

}  // namespace skyfit::plot
