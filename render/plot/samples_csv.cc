// SPDX-License-Identifier: Apache-2.0
#include "render/plot/samples_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "model/base/input_file.h"
#include "model/base/text.h"
#include "model/base/whole_file.h"

namespace skyfit::plot {
namespace {

constexpr std::string_view kHeader =
    "sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,reference,model,residual,weight";
constexpr std::string_view kStartColumn = ",start_model";

struct Column {
  std::string_view name;
  double ComparedSample::*member;
  std::string_view expected;
  bool (*accepts)(double);
};

bool any_finite(double value) { return std::isfinite(value); }
bool positive(double value) { return std::isfinite(value) && value > 0; }
bool not_negative(double value) { return std::isfinite(value) && value >= 0; }
bool zenith(double value) { return value >= 0 && value <= 180; }
bool signed_zenith(double value) { return value >= -180 && value <= 180; }

constexpr std::array<Column, 8> kColumns = {{
    {"sun_zenith_deg", &ComparedSample::sun_zenith_deg, "a number in 0..180", zenith},
    {"view_zenith_deg", &ComparedSample::view_zenith_deg, "a number in -180..180", signed_zenith},
    {"relative_azimuth_deg", &ComparedSample::relative_azimuth_deg, "a finite number", any_finite},
    {"reference", &ComparedSample::reference, "a number > 0", positive},
    {"model", &ComparedSample::model, "a number > 0", positive},
    {"residual", &ComparedSample::residual, "a finite number", any_finite},
    {"weight", &ComparedSample::weight, "a number >= 0", not_negative},
    {"start_model", &ComparedSample::start_model, "a number > 0", positive},
}};

// Lines without their end, be it \n or \r\n; the empty one after the last is dropped.
std::vector<std::string_view> lines_of(std::string_view text) {
  auto lines = split(text, '\n');
  if (lines.back().empty()) lines.pop_back();
  for (auto& line : lines)
    if (line.ends_with('\r')) line.remove_suffix(1);
  return lines;
}

double parse_field(const Column& column, std::string_view field, std::string_view source,
                   std::size_t line) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size() || !column.accepts(value))
    throw std::invalid_argument(fmt::format("{}:{}: {} = {}: expected {}", source, line,
                                            column.name, in_quotes(field), column.expected));
  return value;
}

ComparedSample parse_line(std::string_view text, std::size_t columns, std::string_view source,
                          std::size_t line) {
  const auto fields = split(text, ',');
  if (fields.size() != columns)
    throw std::invalid_argument(fmt::format("{}:{}: {} fields: expected {} as in the header",
                                            source, line, fields.size(), columns));
  ComparedSample sample;
  for (std::size_t i = 0; i < columns; ++i)
    sample.*kColumns[i].member = parse_field(kColumns[i], fields[i], source, line);
  return sample;
}

}  // namespace

double rms_log_percent(std::span<const ComparedSample> samples) {
  double sum = 0, weight = 0;
  for (const auto& sample : samples) {
    sum += sample.weight * sample.residual * sample.residual;
    weight += sample.weight;
  }
  return 100.0 * std::sqrt(sum / weight);
}

std::string samples_to_csv(std::span<const ComparedSample> samples) {
  const bool with_start =
      !samples.empty() && std::ranges::all_of(samples, [](const ComparedSample& sample) {
        return std::isfinite(sample.start_model);
      });
  std::string text = fmt::format("{}{}\n", kHeader, with_start ? kStartColumn : "");
  for (const auto& s : samples) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{}", s.sun_zenith_deg,
                   s.view_zenith_deg, s.relative_azimuth_deg, s.reference, s.model, s.residual,
                   s.weight);
    if (with_start) fmt::format_to(std::back_inserter(text), ",{}", s.start_model);
    text += '\n';
  }
  return text;
}

std::vector<ComparedSample> parse_samples_csv(std::string_view text, std::string_view source) {
  const auto lines = lines_of(text);
  const std::string_view header = lines.empty() ? std::string_view() : lines.front();
  const bool with_start =
      header.size() == kHeader.size() + kStartColumn.size() && header.ends_with(kStartColumn);
  if (!header.starts_with(kHeader) || (header.size() != kHeader.size() && !with_start))
    throw std::invalid_argument(fmt::format("{}:1: header = {}: expected \"{}[{}]\"", source,
                                            in_quotes(header), kHeader, kStartColumn));
  if (lines.size() < 2)
    throw std::invalid_argument(fmt::format("{}:2: expected at least one sample", source));
  std::vector<ComparedSample> samples;
  for (std::size_t i = 1; i < lines.size(); ++i)
    samples.push_back(parse_line(lines[i], with_start ? 8 : 7, source, i + 1));
  return samples;
}

void write_samples_csv(const std::filesystem::path& file, std::span<const ComparedSample> samples) {
  write_whole_file(file, samples_to_csv(samples));
}

std::vector<ComparedSample> read_samples_csv(const std::filesystem::path& file) {
  return parse_samples_csv(read_file(file, "the samples of a fit"), file.string());
}

}  // namespace skyfit::plot
