// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/scan_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "fit/problem/observations.h"

namespace skyfit::fit {
namespace {

constexpr double kRounding = 1e-9;  // radians: a sample on the rim of the cone stays in

[[noreturn]] void fail(const refs::Reference& reference, std::size_t index, std::string_view field,
                       double value, std::string_view expected) {
  throw std::invalid_argument(fmt::format("{}: sample {}: {} = {:.9g}: must be {}", reference.name,
                                          index + 1, field, value, expected));
}

bool is_used(const refs::Sample& sample, const SpectralData& spectra,
             const ScanSelection& selection) {
  if (selection.with_weightless)
    return sample.wavelength_nm == 0 || has_spectra_at(spectra, sample.wavelength_nm);
  return (sample.weight > 0 && refs::scattering_angle(sample) >= selection.exclude_sun - kRounding);
}

void check(const refs::Reference& reference, std::size_t index, const ScanSelection& selection) {
  const refs::Sample& sample = reference.samples[index];
  const bool spectral = reference.quantity == refs::Quantity::kSpectralRadiance;
  if (spectral != (sample.wavelength_nm > 0))
    fail(reference, index, "wavelength_nm", sample.wavelength_nm,
         spectral ? "> 0 for a spectral radiance" : "0 for a luminance");
  if (selection.with_weightless) return;
  if (!(sample.value > 0) || !std::isfinite(sample.value))
    fail(reference, index, "value", sample.value, "finite and > 0");
  if (sample.sigma && !(*sample.sigma > 0 && std::isfinite(*sample.sigma)))
    fail(reference, index, "sigma", *sample.sigma, "finite and > 0");
}

std::vector<double> wavelengths_of(const std::set<double>& all, int largest) {
  std::vector<double> result(all.begin(), all.end());
  const int count = static_cast<int>(result.size());
  if (largest <= 0 || count <= largest) return result;
  std::vector<double> chosen;
  for (int k = 0; k < largest; ++k)
    chosen.push_back(result[static_cast<std::size_t>((2 * k + 1) * count / (2 * largest))]);
  return chosen;
}

void add_spectral_channels(ScanData& data, const refs::Reference& reference,
                           const SpectralData& spectra, const std::vector<double>& wavelengths) {
  try {
    data.nodes = spectral_nodes(spectra, wavelengths);
    for (std::size_t k = 0; k < wavelengths.size(); ++k) {
      data.channels.push_back(
          {wavelengths[k], {static_cast<int>(k)}, {spectra.solar_irradiance.at(wavelengths[k])}});
    }
  } catch (const std::out_of_range& error) {
    throw std::invalid_argument(fmt::format("{}: {}", reference.name, error.what()));
  }
}

void add_luminance_channel(ScanData& data, const LuminanceRule& rule) {
  data.nodes = rule.nodes;
  Channel channel;
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) channel.node.push_back(static_cast<int>(k));
  channel.weight = rule.weight;
  data.channels.push_back(channel);
}

ScanInfo scan_info(const refs::Reference& reference, const refs::Sample& sample) {
  ScanInfo info;
  info.number = sample.scan;
  info.name = fmt::format("scan {}", sample.scan + 1);
  info.sun_zenith = sample.sun_zenith;
  if (static_cast<std::size_t>(sample.scan) < reference.scans.size()) {
    const refs::Scan& scan = reference.scans[static_cast<std::size_t>(sample.scan)];
    if (!scan.name.empty()) info.name = scan.name;
    info.time_utc = scan.time_utc;
    info.sun_azimuth = scan.sun_azimuth.value_or(0);
    info.inverse_distance2 = 1 / (scan.sun_distance_au * scan.sun_distance_au);
  }
  return info;
}

// In the order of their numbers, used or not.
std::vector<ScanInfo> all_scans(const refs::Reference& reference) {
  std::map<int, ScanInfo> scans;
  for (const refs::Sample& sample : reference.samples) {
    if (!scans.contains(sample.scan)) scans[sample.scan] = scan_info(reference, sample);
  }
  std::vector<ScanInfo> result;
  for (const auto& [number, info] : scans) result.push_back(info);
  return result;
}

double sigma_of(const refs::Sample& sample, const NoiseModel& noise) {
  const double sigma =
      sample.sigma ? *sample.sigma : std::hypot(noise.floor, noise.relative * sample.value);
  return sigma / std::sqrt(sample.weight > 0 ? sample.weight : 1);
}

// Sorted by scan, direction, wavelength and sun.
using Place = std::tuple<refs::DirectionFromSun, double, double>;
Place place_of(const refs::Sample& s) {
  return {refs::direction_from_sun(s), s.wavelength_nm, s.sun_zenith};
}

bool is_ray_of(const Ray& ray, const refs::Sample& sample) {
  return ray.stated.sun_zenith == sample.sun_zenith &&
         ray.stated.view_zenith == sample.view_zenith &&
         ray.stated.relative_azimuth == sample.relative_azimuth;
}

// The ray of a sample, and its look where that is a new one.
void add_direction(ScanData& data, const refs::Sample& sample, bool is_new_look) {
  if (!is_new_look && is_ray_of(data.rays.back(), sample)) return;
  const auto info = std::ranges::find(data.scans, sample.scan, &ScanInfo::number);
  const int scan = static_cast<int>(info - data.scans.begin());
  const SkyPoint point = sky_point(sample);
  if (is_new_look) data.looks.push_back({scan, point});
  data.rays.push_back({scan, point, info->sun_azimuth + sample.sun_azimuth_since});
}

void add_rows(ScanData& data, const refs::Reference& reference, std::vector<std::size_t> samples,
              const NoiseModel& noise) {
  std::ranges::stable_sort(samples, {},
                           [&](std::size_t i) { return place_of(reference.samples[i]); });
  std::map<double, int> channel_of;
  for (std::size_t c = 0; c < data.channels.size(); ++c)
    channel_of[data.channels[c].wavelength_nm] = static_cast<int>(c);
  std::optional<refs::DirectionFromSun> last;
  for (const std::size_t i : samples) {
    const refs::Sample& sample = reference.samples[i];
    const auto channel = channel_of.find(sample.wavelength_nm);
    if (channel == channel_of.end()) continue;
    const auto direction = refs::direction_from_sun(sample);
    const bool is_new_look = direction != last;
    add_direction(data, sample, is_new_look);
    last = direction;
    data.rows.push_back({i, static_cast<int>(data.looks.size()) - 1,
                         static_cast<int>(data.rays.size()) - 1, channel->second, sample.value,
                         sigma_of(sample, noise)});
  }
}

}  // namespace

std::vector<int> ScanData::rows_per_look() const {
  std::vector<int> counts(looks.size(), 0);
  for (const ScanRow& row : rows) ++counts[static_cast<std::size_t>(row.look)];
  return counts;
}

ScanData scan_data(const refs::Reference& reference, const SpectralData& spectra,
                   const ScanSelection& selection) {
  if (reference.quantity == refs::Quantity::kRelativeLuminance) {
    throw std::invalid_argument(fmt::format(
        "{}: relative luminance has no absolute value to fit: expected luminance_cd_m2 or a "
        "spectral radiance",
        reference.name));
  }
  std::vector<std::size_t> used;
  std::set<double> wavelengths;
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    if (!is_used(reference.samples[i], spectra, selection)) continue;
    check(reference, i, selection);
    used.push_back(i);
    wavelengths.insert(reference.samples[i].wavelength_nm);
  }
  ScanData data;
  data.scans = all_scans(reference);
  if (reference.quantity == refs::Quantity::kSpectralRadiance) {
    add_spectral_channels(data, reference, spectra,
                          wavelengths_of(wavelengths, selection.largest_channels));
  } else {
    add_luminance_channel(data, selection.largest_channels > 0 ? coarse_luminance_rule(spectra)
                                                               : luminance_rule(spectra));
  }
  add_rows(data, reference, std::move(used), selection.noise);
  return data;
}

}  // namespace skyfit::fit
