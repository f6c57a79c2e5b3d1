// SPDX-License-Identifier: Apache-2.0
#include "data_refs/samples.h"

#include <cmath>
#include <set>

namespace skyfit::refs {

std::map<std::string, int> samples_left_out(const Reference& reference) {
  std::map<std::string, int> counts;
  for (const Sample& sample : reference.samples) {
    if (!(sample.weight > 0)) ++counts[sample.zero_weight_reason];
  }
  return counts;
}

bool is_beside_sky(const Reference& reference, const Sample& sample) {
  return sample.irradiance.has_value() && !is_irradiance(reference.quantity);
}

Quantity quantity_of(const Reference& reference, const Sample& sample) {
  return is_beside_sky(reference, sample) ? reference.irradiance_quantity.value()
                                          : reference.quantity;
}

bool gives_luminance(const Reference& reference) {
  constexpr double kFirst_nm = 450, kLast_nm = 660, kWidestStep_nm = 41;
  if (is_irradiance(reference.quantity)) return false;
  if (reference.quantity != Quantity::kSpectralRadiance) return true;
  std::set<double> wavelengths;
  for (const Sample& s : reference.samples) {
    if (s.weight > 0 && !s.irradiance) wavelengths.insert(s.wavelength_nm);
  }
  double covered = kFirst_nm - kWidestStep_nm;
  for (const double wavelength : wavelengths) {
    if (wavelength <= kFirst_nm || wavelength - covered <= kWidestStep_nm) covered = wavelength;
  }
  return covered >= kLast_nm;
}

double scattering_angle(const Sample& sample) {
  // Vincenty's form of the angle between two directions: exact near 0 and pi, where acos loses half
  // the digits.
  const double sin_s = std::sin(sample.sun_zenith), cos_s = std::cos(sample.sun_zenith);
  const double sin_v = std::sin(sample.view_zenith), cos_v = std::cos(sample.view_zenith);
  const double sin_az = std::sin(sample.relative_azimuth),
               cos_az = std::cos(sample.relative_azimuth);
  const double across = std::hypot(sin_v * sin_az, sin_s * cos_v - cos_s * sin_v * cos_az);
  return std::atan2(across, cos_s * cos_v + sin_s * sin_v * cos_az);
}

DirectionFromSun direction_from_sun(const Sample& sample) {
  constexpr double kUnit = 1e-9;  // a thousand times what degrees and back cost, far below any step
  return {sample.scan, std::llround((sample.view_zenith - sample.sun_zenith) / kUnit),
          std::llround(sample.relative_azimuth / kUnit),
          sample.irradiance ? static_cast<int>(*sample.irradiance) : -1};
}

}  // namespace skyfit::refs
