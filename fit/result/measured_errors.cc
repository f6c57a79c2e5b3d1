// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "fit/measured.h"

namespace skyfit::fit {
namespace {

struct Pair {
  double model = 0, measured = 0;
};

double percent_of_norm(double difference2, double measured2) {
  return measured2 > 0 ? 100 * std::sqrt(difference2 / measured2)
                       : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

MeasuredErrors measured_errors(const refs::Reference& reference, const std::vector<double>& model,
                               const SpectralData& spectra, int scan) {
  constexpr double kShortestNm = 400, kLongestNm = 700;
  const bool spectral = reference.quantity == refs::Quantity::kSpectralRadiance;
  std::map<refs::DirectionFromSun, Pair> luminance_of_look;
  double difference2 = 0, measured2 = 0;
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    const refs::Sample& s = reference.samples[i];
    if (s.weight == 0 || (scan != kAllScans && s.scan != scan)) continue;
    const double weight = spectral ? spectra.y_bar.at_or_zero(s.wavelength_nm) : 1;
    Pair& luminance = luminance_of_look[refs::direction_from_sun(s)];
    luminance.model += weight * model[i];
    luminance.measured += weight * s.value;
    if (!spectral || s.wavelength_nm < kShortestNm || s.wavelength_nm > kLongestNm) continue;
    difference2 += std::pow(model[i] - s.value, 2);
    measured2 += s.value * s.value;
  }
  double sum = 0, squares = 0, count = 0;
  for (const auto& [look, luminance] : luminance_of_look) {
    if (!(luminance.measured > 0)) continue;  // no visible wavelength
    ++count;
    const double relative = luminance.model / luminance.measured - 1;
    sum += relative;
    squares += relative * relative;
  }
  return {100 * std::sqrt(squares / count), percent_of_norm(difference2, measured2),
          100 * sum / count};
}

}  // namespace skyfit::fit
