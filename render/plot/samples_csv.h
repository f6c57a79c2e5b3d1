// SPDX-License-Identifier: Apache-2.0
// samples.csv: what a fit leaves for every sample, and the one struct that figures are made of.
// Header, exactly:
// sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,reference,model,residual,weight, followed by
// start_model where the start values are known. Numbers are the shortest that read back to the same
// double.
#pragma once

#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit::plot {

// Angles in degrees; azimuth 0 looks toward the sun's azimuth. `reference`, `model` and
// `start_model` share one unit (cd/m^2, or that of a relative reference); both models carry their
// own fitted luminance scale.
struct ComparedSample {
  double sun_zenith_deg = 0;
  double view_zenith_deg = 0;
  double relative_azimuth_deg = 0;
  double reference = 0;                                           // > 0
  double model = 0;                                               // > 0, fitted
  double residual = 0;                                            // ln(model) - ln(reference)
  double weight = 1;                                              // >= 0; 0: shown, not counted
  double start_model = std::numeric_limits<double>::quiet_NaN();  // NaN: not known

  bool operator==(const ComparedSample&) const = default;
};

// Weighted root mean square of the residuals, percent; NaN when no sample has weight.
double rms_log_percent(std::span<const ComparedSample> samples);

// The column start_model is written when every sample has one.
std::string samples_to_csv(std::span<const ComparedSample> samples);

// Throws std::invalid_argument `source:line: field = value: expected ...`; `source` is the name
// that the message shows.
std::vector<ComparedSample> parse_samples_csv(std::string_view text, std::string_view source);

// Appears whole or not at all. Throws std::runtime_error with one line that names the file.
void write_samples_csv(const std::filesystem::path& file, std::span<const ComparedSample> samples);
std::vector<ComparedSample> read_samples_csv(const std::filesystem::path& file);

}  // namespace skyfit::plot
