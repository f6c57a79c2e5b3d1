// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "data_refs/sample_csv.h"
#include "data_refs/sample_csv_columns.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {

using namespace sample_csv;

namespace {

constexpr double kPi = std::numbers::pi;

struct OutputColumn {
  std::string_view name;
  std::function<std::string(const Sample&)> field;
};

// As it stands where it can.
std::string quoted_field(const std::string& text) {
  if (text.find_first_of(",\"# \t") == text.npos) return text;
  std::string result = "\"";
  for (const char c : text) result.append(c == '"' ? 2 : 1, c);
  result += '"';
  return result;
}

// The columns of a scan's facts that some scan has.
void add_scan_columns(const std::vector<Scan>& scans, std::vector<OutputColumn>& columns) {
  const auto add = [&](std::string_view name, const auto& has, const auto& field) {
    if (!std::ranges::any_of(scans, has)) return;
    columns.push_back({name, [&scans, field](const Sample& s) { return field(scans[s.scan]); }});
  };
  add(
      kTime, [](const Scan& scan) { return !scan.time_utc.empty(); },
      [](const Scan& scan) { return scan.time_utc; });
  add(
      kDistance, [](const Scan& scan) { return scan.sun_distance_au != 1; },
      [](const Scan& scan) { return fmt::format("{:.9g}", scan.sun_distance_au); });
  add(
      kElevation, [](const Scan& scan) { return scan.elevation_m.has_value(); },
      [](const Scan& scan) { return fmt::format("{:.9g}", scan.elevation_m.value_or(0)); });
}

void add_direction_columns(const Reference& reference, std::vector<OutputColumn>& columns) {
  const auto degrees = [](double radians) {
    return fmt::format("{:.9g}", radians / kRadiansPerDegree);
  };
  columns.push_back({kSunZenith, [=](const Sample& s) { return degrees(s.sun_zenith); }});
  columns.push_back({kViewZenith, [=](const Sample& s) { return degrees(s.view_zenith); }});
  const std::vector<Scan>& scans = reference.scans;
  const bool absolute = !scans.empty() && std::ranges::all_of(scans, [](const Scan& scan) {
    return scan.sun_azimuth.has_value();
  });
  if (!absolute) {
    columns.push_back(
        {kRelativeAzimuth, [=](const Sample& s) { return degrees(s.relative_azimuth); }});
    return;
  }
  columns.push_back(
      {kSunAzimuth, [=, &scans](const Sample& s) { return degrees(*scans[s.scan].sun_azimuth); }});
  columns.push_back(
      {kViewAzimuth, [=, &scans](const Sample& s) {
         return degrees(std::remainder(*scans[s.scan].sun_azimuth + s.relative_azimuth, 2 * kPi));
       }});
}

const PolarisationReading* reading_of(const Sample& sample, Polarisation what) {
  const auto at = std::ranges::find(sample.polarisation, what, &PolarisationReading::what);
  return at == sample.polarisation.end() ? nullptr : &*at;
}

// Empty where it was not measured.
void add_polarisation_columns(const std::vector<Sample>& samples,
                              std::vector<OutputColumn>& columns) {
  for (const PolarisationColumn& column : kPolarisationColumns) {
    const Polarisation what = column.what;
    const auto is_read = [=](const Sample& s) { return reading_of(s, what) != nullptr; };
    const auto has_sigma = [=](const Sample& s) {
      const PolarisationReading* const reading = reading_of(s, what);
      return reading != nullptr && reading->sigma;
    };
    if (!std::ranges::any_of(samples, is_read)) continue;
    columns.push_back({column.name, [=](const Sample& s) {
                         const PolarisationReading* const reading = reading_of(s, what);
                         return reading ? fmt::format("{:.9g}", reading->value) : std::string();
                       }});
    const bool all_have_sigma =
        std::ranges::all_of(samples, [&](const Sample& s) { return !is_read(s) || has_sigma(s); });
    if (!all_have_sigma) continue;
    columns.push_back({column.sigma, [=](const Sample& s) {
                         const PolarisationReading* const reading = reading_of(s, what);
                         return reading ? fmt::format("{:.9g}", *reading->sigma) : std::string();
                       }});
  }
}

std::vector<OutputColumn> output_columns(const Reference& reference) {
  const auto any = [&](const auto& holds) { return std::ranges::any_of(reference.samples, holds); };
  const auto all = [&](const auto& holds) { return std::ranges::all_of(reference.samples, holds); };
  const auto number = [](double value) { return fmt::format("{:.9g}", value); };
  std::vector<OutputColumn> columns;
  add_direction_columns(reference, columns);
  if (reference.quantity == Quantity::kSpectralRadiance)
    columns.push_back({kWavelength, [=](const Sample& s) { return number(s.wavelength_nm); }});
  columns.push_back(
      {value_column(reference.quantity), [=](const Sample& s) { return number(s.value); }});
  if (all([](const Sample& s) { return s.sigma.has_value(); }))
    columns.push_back({kSigma, [=](const Sample& s) { return number(*s.sigma); }});
  add_polarisation_columns(reference.samples, columns);
  columns.push_back({kWeight, [=](const Sample& s) { return number(s.weight); }});
  if (any([](const Sample& s) { return !s.zero_weight_reason.empty(); }))
    columns.push_back(
        {kReason, [](const Sample& s) { return quoted_field(s.zero_weight_reason); }});
  if (any([](const Sample& s) { return s.direction != 0; }))
    columns.push_back({kDirection, [](const Sample& s) { return std::to_string(s.direction); }});
  const std::vector<Scan>& scans = reference.scans;
  columns.push_back({kScan, [&scans](const Sample& s) {
                       return scans.empty() ? std::to_string(s.scan)
                                            : quoted_field(scans[s.scan].name);
                     }});
  add_scan_columns(scans, columns);
  return columns;
}

}  // namespace

std::string sample_csv_text(const Reference& reference) {
  std::string text = fmt::format(
      "# {}\n", printable(fmt::format("{}: {}", reference.name, reference.description)));
  const std::vector<OutputColumn> columns = output_columns(reference);
  const auto append = [&](const auto& field) {
    for (const OutputColumn& column : columns) text += field(column) + ",";
    text.back() = '\n';
  };
  append([](const OutputColumn& column) { return std::string(column.name); });
  for (const Sample& sample : reference.samples)
    append([&](const OutputColumn& column) { return column.field(sample); });
  return text;
}

}  // namespace skyfit::refs
