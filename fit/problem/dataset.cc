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
  if (sample.weight == 0) return false;
  return sample.irradiance || refs::scattering_angle(sample) >= selection.exclude_sun - kRounding;
}

void check(const refs::Reference& reference, std::size_t index, const Selection& selection) {
  const refs::Sample& sample = reference.samples[index];
  const bool beside = refs::is_beside_sky(reference, sample);
  const bool spectral = !beside && reference.quantity == refs::Quantity::kSpectralRadiance;
  if (spectral != (sample.wavelength_nm > 0))
    fail(reference, index, "wavelength_nm", sample.wavelength_nm,
         spectral ? "> 0 for a spectral radiance" : "0 for a luminance");
  if (beside ? !reference.irradiance_quantity
             : refs::is_irradiance(reference.quantity) != sample.irradiance.has_value())
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

// Of nodes that come after those there are.
Channel appended_channel(Dataset& data, const std::vector<WavelengthNode>& nodes,
                         const std::vector<double>& weight) {
  Channel channel{0, {}, weight};
  for (const WavelengthNode& node : nodes) {
    channel.node.push_back(static_cast<int>(data.nodes.size()));
    data.nodes.push_back(node);
  }
  return channel;
}

using SunOfScan = std::pair<int, double>;  // the number of a scan, and the zenith angle of a sun
SunOfScan sun_of(const refs::Sample& sample) { return {sample.scan, sample.sun_zenith}; }

// docs/theory (10.6). All suns share the nodes.
BroadbandRule broadband_rule_of(const refs::Reference& reference, const SpectralData& spectra,
                                const refs::Sample& sample) {
  const auto number = static_cast<std::size_t>(sample.scan);
  if (number >= reference.scans.size() || !reference.scans[number].precipitable_water_mm) {
    throw std::invalid_argument(fmt::format(
        "{}: {}: precipitable_water_mm: must be known of an irradiance of all wavelengths",
        reference.name, scan_info(reference, sample).name));
  }
  return broadband_rule(spectra, refs::standard_gas_absorption(), sample.sun_zenith,
                        *reference.scans[number].precipitable_water_mm);
}

// The channel of a sample; nothing of a wavelength that was not chosen.
class Channels {
 public:
  Channels(const refs::Reference& reference, const SpectralData& spectra,
           const std::vector<std::size_t>& used, int largest)
      : reference_(reference), spectra_(spectra) {
    std::set<double> wavelengths;
    for (const std::size_t i : used) {
      if (quantity_of(i) == refs::Quantity::kSpectralRadiance)
        wavelengths.insert(reference.samples[i].wavelength_nm);
    }
    if (!wavelengths.empty())
      add_spectral_channels(data_, reference, spectra, wavelengths_of(wavelengths, largest));
    for (const std::size_t i : used) add(i, largest > 0);
  }
  void move_to(Dataset& data) {
    data.nodes = std::move(data_.nodes);
    data.channels = std::move(data_.channels);
  }
  std::optional<int> of(std::size_t sample) const {
    const refs::Sample& s = reference_.samples[sample];
    switch (quantity_of(sample)) {
      case refs::Quantity::kSpectralRadiance:
        break;
      case refs::Quantity::kIrradiance:
        return of_sun_.at(sun_of(s));
      default:
        return luminance_;
    }
    const auto at = std::ranges::find(data_.channels, s.wavelength_nm, &Channel::wavelength_nm);
    if (at == data_.channels.end()) return {};
    return static_cast<int>(at - data_.channels.begin());
  }

 private:
  refs::Quantity quantity_of(std::size_t sample) const {
    return refs::quantity_of(reference_, reference_.samples[sample]);
  }

  void add(std::size_t index, bool coarse) {
    const refs::Sample& sample = reference_.samples[index];
    const auto next = static_cast<int>(data_.channels.size());
    const refs::Quantity quantity = quantity_of(index);
    if (quantity == refs::Quantity::kSpectralRadiance) return;
    if (quantity != refs::Quantity::kIrradiance) {
      if (luminance_) return;
      luminance_ = next;
      const LuminanceRule rule =
          coarse ? coarse_luminance_rule(spectra_) : luminance_rule(spectra_);
      data_.channels.push_back(appended_channel(data_, rule.nodes, rule.weight));
      return;
    }
    if (!of_sun_.try_emplace(sun_of(sample), next).second) return;
    const BroadbandRule rule = broadband_rule_of(reference_, spectra_, sample);
    if (broadband_nodes_.empty()) {
      data_.channels.push_back(appended_channel(data_, rule.nodes, rule.weight));
      broadband_nodes_ = data_.channels.back().node;
    } else {
      data_.channels.push_back({0, broadband_nodes_, rule.weight});
    }
  }

  const refs::Reference& reference_;
  const SpectralData& spectra_;
  Dataset data_;  // its nodes and channels
  std::optional<int> luminance_;
  std::map<SunOfScan, int> of_sun_;
  std::vector<int> broadband_nodes_;
};

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

// The view of a sample, and its line of sight where that is a new one.
void add_direction(Dataset& data, const refs::Sample& sample, bool is_new) {
  if (!is_new && is_view_of(data.views.back(), sample)) return;
  const auto info = std::ranges::find(data.scans, sample.scan, &ScanInfo::number);
  const int scan = static_cast<int>(info - data.scans.begin());
  const SkyPoint point = sky_point(sample);
  if (is_new) data.lines_of_sight.push_back({scan, point});
  data.views.push_back({scan, point, info->sun_azimuth + sample.sun_azimuth_since});
}

// Irradiances beside a sky last, sorted by line of sight, wavelength and sun. Lines of sight of
// luminances stay in the order of the samples; those of spectra, whose wavelengths may come one
// after the other, are sorted as well.
std::vector<std::size_t> in_order(const refs::Reference& reference,
                                  std::vector<std::size_t> samples) {
  const bool spectral = reference.quantity == refs::Quantity::kSpectralRadiance;
  std::map<refs::DirectionFromSun, std::size_t> first;
  for (const std::size_t i : samples)
    first.try_emplace(refs::direction_from_sun(reference.samples[i]), i);
  std::ranges::stable_sort(samples, {}, [&](std::size_t i) {
    const refs::Sample& s = reference.samples[i];
    const refs::DirectionFromSun direction = refs::direction_from_sun(s);
    return std::tuple(refs::is_beside_sky(reference, s), s.scan, spectral ? 0 : first.at(direction),
                      direction, s.wavelength_nm, s.sun_zenith);
  });
  return samples;
}

void add_samples(Dataset& data, const refs::Reference& reference,
                 const std::vector<std::size_t>& samples, const Channels& channels,
                 const Selection& selection) {
  std::optional<refs::DirectionFromSun> last;
  for (const std::size_t i : in_order(reference, samples)) {
    const refs::Sample& sample = reference.samples[i];
    const std::optional<int> channel = channels.of(i);
    if (!channel) continue;
    const auto direction = refs::direction_from_sun(sample);
    add_direction(data, sample, direction != last);
    last = direction;
    const bool beside_sky = refs::is_beside_sky(reference, sample);
    data.samples.push_back({i, static_cast<int>(data.lines_of_sight.size()) - 1,
                            static_cast<int>(data.views.size()) - 1, *channel, sample.value,
                            sigma_of(sample, beside_sky ? NoiseModel{} : selection.noise)});
    data.samples.back().irradiance = sample.irradiance;
    data.samples.back().beside_sky = beside_sky;
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

template <class Belongs>
std::vector<int> indices_of(const Dataset& data, const Belongs& belongs) {
  std::vector<int> indices;
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    if (belongs(data.samples[i])) indices.push_back(static_cast<int>(i));
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
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    if (!is_used(reference.samples[i], spectra, selection)) continue;
    check(reference, i, selection);
    used.push_back(i);
  }
  Dataset data;
  data.scans = all_scans(reference);
  Channels channels(reference, spectra, used, selection.largest_channels);
  add_samples(data, reference, used, channels, selection);
  channels.move_to(data);
  return data;
}

std::vector<int> polarisations(const Dataset& data) {
  return indices_of(data, [](const Sample& sample) { return sample.polarisation.has_value(); });
}
std::vector<int> irradiances_beside_sky(const Dataset& data) {
  return indices_of(data, [](const Sample& sample) { return sample.beside_sky; });
}
std::vector<int> radiances(const Dataset& data) {
  return indices_of(
      data, [](const Sample& sample) { return !sample.polarisation && !sample.beside_sky; });
}

Dataset only_sky(Dataset data) {
  const auto first = std::ranges::find(data.samples, true, &Sample::beside_sky);
  if (first == data.samples.end()) return data;
  data.lines_of_sight.erase(data.lines_of_sight.begin() + first->line_of_sight,
                            data.lines_of_sight.end());
  data.views.erase(data.views.begin() + first->view, data.views.end());
  data.samples.erase(first, data.samples.end());
  int channels = 0;
  for (const Sample& sample : data.samples) channels = std::max(channels, sample.channel + 1);
  data.channels.resize(static_cast<std::size_t>(channels));
  return data;
}

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
