// SPDX-License-Identifier: Apache-2.0
// measured.csv: what a fit of measured skies leaves for every sample. Header, exactly:
// scan,sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,wavelength_nm,measured,sigma,model,weight
// Numbers are the shortest that read back to the same double.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit::plot {

// Angles in degrees, where the instrument truly points according to the fit; azimuth 0 looks toward
// the sun's azimuth. Values in W m^-2 sr^-1 nm^-1, or in cd/m^2 where the wavelength is 0.
struct MeasuredSample {
  int scan = 1;  // from 1
  double sun_zenith_deg = 0, view_zenith_deg = 0, relative_azimuth_deg = 0;
  double wavelength_nm = 0;
  double measured = 0;
  double sigma = 0;  // what one sample scatters by; 0 where it was not fitted
  double model = 0;
  double weight = 1;  // 0: shown, not counted

  bool operator==(const MeasuredSample&) const = default;
};

std::string measured_to_csv(std::span<const MeasuredSample> samples);

// Throws std::invalid_argument `source:line: field = value: expected ...`.
std::vector<MeasuredSample> parse_measured_csv(std::string_view text, std::string_view source);

// Throws std::runtime_error when the file cannot be read.
std::vector<MeasuredSample> read_measured_csv(const std::filesystem::path& file);

}  // namespace skyfit::plot
