// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/dataset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "data_refs/gas_absorption.h"
#include "model/photometry/broadband.h"

namespace skyfit::fit {
namespace {

constexpr double kRounding = 1e-9;  // radians: a sample on the rim of the cone stays in

[[noreturn]] void fail(const refs::Reference& reference, std::size_t index, std::string_view field,
                       double value, std::string_view expected) {
  throw std::invalid_argument(fmt::format("{}: sample {}: {} = {:.9g}: must be {}", reference.name,
                                          index + 1, field, value, expected));
}

bool is_used(const refs::Sample& sample, const SpectralData& spectra, const Selection& selection) {
  if (selection.with_weightless)
    return sample.wavelength_nm == 0 || has_spectra_at(spectra, sample.wavelength_nm);
  return sample.weight != 0 && refs::scattering_angle(sample) >= selection.exclude_sun - kRounding;
}

void check(const refs::Reference& reference, std::size_t index, const Selection& selection) {
  const refs::Sample& sample = reference.samples[index];
  const bool spectral = reference.quantity == refs::Quantity::kSpectralRadiance;
  if (spectral != (sample.wavelength_nm > 0))
    fail(reference, index, "wavelength_nm", sample.wavelength_nm,
         spectral ? "> 0 for a spectral radiance" : "0 for a luminance");
  if (refs::is_irradiance(reference.quantity) != sample.irradiance.has_value())
    fail(reference, index, "irradiance", sample.irradiance.value_or(kDirectNormal),
         "known of an irradiance and of nothing else");
  if (selection.with_weightless) return;
  if (!(sample.value > 0) || !std::isfinite(sample.value))
    fail(reference, index, "value", sample.value, "finite and > 0");
  if (!std::isfinite(sample.weight) || sample.weight < 0)
    fail(reference, index, "weight", sample.weight, ">= 0");
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

void add_spectral_channels(Dataset& data, const refs::Reference& reference,
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

// docs/theory (10.6): a channel for each scan, in the order of data.scans.
void add_broadband_channels(Dataset& data, const refs::Reference& reference,
                            const SpectralData& spectra) {
  for (const ScanInfo& info : data.scans) {
    const auto number = static_cast<std::size_t>(info.number);
    if (number >= reference.scans.size() || !reference.scans[number].precipitable_water_mm) {
      throw std::invalid_argument(fmt::format(
          "{}: {}: precipitable_water_mm: must be known of an irradiance of all wavelengths",
          reference.name, info.name));
    }
    const BroadbandRule rule =
        broadband_rule(spectra, refs::standard_gas_absorption(), info.sun_zenith,
                       *reference.scans[number].precipitable_water_mm);
    data.nodes = rule.nodes;
    Channel channel{0, {}, rule.weight};
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) channel.node.push_back(static_cast<int>(k));
    data.channels.push_back(channel);
  }
}

void add_luminance_channel(Dataset& data, const LuminanceRule& rule) {
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

bool is_view_of(const View& view, const refs::Sample& sample) {
  return view.stated.sun_zenith == sample.sun_zenith &&
         view.stated.view_zenith == sample.view_zenith &&
         view.stated.relative_azimuth == sample.relative_azimuth;
}

// Its channel among those of the dataset; nothing where it was not chosen.
std::optional<int> channel_of(const Dataset& data, refs::Quantity quantity,
                              const refs::Sample& sample) {
  const auto at =
      quantity == refs::Quantity::kIrradiance
          ? std::ranges::find(data.scans, sample.scan, &ScanInfo::number) - data.scans.begin()
          : std::ranges::find(data.channels, sample.wavelength_nm, &Channel::wavelength_nm) -
                data.channels.begin();
  if (at >= static_cast<std::ptrdiff_t>(data.channels.size())) return {};
  return static_cast<int>(at);
}

// The view of a sample, and its line of sight where that is a new one.
void add_direction(Dataset& data, const refs::Sample& sample, bool is_new) {
  if (!is_new && is_view_of(data.views.back(), sample)) return;
  const auto info = std::ranges::find(data.scans, sample.scan, &ScanInfo::number);
  const int scan = static_cast<int>(info - data.scans.begin());
  const SkyPoint point = sky_point(sample);
  if (is_new) data.lines_of_sight.push_back({scan, point});
  data.views.push_back({scan, point, info->sun_azimuth + sample.sun_azimuth_since});
}

// Sorted by line of sight, wavelength and sun. Lines of sight of luminances stay in the order of
// the samples; those of spectra, whose wavelengths may come one after the other, are sorted as
// well.
std::vector<std::size_t> in_order(const refs::Reference& reference,
                                  std::vector<std::size_t> samples) {
  const bool spectral = reference.quantity == refs::Quantity::kSpectralRadiance;
  std::map<refs::DirectionFromSun, std::size_t> first;
  for (const std::size_t i : samples)
    first.try_emplace(refs::direction_from_sun(reference.samples[i]), i);
  std::ranges::stable_sort(samples, {}, [&](std::size_t i) {
    const refs::Sample& s = reference.samples[i];
    const refs::DirectionFromSun direction = refs::direction_from_sun(s);
    return std::tuple(s.scan, spectral ? 0 : first.at(direction), direction, s.wavelength_nm,
                      s.sun_zenith);
  });
  return samples;
}

void add_samples(Dataset& data, const refs::Reference& reference,
                 const std::vector<std::size_t>& samples, const Selection& selection) {
  std::optional<refs::DirectionFromSun> last;
  for (const std::size_t i : in_order(reference, samples)) {
    const refs::Sample& sample = reference.samples[i];
    const std::optional<int> channel = channel_of(data, reference.quantity, sample);
    if (!channel) continue;
    const auto direction = refs::direction_from_sun(sample);
    add_direction(data, sample, direction != last);
    last = direction;
    data.samples.push_back({i, static_cast<int>(data.lines_of_sight.size()) - 1,
                            static_cast<int>(data.views.size()) - 1, *channel, sample.value,
                            sigma_of(sample, selection.noise)});
    data.samples.back().irradiance = sample.irradiance;
    if (!selection.with_polarisation) continue;
    for (const refs::PolarisationReading& reading : sample.polarisation) {
      data.samples.push_back(data.samples.back());
      data.samples.back().value = reading.value;
      data.samples.back().sigma =
          reading.sigma.value_or(kPolarisationSigma) / std::sqrt(sample.weight);
      data.samples.back().polarisation = reading.what;
    }
  }
}

std::vector<int> indices_of(const Dataset& data, bool polarised) {
  std::vector<int> indices;
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    if (data.samples[i].polarisation.has_value() == polarised)
      indices.push_back(static_cast<int>(i));
  }
  return indices;
}

}  // namespace

SkyPoint sky_point(const refs::Sample& sample) {
  return {0, sample.sun_zenith, sample.view_zenith, sample.relative_azimuth};
}

std::vector<int> Dataset::samples_per_line_of_sight() const {
  std::vector<int> counts(lines_of_sight.size(), 0);
  for (const Sample& sample : samples) ++counts[static_cast<std::size_t>(sample.line_of_sight)];
  return counts;
}

Dataset dataset(const refs::Reference& reference, const SpectralData& spectra,
                const Selection& selection) {
  std::vector<std::size_t> used;
  std::set<double> wavelengths;
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    if (!is_used(reference.samples[i], spectra, selection)) continue;
    check(reference, i, selection);
    used.push_back(i);
    wavelengths.insert(reference.samples[i].wavelength_nm);
  }
  Dataset data;
  data.scans = all_scans(reference);
  if (reference.quantity == refs::Quantity::kSpectralRadiance) {
    add_spectral_channels(data, reference, spectra,
                          wavelengths_of(wavelengths, selection.largest_channels));
  } else if (reference.quantity == refs::Quantity::kIrradiance) {
    add_broadband_channels(data, reference, spectra);
  } else {
    add_luminance_channel(data, selection.largest_channels > 0 ? coarse_luminance_rule(spectra)
                                                               : luminance_rule(spectra));
  }
  add_samples(data, reference, used, selection);
  return data;
}

std::vector<int> radiances(const Dataset& data) { return indices_of(data, false); }
std::vector<int> polarisations(const Dataset& data) { return indices_of(data, true); }

Dataset only_samples(const Dataset& data, const std::vector<int>& indices) {
  Dataset result{data.nodes, data.channels, data.scans, data.lines_of_sight, data.views, {}};
  for (const int i : indices) result.samples.push_back(data.samples[static_cast<std::size_t>(i)]);
  return result;
}

Dataset only_scan(Dataset data, int scan) {
  std::erase_if(data.samples, [&](const Sample& sample) { return data.scan_of(sample) != scan; });
  return data;
}

}  // namespace skyfit::fit
