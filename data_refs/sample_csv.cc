// SPDX-License-Identifier: Apache-2.0
#include "data_refs/sample_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "data_refs/civil_time.h"
#include "data_refs/csv.h"
#include "data_refs/sample_csv_columns.h"
#include "data_refs/sun_mends.h"
#include "data_refs/units.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {

using namespace sample_csv;

namespace {

constexpr double kPi = std::numbers::pi;

// The table has one of them.
const ValueColumn& value_column(const CsvTable& table) {
  return *std::ranges::find_if(kValueColumns,
                               [&](const ValueColumn& column) { return table.has(column.name); });
}

void expect_columns(const CsvTable& table) {
  for (const std::string& column : table.columns()) {
    if (std::find(kColumns.begin(), kColumns.end(), column) == kColumns.end()) {
      table.fail_header(fmt::format("{}: unknown column, expected one of {}", excerpt(column),
                                    fmt::join(kColumns, ", ")));
    }
  }
  const auto expect = [&](bool holds, std::string_view what) {
    if (!holds)
      table.fail_header(fmt::format("expected {}, got the columns {}", what,
                                    excerpt(fmt::format("{}", fmt::join(table.columns(), ",")))));
  };
  expect(table.has(kSunZenith), "a column sun_zenith_deg");
  expect(table.has(kViewZenith), "a column view_zenith_deg");
  const bool relative = table.has(kRelativeAzimuth), sun = table.has(kSunAzimuth),
             view = table.has(kViewAzimuth);
  expect(relative ? !sun && !view : sun && view,
         "either relative_azimuth_deg or both of sun_azimuth_deg and view_azimuth_deg");
  const auto values = std::ranges::count_if(
      kValueColumns, [&](const ValueColumn& column) { return table.has(column.name); });
  expect(values == 1,
         "exactly one of luminance_cd_m2, relative_luminance and spectral_radiance_w_m2_sr_nm");
  for (const PolarisationColumn& column : kPolarisationColumns) {
    expect(table.has(column.name) || !table.has(column.sigma),
           fmt::format("{} with {}", column.name, column.sigma));
  }
  expect(!table.has(polarisation_column(Polarisation::kDegree)) ||
             (!table.has(polarisation_column(Polarisation::kQ)) &&
              !table.has(polarisation_column(Polarisation::kU))),
         "either dolp or q_over_i and u_over_i, which say the same");
  expect(table.has(kWavelength) == (value_column(table).quantity == Quantity::kSpectralRadiance),
         "wavelength_nm with a spectral radiance, and only there");
}

// One record of the table, column by column.
class SampleReader {
 public:
  explicit SampleReader(const CsvTable& table)
      : table_(table),
        value_column_(value_column(table).name),
        labels_(table.has(kScan) ? std::vector<std::string>{} : labels_by_sun()) {}

  Sample read(const CsvRecord& record) {
    Sample sample;
    sample.sun_zenith =
        kRadiansPerDegree * checked(record, kSunZenith,
                                    "0 <= sun_zenith_deg < 90, a sun above the horizon",
                                    [](double deg) { return deg >= 0 && deg < 90; });
    sample.relative_azimuth = kRadiansPerDegree * relative_azimuth_deg(record);
    const auto positive = [](double x) { return x > 0; };
    if (table_.has(kWeight))
      sample.weight = checked(record, kWeight, "a number >= 0", [](double x) { return x >= 0; });
    if (sample.weight == 0) sample.zero_weight_reason = reason(record);
    sample.view_zenith = kRadiansPerDegree * view_zenith_deg(record, sample.weight == 0);
    sample.value = sample.weight == 0 ? table_.any_number(record, value_column_)
                                      : checked(record, value_column_, "a number > 0", positive);
    if (table_.has(kWavelength))
      sample.wavelength_nm = checked(record, kWavelength, "a number > 0", positive);
    if (table_.has(kSigma)) sample.sigma = checked(record, kSigma, "a number > 0", positive);
    for (const PolarisationColumn& column : kPolarisationColumns)
      add_reading(record, column, sample);
    if (table_.has(kDirection)) {
      sample.direction =
          static_cast<int>(checked(record, kDirection, "a whole number >= 0", [](double x) {
            return x >= 0 && x < 1e9 && x == std::floor(x);
          }));
    }
    const std::string label = scan_label(record);
    const auto [scan, is_new] = index_of_scan_.emplace(label, static_cast<int>(scans_.size()));
    if (is_new) scans_.push_back(scan_of(record, label));
    sample.scan = scan->second;
    return sample;
  }

  // That were met so far.
  const std::vector<Scan>& scans() const { return scans_; }

 private:
  template <class Holds>
  double checked(const CsvRecord& record, std::string_view column, std::string_view expectation,
                 Holds holds) const {
    const double value = table_.number(record, column);
    if (!holds(value)) table_.fail_value(record, column, expectation);
    return value;
  }

  void add_reading(const CsvRecord& record, const PolarisationColumn& column,
                   Sample& sample) const {
    if (!table_.has(column.name) || table_.text(record, column.name).empty()) return;
    const bool degree = column.what == Polarisation::kDegree;
    const double value =
        checked(record, column.name, degree ? "0 to 1, or nothing" : "-1 to 1, or nothing",
                [&](double x) { return x >= (degree ? 0 : -1) && x <= 1; });
    PolarisationReading reading{column.what, value, {}};
    if (table_.has(column.sigma)) {
      reading.sigma = checked(record, column.sigma, "a number > 0", [](double x) { return x > 0; });
    }
    sample.polarisation.push_back(reading);
  }

  double view_zenith_deg(const CsvRecord& record, bool is_unused) const {
    if (is_unused) {
      return checked(record, kViewZenith, "0 to 180",
                     [](double deg) { return deg >= 0 && deg <= 180; });
    }
    return checked(record, kViewZenith, "0 <= view_zenith_deg < 90, a view above the horizon",
                   [](double deg) { return deg >= 0 && deg < 90; });
  }

  double azimuth_deg(const CsvRecord& record, std::string_view column) const {
    return checked(record, column, "-360 to 360",
                   [](double deg) { return deg >= -360 && deg <= 360; });
  }

  // In -180 .. 180.
  double relative_azimuth_deg(const CsvRecord& record) const {
    const double deg = table_.has(kRelativeAzimuth)
                           ? azimuth_deg(record, kRelativeAzimuth)
                           : azimuth_deg(record, kViewAzimuth) - azimuth_deg(record, kSunAzimuth);
    return std::remainder(deg, 360.0);
  }

  std::string scan_label(const CsvRecord& record) const {
    if (table_.has(kScan)) {
      if (table_.text(record, kScan).empty()) table_.fail_value(record, kScan, "a label");
      return table_.text(record, kScan);
    }
    return labels_[static_cast<std::size_t>(&record - table_.records().data())];
  }

  // Every position of the sun is a scan. Where each sample has one of its own, the sun moves within
  // a scan, until it jumps.
  std::vector<std::string> labels_by_sun() const {
    constexpr double kJump = 1 * kRadiansPerDegree;
    std::vector<std::string> labels;
    for (const CsvRecord& record : table_.records()) {
      labels.push_back(fmt::format("sun zenith {} deg", table_.text(record, kSunZenith)));
      if (table_.has(kSunAzimuth))
        labels.back() += fmt::format(", azimuth {} deg", table_.text(record, kSunAzimuth));
    }
    if (std::set(labels.begin(), labels.end()).size() < labels.size()) return labels;
    std::optional<SolarPosition> last;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const CsvRecord& record = table_.records()[i];
      const SolarPosition sun{
          .zenith = kRadiansPerDegree * table_.number(record, kSunZenith),
          .azimuth =
              table_.has(kSunAzimuth) ? kRadiansPerDegree * table_.number(record, kSunAzimuth) : 0};
      if (last && angle_to_stated(last->zenith, last->azimuth)(sun) < kJump)
        labels[i] = labels[i - 1];
      last = sun;
    }
    return labels;
  }

  std::string reason(const CsvRecord& record) const {
    if (table_.has(kReason) && !table_.text(record, kReason).empty())
      return table_.text(record, kReason);
    return "weight 0 in the file";
  }

  Scan scan_of(const CsvRecord& record, const std::string& label) const {
    Scan scan;
    scan.name = label;
    if (table_.has(kTime)) scan.time_utc = time(record);
    if (table_.has(kSunAzimuth))
      scan.sun_azimuth = kRadiansPerDegree * azimuth_deg(record, kSunAzimuth);
    if (table_.has(kDistance)) {
      scan.sun_distance_au =
          checked(record, kDistance, "a number > 0", [](double x) { return x > 0; });
    }
    if (table_.has(kElevation)) scan.elevation_m = table_.number(record, kElevation);
    return scan;
  }

  std::string time(const CsvRecord& record) const {
    std::string text = table_.text(record, kTime);
    if (text.empty()) return text;
    if (!text.ends_with('Z') || !instant(text.substr(0, text.size() - 1), 0))
      table_.fail_value(record, kTime, "YYYY-MM-DDTHH:MM:SSZ");
    return text;
  }

  const CsvTable& table_;
  std::string_view value_column_;
  std::vector<std::string> labels_;  // of the scans, [record], where no column has them
  std::map<std::string, int> index_of_scan_;
  std::vector<Scan> scans_;  // in the order of their first sample
};

void exclude(const ExcludedSample& excluded, std::string_view source,
             std::vector<Sample>& samples) {
  const auto index = static_cast<std::size_t>(excluded.sample);
  if (index >= samples.size()) {
    throw std::invalid_argument(
        fmt::format("{}: exclude_samples = {}: expected the number of a "
                    "sample, from 0 in the order of the file",
                    source, excluded.sample));
  }
  samples[index].weight = 0;
  samples[index].zero_weight_reason = excluded.reason;
}

}  // namespace

Reference parse_sample_csv(std::string_view text, std::string_view source,
                           std::span<const ExcludedSample> excluded) {
  const CsvTable table(text, source);
  expect_columns(table);
  Reference reference;
  reference.name = source;
  reference.quantity = value_column(table).quantity;
  SampleReader reader(table);
  for (const CsvRecord& record : table.records()) reference.samples.push_back(reader.read(record));
  for (const ExcludedSample& sample : excluded) exclude(sample, source, reference.samples);
  const auto used = std::count_if(reference.samples.begin(), reference.samples.end(),
                                  [](const Sample& sample) { return sample.weight > 0; });
  if (used == 0) {
    throw std::invalid_argument(
        fmt::format("{}: {} samples with a weight > 0, expected at least 1", source, used));
  }
  std::size_t readings = 0;
  for (const Sample& sample : reference.samples) readings += sample.polarisation.size();
  reference.description =
      fmt::format("{} samples of {}{} in {} scans from {}", reference.samples.size(),
                  quantity_name(reference.quantity),
                  readings > 0 ? fmt::format(" and {} readings of polarisation", readings) : "",
                  reader.scans().size(), source);
  reference.scans = reader.scans();
  return reference;
}

}  // namespace skyfit::refs
