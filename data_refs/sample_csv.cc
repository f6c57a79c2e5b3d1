// SPDX-License-Identifier: Apache-2.0
#include "data_refs/sample_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>

#include "data_refs/csv.h"

namespace skyfit::refs {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;

constexpr std::string_view kSunZenith = "sun_zenith_deg", kViewZenith = "view_zenith_deg",
                           kRelativeAzimuth = "relative_azimuth_deg",
                           kSunAzimuth = "sun_azimuth_deg", kViewAzimuth = "view_azimuth_deg",
                           kLuminance = "luminance_cd_m2", kRelative = "relative_luminance",
                           kSigma = "sigma", kWeight = "weight", kScan = "scan";
constexpr std::array kColumns = {kSunZenith,   kViewZenith, kRelativeAzimuth, kSunAzimuth,
                                 kViewAzimuth, kLuminance,  kRelative,        kSigma,
                                 kWeight,      kScan};

void expect_columns(const CsvTable& table) {
  for (const std::string& column : table.columns()) {
    if (std::find(kColumns.begin(), kColumns.end(), column) == kColumns.end()) {
      table.fail_header(
          fmt::format("{}: unknown column, expected one of {}", column, fmt::join(kColumns, ", ")));
    }
  }
  const auto expect = [&](bool holds, std::string_view what) {
    if (!holds)
      table.fail_header(
          fmt::format("expected {}, got the columns {}", what, fmt::join(table.columns(), ",")));
  };
  expect(table.has(kSunZenith), "a column sun_zenith_deg");
  expect(table.has(kViewZenith), "a column view_zenith_deg");
  const bool relative = table.has(kRelativeAzimuth), sun = table.has(kSunAzimuth),
             view = table.has(kViewAzimuth);
  expect(relative ? !sun && !view : sun && view,
         "either relative_azimuth_deg or both of sun_azimuth_deg and view_azimuth_deg");
  expect(table.has(kLuminance) != table.has(kRelative),
         "exactly one of luminance_cd_m2 and relative_luminance");
}

// One record of the table, column by column.
class SampleReader {
 public:
  explicit SampleReader(const CsvTable& table)
      : table_(table), value_column_(table.has(kLuminance) ? kLuminance : kRelative) {}

  Sample read(const CsvRecord& record) {
    Sample sample;
    sample.sun_zenith =
        kDegree * checked(record, kSunZenith, "0 <= sun_zenith_deg < 90, a sun above the horizon",
                          [](double deg) { return deg >= 0 && deg < 90; });
    sample.view_zenith = kDegree * checked(record, kViewZenith,
                                           "0 <= view_zenith_deg < 90, a view above the horizon",
                                           [](double deg) { return deg >= 0 && deg < 90; });
    sample.relative_azimuth = kDegree * relative_azimuth_deg(record);
    const auto positive = [](double x) { return x > 0; };
    sample.value = checked(record, value_column_, "a number > 0", positive);
    if (table_.has(kSigma)) sample.sigma = checked(record, kSigma, "a number > 0", positive);
    if (table_.has(kWeight)) {
      sample.weight = checked(record, kWeight, "a number >= 0", [](double x) { return x >= 0; });
      if (sample.weight == 0) sample.zero_weight_reason = "weight 0 in the file";
    }
    const auto next_scan = static_cast<int>(scans_.size());
    sample.scan = scans_.emplace(scan_label(record, sample), next_scan).first->second;
    return sample;
  }

  // That were met so far.
  std::size_t scans() const { return scans_.size(); }

 private:
  template <class Holds>
  double checked(const CsvRecord& record, std::string_view column, std::string_view expectation,
                 Holds holds) const {
    const double value = table_.number(record, column);
    if (!holds(value)) table_.fail_value(record, column, expectation);
    return value;
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

  std::string scan_label(const CsvRecord& record, const Sample& sample) const {
    if (table_.has(kScan)) {
      if (table_.text(record, kScan).empty()) table_.fail_value(record, kScan, "a label");
      return table_.text(record, kScan);
    }
    const double azimuth = table_.has(kSunAzimuth) ? table_.number(record, kSunAzimuth) : 0.0;
    return fmt::format("{} {}", sample.sun_zenith, azimuth);
  }

  const CsvTable& table_;
  std::string_view value_column_;
  std::map<std::string, int> scans_;  // in the order of their first sample
};

}  // namespace

Reference parse_sample_csv(std::string_view text, std::string_view source) {
  const CsvTable table(text, source);
  expect_columns(table);
  Reference reference;
  reference.name = source;
  reference.quantity = table.has(kLuminance) ? Quantity::kLuminance : Quantity::kRelativeLuminance;
  SampleReader reader(table);
  for (const CsvRecord& record : table.records()) reference.samples.push_back(reader.read(record));
  const auto used = std::count_if(reference.samples.begin(), reference.samples.end(),
                                  [](const Sample& sample) { return sample.weight > 0; });
  if (used == 0) {
    throw std::invalid_argument(
        fmt::format("{}: {} samples with a weight > 0, expected at least 1", source, used));
  }
  reference.description = fmt::format(
      "{} samples of {} in {} scans from {}", reference.samples.size(),
      table.has(kLuminance) ? "luminance" : "relative luminance", reader.scans(), source);
  return reference;
}

Reference load_sample_csv(const std::filesystem::path& file) {
  return parse_sample_csv(read_csv_file(file, "a CSV of samples"), file.string());
}

}  // namespace skyfit::refs
