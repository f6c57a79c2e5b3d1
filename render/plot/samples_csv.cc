// SPDX-License-Identifier: Apache-2.0
#include "render/plot/samples_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>

#include "data_refs/csv.h"
#include "model/base/input_file.h"
#include "model/base/whole_file.h"
#include "model/irradiance.h"

namespace skyfit::plot {
namespace {

struct Column {
  std::string_view name;
  double Sample::*member;
  std::string_view expected;
  bool (*accepts)(double);
};

bool any(double) { return true; }
bool not_negative(double value) { return value >= 0; }
bool zenith(double value) { return value >= 0 && value <= 180; }
bool signed_zenith(double value) { return value >= -180 && value <= 180; }

constexpr std::string_view kScan = "scan", kResidual = "residual", kStart = "start_model",
                           kIrradiance = "irradiance";

constexpr std::array<Column, 7> kColumns = {{
    {"sun_zenith_deg", &Sample::sun_zenith_deg, "a number in 0..180", zenith},
    {"view_zenith_deg", &Sample::view_zenith_deg, "a number in -180..180", signed_zenith},
    {"relative_azimuth_deg", &Sample::relative_azimuth_deg, "a finite number", any},
    {"wavelength_nm", &Sample::wavelength_nm, "a number >= 0", not_negative},
    {"reference", &Sample::reference, "a finite number", any},
    {"sigma", &Sample::sigma, "a number >= 0", not_negative},
    {"model", &Sample::model, "a finite number", any},
}};
constexpr Column kWeight = {"weight", &Sample::weight, "a number >= 0", not_negative};
constexpr Column kStartModel = {kStart, &Sample::start_model, "a finite number", any};

void read_column(const refs::CsvTable& table, const refs::CsvRecord& record, const Column& column,
                 Sample& sample) {
  sample.*column.member = table.number(record, column.name);
  if (!column.accepts(sample.*column.member))
    table.fail_value(record, column.name, column.expected);
}

}  // namespace

std::vector<Sample> directions_only(std::span<const Sample> samples) {
  std::vector<Sample> chosen(samples.begin(), samples.end());
  std::erase_if(chosen, [](const Sample& sample) { return !sample.irradiance.empty(); });
  return chosen;
}

std::vector<Sample> irradiances_only(std::span<const Sample> samples) {
  std::vector<Sample> chosen(samples.begin(), samples.end());
  std::erase_if(chosen, [](const Sample& sample) { return sample.irradiance.empty(); });
  return chosen;
}

double rms_log_percent(std::span<const Sample> samples) {
  double sum = 0, weight = 0;
  for (const Sample& sample : samples) {
    if (sample.weight == 0) continue;
    sum += sample.weight * sample.residual() * sample.residual();
    weight += sample.weight;
  }
  return 100.0 * std::sqrt(sum / weight);
}

std::string samples_to_csv(std::span<const Sample> samples) {
  const bool with_start =
      !samples.empty() && std::ranges::all_of(samples, [](const Sample& sample) {
        return std::isfinite(sample.start_model);
      });
  const bool irradiances =
      std::ranges::any_of(samples, [](const Sample& sample) { return !sample.irradiance.empty(); });
  std::string text(kScan);
  for (const Column& column : kColumns) text += fmt::format(",{}", column.name);
  text += fmt::format(",{},{}", kResidual, kWeight.name);
  if (with_start) text += fmt::format(",{}", kStart);
  text += irradiances ? fmt::format(",{}\n", kIrradiance) : "\n";
  for (const Sample& sample : samples) {
    text += std::to_string(sample.scan);
    for (const Column& column : kColumns)
      fmt::format_to(std::back_inserter(text), ",{}", sample.*column.member);
    const bool positive = sample.model > 0 && sample.reference > 0;
    text += positive ? fmt::format(",{}", sample.residual()) : ",nan";
    text += fmt::format(",{}", sample.weight);
    if (with_start) text += fmt::format(",{}", sample.start_model);
    if (irradiances) text += "," + sample.irradiance;
    text += '\n';
  }
  return text;
}

std::vector<Sample> parse_samples_csv(std::string_view text, std::string_view source) {
  const refs::CsvTable table(text, source);
  const auto expect_column = [&](std::string_view name) {
    if (!table.has(name)) table.fail_header(fmt::format("expected a column {}", name));
  };
  expect_column(kScan);
  for (const Column& column : kColumns) expect_column(column.name);
  expect_column(kWeight.name);
  std::vector<Sample> samples;
  for (const refs::CsvRecord& record : table.records()) {
    Sample sample;
    const double scan = table.number(record, kScan);
    if (!(scan >= 1 && scan == std::floor(scan) && scan < 1e6))
      table.fail_value(record, kScan, "a whole number >= 1");
    sample.scan = static_cast<int>(scan);
    for (const Column& column : kColumns) read_column(table, record, column, sample);
    read_column(table, record, kWeight, sample);
    if (table.has(kStart)) read_column(table, record, kStartModel, sample);
    if (table.has(kIrradiance)) {
      sample.irradiance = table.text(record, kIrradiance);
      if (!sample.irradiance.empty() &&
          std::ranges::count(kIrradianceNames, sample.irradiance) == 0)
        table.fail_value(record, kIrradiance,
                         fmt::format("one of {}, or nothing", fmt::join(kIrradianceNames, ", ")));
    }
    samples.push_back(sample);
  }
  if (samples.empty())
    throw std::invalid_argument(fmt::format("{}: expected at least one sample", source));
  return samples;
}

void write_samples_csv(const std::filesystem::path& file, std::span<const Sample> samples) {
  write_whole_file(file, samples_to_csv(samples));
}

std::vector<Sample> read_samples_csv(const std::filesystem::path& file) {
  return parse_samples_csv(read_file(file, "the samples of a fit"), file.string());
}

}  // namespace skyfit::plot
