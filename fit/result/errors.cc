// SPDX-License-Identifier: Apache-2.0
#include "fit/result/errors.h"

#include <cmath>
#include <limits>
#include <map>

#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Pair {
  double model = 0, value = 0;
};

double percent_of_norm(double difference2, double value2) {
  return value2 > 0 ? 100 * std::sqrt(difference2 / value2) : kNan;
}

bool counts(const refs::Reference& reference, std::size_t index, double model, int scan) {
  const refs::Sample& sample = reference.samples[index];
  return !refs::is_beside_sky(reference, sample) && sample.weight > 0 && !std::isnan(model) &&
         (scan == -1 || sample.scan == scan);
}

// Weighted sums of one scan's logarithms.
struct LogSums {
  double weight = 0, sum = 0, squares = 0;
};

// docs/theory (12.9).
double rms_log_percent(const refs::Reference& reference, const std::vector<double>& model,
                       double exclude_sun, double largest_sun_zenith, int scan) {
  constexpr double kRounding = 1e-9;  // radians: a sample on the rim of the cone counts
  std::map<int, LogSums> scans;
  for (const bool second : {false, true}) {
    for (std::size_t i = 0; i < reference.samples.size(); ++i) {
      const refs::Sample& s = reference.samples[i];
      if (!counts(reference, i, model[i], scan) || s.sun_zenith > largest_sun_zenith + kRounding)
        continue;
      if (refs::scattering_angle(s) < exclude_sun - kRounding) continue;
      const double log_ratio = std::log(model[i] / s.value);
      LogSums& sums = scans[s.scan];
      if (second) {
        sums.squares += s.weight * std::pow(log_ratio - sums.sum / sums.weight, 2);
      } else {
        sums.weight += s.weight;
        sums.sum += s.weight * log_ratio;
      }
    }
  }
  LogSums all;
  for (const auto& [number, sums] : scans) {
    all.weight += sums.weight;
    all.squares += sums.squares;
  }
  return all.weight > 0 ? 100 * std::sqrt(all.squares / all.weight) : kNan;
}

}  // namespace

Errors errors_of(const refs::Reference& reference, const std::vector<double>& model,
                 const SpectralData& spectra, int scan) {
  constexpr double kShortestNm = 400, kLongestNm = 700, kAnySun = 10;
  const bool spectral = reference.quantity == refs::Quantity::kSpectralRadiance,
             has_luminances = !spectral || refs::gives_luminance(reference);
  std::map<refs::DirectionFromSun, Pair> luminances;
  double difference2 = 0, value2 = 0;
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    const refs::Sample& s = reference.samples[i];
    if (!counts(reference, i, model[i], scan)) continue;
    const double weight = spectral ? spectra.y_bar.at_or_zero(s.wavelength_nm) : 1;
    Pair& luminance = luminances[refs::direction_from_sun(s)];
    luminance.model += weight * model[i];
    luminance.value += weight * s.value;
    if (!spectral || s.wavelength_nm < kShortestNm || s.wavelength_nm > kLongestNm) continue;
    difference2 += std::pow(model[i] - s.value, 2);
    value2 += s.value * s.value;
  }
  double sum = 0, squares = 0, count = 0;
  for (const auto& [direction, luminance] : luminances) {
    if (!has_luminances || !(luminance.value > 0)) continue;
    ++count;
    const double relative = luminance.model / luminance.value - 1;
    sum += relative;
    squares += relative * relative;
  }
  return {rms_log_percent(reference, model, 0, kAnySun, scan), 100 * std::sqrt(squares / count),
          percent_of_norm(difference2, value2), 100 * sum / count};
}

RmsSummary rms_summary(const refs::Reference& reference, const std::vector<double>& model,
                       double exclude_sun) {
  const auto rms = [&](double cone, double sun) {
    return rms_log_percent(reference, model, cone, sun, -1);
  };
  constexpr double kAnySun = 180 * kRadiansPerDegree;
  return {rms(exclude_sun, kAnySun), rms(3 * kRadiansPerDegree, kAnySun),
          rms(10 * kRadiansPerDegree, kAnySun), rms(exclude_sun, 70 * kRadiansPerDegree)};
}

}  // namespace skyfit::fit
