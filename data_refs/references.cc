// SPDX-License-Identifier: Apache-2.0
#include "data_refs/references.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "data_refs/cie_sky.h"
#include "data_refs/csv.h"
#include "data_refs/embedded.h"
#include "data_refs/measured_formats.h"
#include "data_refs/perez_sky.h"
#include "data_refs/radiance_sky.h"
#include "data_refs/sampling.h"
#include "data_refs/truth.h"
#include "data_refs/weather_file.h"
#include "model/base/input_file.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kCiePrefix = "cie:";
constexpr std::string_view kTraditionalOvercast = "cie:traditional-overcast";
constexpr std::string_view kPresetFolder = "presets/", kPresetExtension = ".json";

std::string cie_name(const CieSky& sky) { return fmt::format("{}{}", kCiePrefix, sky.type); }

// "perez:FILE@TIME"
bool is_weather_name(std::string_view name) {
  return is_perez_name(name) && name.find('@') != std::string_view::npos;
}

void expect_suns(std::string_view name, const std::vector<double>& sun_zenith) {
  if (sun_zenith.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: no sun_zenith_deg given, expected at least one", name));
  }
  for (const double zenith : sun_zenith) {
    if (zenith >= 0 && zenith < std::numbers::pi / 2) continue;
    throw std::invalid_argument(fmt::format(
        "{}: sun_zenith_deg = {:.9g}: expected 0 <= sun_zenith_deg < 90, a sun above the horizon",
        name, zenith * kDegreesPerRadian));
  }
}

Reference sampled(const std::vector<double>& sun_zenith, Sampling sampling,
                  const std::function<double(const Sample&)>& relative_luminance) {
  Reference reference;
  for (std::size_t scan = 0; scan < sun_zenith.size(); ++scan) {
    for (const SkyDirection& direction : sampling_directions(sampling)) {
      Sample sample;
      sample.sun_zenith = sun_zenith[scan];
      sample.view_zenith = direction.view_zenith;
      sample.relative_azimuth = direction.relative_azimuth;
      sample.scan = static_cast<int>(scan);
      sample.value = relative_luminance(sample);
      reference.samples.push_back(sample);
    }
  }
  return reference;
}

// `name` is one of the analytic ones of shipped_references(), or "perez:EPSILON,DELTA".
Reference perez_reference(const PerezSky& sky, std::string_view name,
                          const std::vector<double>& suns, Sampling sampling) {
  return sampled(suns, sampling, [&](const Sample& s) {
    const double value =
        perez_relative_luminance(sky, s.sun_zenith, s.view_zenith, scattering_angle(s));
    if (value > 0) return value;
    throw std::invalid_argument(fmt::format(
        "{}: the luminance at sun zenith {:.6g}, view zenith {:.6g} deg is {:.3g} of the "
        "zenith's: expected a clearness and brightness that go together",
        name, s.sun_zenith * kDegreesPerRadian, s.view_zenith * kDegreesPerRadian, value));
  });
}

// "perez:FILE@TIME": the sun is that of the hour.
Reference weather_reference(std::string_view name, Sampling sampling) {
  const WeatherHour hour = weather_hour(name.substr(name.find(':') + 1));
  const PerezHour perez = perez_hour(hour, name);
  Reference reference = perez_reference(perez.sky, name, {perez.sun.zenith}, sampling);
  reference.description = fmt::format(
      "Perez, Seals & Michalsky 1993 of direct normal {:.6g} and diffuse horizontal {:.6g} W/m^2: "
      "clearness {:.4g}, brightness {:.4g}, sun zenith {:.2f} deg at {}",
      hour.direct_normal_w_m2, hour.diffuse_horizontal_w_m2, perez.sky.epsilon, perez.sky.delta,
      perez.sun.zenith * kDegreesPerRadian, iso_text(hour.middle));
  return reference;
}

// A scene of Radiance with a sky: its luminances under its sun, or where it has none under that of
// the caller.
Reference radiance_reference(const std::filesystem::path& file,
                             const std::vector<double>& sun_zenith, Sampling sampling) {
  const RadianceSky sky =
      parse_radiance_sky(read_text_file(file, "a scene of Radiance"), file.string());
  if (!sky.sun && sun_zenith.size() != 1) {
    throw std::invalid_argument(
        fmt::format("{}: a sky without a sun, of one time: expected one sun_zenith_deg, got {}",
                    file.string(), sun_zenith.size()));
  }
  const std::vector<double> suns = sky.sun ? std::vector{sky.sun->zenith} : sun_zenith;
  expect_suns(file.string(), suns);
  Reference reference = sampled(suns, sampling, [&](const Sample& s) {
    const double luminance = radiance_sky_luminance(sky, s.view_zenith, scattering_angle(s));
    if (luminance > 0 && std::isfinite(luminance)) return luminance;
    throw std::invalid_argument(fmt::format(
        "{}: the luminance at view zenith {:.6g} deg is {:.3g} cd/m^2: expected more than 0",
        file.string(), s.view_zenith * kDegreesPerRadian, luminance));
  });
  reference.quantity = Quantity::kLuminance;
  reference.name = file.string();
  reference.description = sky.description();
  if (sky.sun) {
    Scan scan;
    scan.name = file.string();
    scan.sun_azimuth = sky.sun->azimuth;
    reference.scans.push_back(scan);
  }
  return reference;
}

Reference analytic_reference(std::string_view name, const std::vector<double>& suns,
                             Sampling sampling) {
  if (name == kTraditionalOvercast) {
    return sampled(suns, sampling, [](const Sample& s) {
      return traditional_overcast_relative_luminance(s.view_zenith);
    });
  }
  if (is_perez_name(name)) {
    return perez_reference(perez_sky_named(name), name, suns, sampling);
  }
  const std::span<const CieSky> skies = cie_skies();
  const auto sky = std::find_if(skies.begin(), skies.end(),
                                [&](const CieSky& s) { return cie_name(s) == name; });
  return sampled(suns, sampling, [&](const Sample& s) {
    return cie_relative_luminance(*sky, s.sun_zenith, s.view_zenith, scattering_angle(s));
  });
}

}  // namespace

std::vector<ReferenceEntry> shipped_references() {
  std::vector<ReferenceEntry> entries;
  for (const CieSky& sky : cie_skies()) {
    entries.push_back(
        {cie_name(sky), fmt::format("CIE S 011 type {}: {}", sky.type, sky.description)});
  }
  entries.push_back({std::string(kTraditionalOvercast),
                     "CIE traditional overcast sky (Moon & Spencer 1942): (1 + 2 cos Z) / 3"});
  return entries;
}

std::vector<std::string> reference_names(std::string_view list) {
  std::vector<std::string> names;
  bool is_delta = false;  // of the name before
  for (const std::string_view part : split(list, ',')) {
    if (is_delta) {
      names.back().append(1, ',').append(part);
    } else {
      names.emplace_back(part);
    }
    is_delta = !is_delta && is_perez_name(part) && !is_weather_name(part);
  }
  return names;
}

Reference load_reference(std::string_view name, const std::vector<double>& sun_zenith,
                         Sampling sampling, const ImportOptions& options) {
  if (is_weather_name(name)) {
    Reference reference = weather_reference(name, sampling);
    reference.name = name;
    return reference;
  }
  if (is_perez_name(name)) {
    expect_suns(name, sun_zenith);
    Reference reference = analytic_reference(name, sun_zenith, sampling);
    reference.name = name;
    reference.description = "Perez, Seals & Michalsky 1993, all-weather sky";
    return reference;
  }
  for (const TruthEntry& truth : truth_references()) {
    if (truth.name == name) return truth_reference(name);
  }
  for (const ReferenceEntry& entry : shipped_references()) {
    if (entry.name != name) continue;
    expect_suns(name, sun_zenith);
    Reference reference = analytic_reference(name, sun_zenith, sampling);
    reference.name = entry.name;
    reference.description = entry.description;
    return reference;
  }
  const std::filesystem::path file(name);
  if (is_radiance_sky_file(name)) return radiance_reference(file, sun_zenith, sampling);
  if (std::filesystem::exists(file)) return load_measured_sky(file, options);
  throw std::invalid_argument(
      fmt::format("{}: no such file or reference, expected cie:1 to cie:{}, {}, "
                  "perez:EPSILON,DELTA, a truth: of `skyfit references` or a measured sky",
                  name.empty() ? "\"\"" : name, cie_skies().size(), kTraditionalOvercast));
}

std::string preset_schema_json() { return std::string(embedded_text("preset.schema.json")); }

std::vector<std::string> shipped_preset_names() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : embedded_files()) {
    if (!file.name.starts_with(kPresetFolder)) continue;
    const std::string_view name = file.name.substr(kPresetFolder.size());
    names.emplace_back(name.substr(0, name.size() - kPresetExtension.size()));
  }
  return names;
}

std::string shipped_preset_json(std::string_view name) {
  const std::vector<std::string> names = shipped_preset_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw std::invalid_argument(
        fmt::format("{}: unknown preset, expected one of {}", name, fmt::join(names, ", ")));
  }
  return std::string(embedded_text(fmt::format("{}{}{}", kPresetFolder, name, kPresetExtension)));
}

}  // namespace skyfit::refs
