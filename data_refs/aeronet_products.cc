// SPDX-License-Identifier: Apache-2.0
#include "data_refs/aeronet_products.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "data_refs/aeronet_table.h"
#include "data_refs/csv.h"
#include "model/base/input_file.h"
#include "model/base/pattern.h"

namespace skyfit::refs {
namespace {

constexpr double kMissing = -999, kGreen = 550;  // nm

using Spectrum = std::map<double, double>;

struct Product {
  const char* pattern;  // of a column, its first group the wavelength in nm
  Spectrum AerosolRecord::*values;
};
const std::array<Product, 3> kProducts = {{
    {R"(ao[dt]_(\d+)(?:nm)?|ao[dt]_?ext(?:inction-total)?\[?(\d+)(?:nm\]|-t))",
     &AerosolRecord::optical_depth},
    {R"(single_scattering_albedo\[(\d+)nm\]|ssa(\d+)-t)", &AerosolRecord::single_scattering_albedo},
    {R"(asymmetry_factor-total\[(\d+)nm\]|asym(\d+)-t)", &AerosolRecord::asymmetry},
}};

struct Column {
  std::size_t index;
  double wavelength_nm;
  Spectrum AerosolRecord::*values;
};

struct Columns {
  std::size_t date = 0, time = 0;
  std::vector<Column> values;
};

std::optional<Columns> columns_of(const std::vector<std::string>& names) {
  Columns columns;
  bool has_date = false, has_time = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    // The first of each: a file may go on with the date of its processing.
    if (!has_date && whole_match(name, std::regex("date\\s*\\(.*", std::regex::icase))) {
      columns.date = i;
      has_date = true;
    } else if (!has_time && whole_match(name, std::regex("time\\s*\\(.*", std::regex::icase))) {
      columns.time = i;
      has_time = true;
    }
    for (const Product& product : kProducts) {
      const auto match = whole_match(name, std::regex(product.pattern, std::regex::icase));
      if (!match) continue;
      const auto digits = std::find_if(match->begin() + 1, match->end(),
                                       [](const std::csub_match& part) { return part.matched; });
      columns.values.push_back({i, std::stod(digits->str()), product.values});
    }
  }
  if (!has_date || !has_time) return {};
  return columns;
}

AerosolRecord record_of(const Columns& columns, const std::vector<std::string>& fields,
                        const std::string& source, int line) {
  const auto field = [&](std::size_t i) -> const std::string& {
    if (i >= fields.size())
      fail_at(source, line, fmt::format("expected at least {} fields", i + 1));
    return fields[i];
  };
  const auto time = aeronet_instant(field(columns.date), field(columns.time));
  if (!time)
    fail_at(source, line,
            fmt::format("date and time \"{}\", \"{}\": expected dd:mm:yyyy and hh:mm:ss",
                        field(columns.date), field(columns.time)));
  AerosolRecord record{*time, {}, {}, {}};
  for (const Column& column : columns.values) {
    const std::string& text = field(column.index);
    if (text.empty() || text == "N/A") continue;
    const std::optional<double> value = csv_number(text);
    if (!value || !std::isfinite(*value))
      fail_at(source, line,
              fmt::format("\"{}\": expected a number, -999 where there is none", text));
    if (*value != kMissing) (record.*column.values)[column.wavelength_nm] = *value;
  }
  return record;
}

// Linear between the two wavelengths around 550 nm, or the nearest one's.
double at_green(const Spectrum& values) {
  const auto above = values.lower_bound(kGreen);
  if (above == values.begin()) return above->second;
  const auto below = std::prev(above);
  if (above == values.end()) return below->second;
  const double share = (kGreen - below->first) / (above->first - below->first);
  return below->second + share * (above->second - below->second);
}

struct PowerLaw {
  double optical_depth, exponent, exponent_sigma;
};

std::optional<PowerLaw> power_law(const Spectrum& optical_depth) {
  constexpr double kShortest = 400, kLongest = 1100, kSigma = 0.01;
  double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0;
  int count = 0;
  for (const auto& [nm, tau] : optical_depth) {
    if (nm < kShortest || nm > kLongest || tau <= 0) continue;
    const double weight = tau * tau / (kSigma * kSigma);  // of ln tau
    const double x = std::log(nm / kGreen), y = std::log(tau);
    w += weight, wx += weight * x, wy += weight * y, wxx += weight * x * x, wxy += weight * x * y;
    ++count;
  }
  const double determinant = w * wxx - wx * wx;
  if (count < 2 || !(determinant > 0)) return {};
  const double slope = (w * wxy - wx * wy) / determinant;
  return PowerLaw{std::exp((wy - slope * wx) / w), -slope, std::sqrt(w / determinant)};
}

std::chrono::minutes reach_of(const AerosolRecord& record) {
  return record.single_scattering_albedo.empty() && record.asymmetry.empty()
             ? std::chrono::minutes(30)
             : std::chrono::minutes(120);
}

Spectrum between(const Spectrum& a, const Spectrum& b, double share) {
  Spectrum result;
  for (const auto& [nm, value] : a) {
    if (const auto other = b.find(nm); other != b.end())
      result[nm] = value + share * (other->second - value);
  }
  return result;
}

AerosolRecord record_at(const std::vector<AerosolRecord>& records, Instant time,
                        const std::string& source) {
  const auto after = std::ranges::lower_bound(records, time, {}, &AerosolRecord::time);
  const auto reaches = [&](const AerosolRecord& record) {
    return std::chrono::abs(record.time - time) <= reach_of(record);
  };
  const AerosolRecord* const next = after != records.end() ? &*after : nullptr;
  const AerosolRecord* const before = after != records.begin() ? &*std::prev(after) : nullptr;
  const bool has_next = next && reaches(*next), has_before = before && reaches(*before);
  if (has_next && has_before && next->time > before->time) {
    const double share = static_cast<double>((time - before->time).count()) /
                         static_cast<double>((next->time - before->time).count());
    return {time, between(before->optical_depth, next->optical_depth, share),
            between(before->single_scattering_albedo, next->single_scattering_albedo, share),
            between(before->asymmetry, next->asymmetry, share)};
  }
  if (has_next) return *next;
  if (has_before) return *before;
  const AerosolRecord& nearest =
      !before || (next && next->time - time < time - before->time) ? *next : *before;
  throw std::invalid_argument(
      fmt::format("{}: no record within {} minutes of the scan of {}: the nearest is of {}", source,
                  reach_of(nearest).count(), iso_text(time), iso_text(nearest.time)));
}

std::optional<Prior> mean_of(const std::vector<Prior>& priors) {
  if (priors.empty()) return {};
  Prior mean{0, 0};
  for (const Prior& prior : priors) {
    mean.mean += prior.mean / static_cast<double>(priors.size());
    mean.sigma += prior.sigma / static_cast<double>(priors.size());
  }
  return mean;
}

}  // namespace

std::vector<AerosolRecord> load_aerosol_records(const std::filesystem::path& file) {
  const std::string source = file.string();
  std::istringstream lines(read_file(file, "optical depths or an inversion of AERONET"));
  std::optional<Columns> columns;
  std::vector<AerosolRecord> records;
  std::string raw;
  for (int number = 1; std::getline(lines, raw); ++number) {
    const std::string content = without_tags(raw);
    if (content.find_first_not_of(" \t\r") == content.npos) continue;
    const std::vector<std::string> fields = csv_fields(content, source, number);
    if (!columns) {
      columns = columns_of(fields);
    } else if (!columns_of(fields)) {
      records.push_back(record_of(*columns, fields, source, number));
    }
  }
  if (!columns || columns->values.empty())
    throw std::invalid_argument(
        fmt::format("{}: expected a line of columns with date, time, and AOD_440nm, "
                    "Single_Scattering_Albedo[440nm] or the like, as AERONET gives them",
                    source));
  if (records.empty()) throw std::invalid_argument(fmt::format("{}: expected records", source));
  std::ranges::stable_sort(records, {}, &AerosolRecord::time);
  return records;
}

AerosolKnowledge aerosol_at(const std::vector<AerosolRecord>& records,
                            const std::vector<Instant>& times, const std::string& source) {
  constexpr double kSigmaOfDepth = 0.01;
  constexpr double kThick = 0.4, kSigmaThick = 0.03, kSigmaThin = 0.07;
  std::vector<Prior> depths, exponents, albedos;
  double asymmetry = 0;
  int with_asymmetry = 0;
  for (const Instant time : times) {
    const AerosolRecord record = record_at(records, time, source);
    if (const auto law = power_law(record.optical_depth)) {
      depths.push_back({law->optical_depth, kSigmaOfDepth});
      exponents.push_back({law->exponent, law->exponent_sigma});
    }
    if (!record.single_scattering_albedo.empty()) {
      const auto blue = record.optical_depth.lower_bound(430);  // AERONET's 440 nm is 439 to 443
      const bool thick = blue != record.optical_depth.end() && blue->second >= kThick;
      albedos.push_back(
          {at_green(record.single_scattering_albedo), thick ? kSigmaThick : kSigmaThin});
    }
    if (!record.asymmetry.empty()) {
      asymmetry += at_green(record.asymmetry);
      ++with_asymmetry;
    }
  }
  AerosolKnowledge knowledge{mean_of(depths), mean_of(exponents), mean_of(albedos), {}};
  const auto note = [&](const char* what, const std::optional<Prior>& prior) {
    if (prior)
      knowledge.notes.push_back(
          fmt::format("{} {:.4g} +- {:.2g} by {}", what, prior->mean, prior->sigma, source));
  };
  note("prior: aerosol optical depth at 550 nm", knowledge.optical_depth);
  note("prior: Angstrom exponent", knowledge.angstrom_exponent);
  note("prior: single scattering albedo at 550 nm", knowledge.single_scattering_albedo);
  if (with_asymmetry > 0)
    knowledge.notes.push_back(fmt::format("to compare: asymmetry factor at 550 nm {:.3g} by {}",
                                          asymmetry / with_asymmetry, source));
  return knowledge;
}

AerosolKnowledge joined(const AerosolKnowledge& first, const AerosolKnowledge& second) {
  AerosolKnowledge both = first;
  for (const auto member : {&AerosolKnowledge::optical_depth, &AerosolKnowledge::angstrom_exponent,
                            &AerosolKnowledge::single_scattering_albedo}) {
    if (!(both.*member)) both.*member = second.*member;
  }
  both.notes.insert(both.notes.end(), second.notes.begin(), second.notes.end());
  return both;
}

}  // namespace skyfit::refs
