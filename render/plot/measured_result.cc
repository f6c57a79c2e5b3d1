// SPDX-License-Identifier: Apache-2.0
#include "render/plot/measured_result.h"

#include <cmath>
#include <map>

#include "data_refs/samples.h"
#include "data_refs/spectra.h"
#include "model/numerics/angles.h"

namespace skyfit::plot {
namespace {

// Nanometres that each wavelength stands for.
std::map<double, double> widths_of(const std::vector<Sample>& samples) {
  std::map<double, double> widths;
  for (const Sample& sample : samples) widths[sample.wavelength_nm] = 0;
  if (widths.size() == 1) widths.begin()->second = 1;  // ratios of its directions remain
  for (auto at = widths.begin(); at != widths.end(); ++at) {
    const auto next = std::next(at);
    if (next == widths.end()) continue;
    const double half = (next->first - at->first) / 2;
    at->second += half;
    next->second += half;
  }
  return widths;
}

}  // namespace

DirectionKey direction_key(int scan, double sun_zenith_deg, double view_zenith_deg,
                           double relative_azimuth_deg) {
  const auto thousandths = [](double degrees) { return std::lround(1e3 * degrees); };
  return {scan, thousandths(view_zenith_deg - sun_zenith_deg), thousandths(relative_azimuth_deg)};
}

std::vector<MeasuredDirection> directions_of(const MeasuredOutcome& outcome) {
  constexpr double kLumenPerWatt = 683.002;
  const Spectrum& y_bar = refs::standard_spectral_data().y_bar;
  const std::map<double, double> widths = widths_of(outcome.samples);
  std::map<DirectionKey, MeasuredDirection> looks;
  for (const Sample& s : outcome.samples) {
    const auto [at, is_new] = looks.try_emplace(
        direction_key(s.scan, s.sun_zenith_deg, s.view_zenith_deg, s.relative_azimuth_deg));
    MeasuredDirection& look = at->second;
    if (is_new) {
      refs::Sample angles;
      angles.sun_zenith = s.sun_zenith_deg * kRadiansPerDegree;
      angles.view_zenith = s.view_zenith_deg * kRadiansPerDegree;
      angles.relative_azimuth = s.relative_azimuth_deg * kRadiansPerDegree;
      look = {s.scan,
              s.sun_zenith_deg,
              s.view_zenith_deg,
              s.relative_azimuth_deg,
              refs::scattering_angle(angles) * kDegreesPerRadian,
              0,
              0,
              false};
    }
    const double weight = s.wavelength_nm > 0 ? kLumenPerWatt * y_bar.at_or_zero(s.wavelength_nm) *
                                                    widths.at(s.wavelength_nm)
                                              : 1;
    look.measured += weight * s.reference;
    look.model += weight * s.model;
    look.counted |= s.weight > 0;
  }
  std::vector<MeasuredDirection> result;
  for (const auto& [key, look] : looks) result.push_back(look);
  return result;
}

}  // namespace skyfit::plot
