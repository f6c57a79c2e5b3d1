// SPDX-License-Identifier: Apache-2.0
#include "render/plot/measured_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "data_refs/csv.h"

namespace skyfit::plot {
namespace {

struct Column {
  std::string_view name;
  double MeasuredSample::*member;
  std::string_view expected;
  bool (*accepts)(double);
};

constexpr std::string_view kScan = "scan";
bool zenith(double value) { return value >= 0 && value <= 180; }
bool any(double) { return true; }
bool not_negative(double value) { return value >= 0; }
// Of light that the sun sends; 0: a luminance.
bool wavelength(double value) { return value == 0 || (value >= 100 && value <= 10000); }
// Some turns.
bool azimuth(double value) { return value >= -3600 && value <= 3600; }

constexpr std::array<Column, 8> kColumns = {{
    {"sun_zenith_deg", &MeasuredSample::sun_zenith_deg, "0 to 180", zenith},
    {"view_zenith_deg", &MeasuredSample::view_zenith_deg, "0 to 180", zenith},
    {"relative_azimuth_deg", &MeasuredSample::relative_azimuth_deg, "-3600 to 3600", azimuth},
    {"wavelength_nm", &MeasuredSample::wavelength_nm, "0 or 100 to 10000", wavelength},
    {"measured", &MeasuredSample::measured, "a number", any},
    {"sigma", &MeasuredSample::sigma, "a number >= 0", not_negative},
    {"model", &MeasuredSample::model, "a number", any},
    {"weight", &MeasuredSample::weight, "a number >= 0", not_negative},
}};

}  // namespace

std::string measured_to_csv(std::span<const MeasuredSample> samples) {
  std::string text(kScan);
  for (const Column& column : kColumns) text += fmt::format(",{}", column.name);
  text += '\n';
  for (const MeasuredSample& sample : samples) {
    text += std::to_string(sample.scan);
    for (const Column& column : kColumns)
      fmt::format_to(std::back_inserter(text), ",{}", sample.*column.member);
    text += '\n';
  }
  return text;
}

std::vector<MeasuredSample> parse_measured_csv(std::string_view text, std::string_view source) {
  const refs::CsvTable table(text, source);
  const auto expect_column = [&](std::string_view name) {
    if (!table.has(name)) table.fail_header(fmt::format("expected a column {}", name));
  };
  expect_column(kScan);
  for (const Column& column : kColumns) expect_column(column.name);
  std::vector<MeasuredSample> samples;
  for (const refs::CsvRecord& record : table.records()) {
    MeasuredSample sample;
    const double scan = table.number(record, kScan);
    if (!(scan >= 1 && scan == std::floor(scan) && scan < 1e6))
      table.fail_value(record, kScan, "a whole number >= 1");
    sample.scan = static_cast<int>(scan);
    for (const Column& column : kColumns) {
      sample.*column.member = table.number(record, column.name);
      if (!column.accepts(sample.*column.member))
        table.fail_value(record, column.name, column.expected);
    }
    samples.push_back(sample);
  }
  if (samples.empty())
    throw std::invalid_argument(fmt::format("{}: expected at least one sample", source));
  return samples;
}

std::vector<MeasuredSample> read_measured_csv(const std::filesystem::path& file) {
  return parse_measured_csv(refs::read_csv_file(file, "the samples of a fit"), file.string());
}

}  // namespace skyfit::plot
