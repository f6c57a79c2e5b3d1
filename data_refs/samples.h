// SPDX-License-Identifier: Apache-2.0
// A sample is a sample: a CIE curve point, a Tregenza patch, a line of a CSV become the same
// struct.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace skyfit::refs {

enum class Quantity {
  kLuminance,         // cd/m^2
  kRelativeLuminance  // up to a factor per sun position
};

// Angles in radians; azimuth 0 looks toward the sun's azimuth.
struct Sample {
  double sun_zenith = 0;
  double view_zenith = 0;
  double relative_azimuth = 0;
  double value = 0;                // > 0, in the unit of the reference's quantity
  std::optional<double> sigma;     // one standard deviation, same unit as value
  double weight = 1;               // >= 0
  std::string zero_weight_reason;  // why weight == 0; empty otherwise
  int scan = 0;                    // samples of one scan share one sun position's luminance scale
};

struct Reference {
  std::string name;         // "cie:12", or the file
  std::string description;  // one line, with the source
  Quantity quantity = Quantity::kRelativeLuminance;
  std::vector<Sample> samples;
};

// Angle between the view ray and the direction to the sun, radians.
double scattering_angle(const Sample& sample);

}  // namespace skyfit::refs
