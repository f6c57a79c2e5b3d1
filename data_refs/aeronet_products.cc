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
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr double kMissing = -999, kGreen = 550;     // nm
constexpr double kShortest = 400, kLongest = 1100;  // nm, of a power law

using Spectrum = std::map<double, double>;

struct Product {
  std::regex pattern;  // of a column, its first group the wavelength in nm
  Spectrum AerosolRecord::*values;
  double least, most;  // that can be; optical depths of clean air may come out below 0
};
const std::array<Product, 3>& products() {
  constexpr auto kAnyCase = std::regex::icase;
  static const std::array<Product, 3> table = {{
      {std::regex(R"(ao[dt]_(\d+)(?:nm)?|ao[dt]_?ext(?:inction-total)?\[?(\d+)(?:nm\]|-t))",
                  kAnyCase),
       &AerosolRecord::optical_depth, -0.1, 10},
      {std::regex(R"(single_scattering_albedo\[(\d+)nm\]|ssa(\d+)-t)", kAnyCase),
       &AerosolRecord::single_scattering_albedo, 0, 1},
      {std::regex(R"(asymmetry_factor-total\[(\d+)nm\]|asym(\d+)-t)", kAnyCase),
       &AerosolRecord::asymmetry, -1, 1},
  }};
  return table;
}

struct Column {
  std::size_t index;
  std::string name;
  double wavelength_nm;
  const Product& product;
};

struct Columns {
  std::size_t date = 0, time = 0;
  AeronetDate order = AeronetDate::kDayFirst;
  std::optional<std::size_t> latitude, longitude;
  std::vector<Column> values;
};

// Whether "Date(dd:mm:yyyy)" is a date.
bool is_named(const std::string& column, std::string_view name) {
  const std::size_t open = column.find('(');
  return open != column.npos && lower_case(trim(std::string_view(column).substr(0, open))) == name;
}

std::optional<Columns> columns_of(const std::vector<std::string>& names) {
  Columns columns;
  bool has_date = false, has_time = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    // The first of each: a file may go on with the date of its processing.
    if (!has_date && is_named(name, "date")) {
      columns.date = i;
      columns.order = aeronet_date(name);
      has_date = true;
    } else if (!has_time && is_named(name, "time")) {
      columns.time = i;
      has_time = true;
    } else if (!columns.latitude &&
               (is_named(name, "site_latitude") || is_named(name, "latitude"))) {
      columns.latitude = i;
    } else if (!columns.longitude &&
               (is_named(name, "site_longitude") || is_named(name, "longitude"))) {
      columns.longitude = i;
    }
    for (const Product& product : products()) {
      const auto match = whole_match(name, product.pattern);
      if (!match) continue;
      const auto digits = std::find_if(match->begin() + 1, match->end(),
                                       [](const std::csub_match& part) { return part.matched; });
      columns.values.push_back({i, name, std::stod(digits->str()), product});
    }
  }
  if (!has_date || !has_time) return {};
  return columns;
}

class RecordReader {
 public:
  RecordReader(const Columns& columns, const std::vector<std::string>& fields,
               const std::string& source, int line)
      : columns_(columns), fields_(fields), source_(source), line_(line) {}

  // `head` has the site where no column has.
  AerosolRecord record(const std::optional<Site>& head) const {
    const auto time = aeronet_instant(field(columns_.date), field(columns_.time), columns_.order);
    if (!time)
      fail_at(source_, line_,
              fmt::format("date and time \"{}\", \"{}\": expected {} and hh:mm:ss",
                          field(columns_.date), field(columns_.time),
                          aeronet_date_form(columns_.order)));
    AerosolRecord record{*time, {}, {}, {}};
    for (const Column& column : columns_.values) {
      const Product& product = column.product;
      if (const auto value = number(column.index, column.name, product.least, product.most))
        (record.*product.values)[column.wavelength_nm] = *value;
    }
    record.site = head;
    if (columns_.latitude && columns_.longitude) {
      const auto latitude = number(*columns_.latitude, "latitude", -90, 90),
                 longitude = number(*columns_.longitude, "longitude", -180, 360);
      if (latitude && longitude)
        record.site = {*latitude * kRadiansPerDegree, *longitude * kRadiansPerDegree};
    }
    return record;
  }

 private:
  const std::string& field(std::size_t i) const {
    if (i >= fields_.size())
      fail_at(source_, line_, fmt::format("expected at least {} fields", i + 1));
    return fields_[i];
  }

  // Nothing where it is missing.
  std::optional<double> number(std::size_t i, const std::string& name, double least,
                               double most) const {
    const std::string& text = field(i);
    if (text.empty() || text == "N/A") return {};
    const std::optional<double> value = csv_number(text);
    if (value == kMissing) return {};
    if (!value)
      fail_at(source_, line_,
              fmt::format("{} = {}: expected a number, -999 where there is none", name,
                          in_quotes(text)));
    if (!(*value >= least && *value <= most))
      fail_at(source_, line_,
              fmt::format("{} = {:.9g}: expected {:g} to {:g}", name, *value, least, most));
    return value;
  }

  const Columns& columns_;
  const std::vector<std::string>& fields_;
  const std::string& source_;
  int line_;
};

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
  constexpr double kSigma = 0.01;
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

// What one of the two does not have is the other's.
Spectrum between(const Spectrum& a, const Spectrum& b, double share) {
  Spectrum result = b;
  for (const auto& [nm, value] : a) {
    const auto other = b.find(nm);
    result[nm] = other != b.end() ? std::lerp(value, other->second, share) : value;
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

// On a sphere of the Earth's mean radius.
double distance_km(const Site& a, const Site& b) {
  constexpr double kEarth_km = 6371;
  const double north = std::sin(0.5 * (a.latitude - b.latitude)),
               east = std::sin(0.5 * (a.longitude - b.longitude));
  const double square = north * north + std::cos(a.latitude) * std::cos(b.latitude) * east * east;
  return 2 * kEarth_km * std::asin(std::min(1.0, std::sqrt(square)));
}

std::string text_of(const Site& site) {
  return fmt::format("latitude {:.6g}, longitude {:.6g} deg", site.latitude * kDegreesPerRadian,
                     site.longitude * kDegreesPerRadian);
}

bool holds_values(const AerosolRecord& record) {
  return !record.optical_depth.empty() || !record.single_scattering_albedo.empty() ||
         !record.asymmetry.empty();
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
  std::optional<Site> place;
  std::vector<AerosolRecord> records;
  int without_values = 0;
  std::string raw;
  for (int number = 1; std::getline(lines, raw); ++number) {
    const std::string content = without_tags(raw);
    if (content.find_first_not_of(" \t\r") == content.npos) continue;
    const std::vector<std::string> fields = csv_fields(content, source, number);
    if (!columns) {
      columns = columns_of(fields);
      const std::string head = lower_case(content);
      const auto latitude = head_number(head, "lat"), longitude = head_number(head, "long");
      if (latitude && longitude)
        place = {*latitude * kRadiansPerDegree, *longitude * kRadiansPerDegree};
    } else if (auto others = columns_of(fields)) {  // of another table below the first
      columns = std::move(others);
    } else {
      AerosolRecord record = RecordReader(*columns, fields, source, number).record(place);
      if (holds_values(record)) {
        records.push_back(std::move(record));
      } else {
        ++without_values;
      }
    }
  }
  if (!columns || columns->values.empty())
    throw std::invalid_argument(
        fmt::format("{}: expected a line of columns with date, time, and AOD_440nm, "
                    "Single_Scattering_Albedo[440nm] or the like, as AERONET gives them",
                    source));
  if (records.empty()) {
    throw std::invalid_argument(
        without_values == 0
            ? fmt::format("{}: expected records", source)
            : fmt::format("{}: every value of its {} record{} is missing: expected one that is not "
                          "-999",
                          source, without_values, without_values == 1 ? "" : "s"));
  }
  std::ranges::stable_sort(records, {}, &AerosolRecord::time);
  return records;
}

std::vector<AerosolRecord> records_near(const std::vector<AerosolRecord>& records, const Site& site,
                                        const std::string& source) {
  constexpr double kFar_km = 100;
  const auto distance = [&](const AerosolRecord& record) {
    return record.site ? distance_km(*record.site, site) : 0;
  };
  std::vector<AerosolRecord> near;
  std::ranges::copy_if(records, std::back_inserter(near),
                       [&](const AerosolRecord& record) { return distance(record) <= kFar_km; });
  if (!near.empty()) return near;
  const AerosolRecord& nearest = *std::ranges::min_element(records, {}, distance);
  throw std::invalid_argument(
      fmt::format("{}: is of {}, {:.0f} km from the scan's {}: expected within {:g} km", source,
                  text_of(*nearest.site), distance(nearest), text_of(site), kFar_km));
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
  if (depths.empty() && albedos.empty() && with_asymmetry == 0) {
    throw std::invalid_argument(
        fmt::format("{}: tells nothing at the time of the scans: expected optical depths > 0 of at "
                    "least two wavelengths from {:g} to {:g} nm, or an albedo",
                    source, kShortest, kLongest));
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
  if (depths.size() < times.size()) {
    knowledge.notes.push_back(fmt::format(
        "no optical depth by {} at {} of {} scans: a power law needs two wavelengths from {:g} to "
        "{:g} nm",
        source, times.size() - depths.size(), times.size(), kShortest, kLongest));
  }
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
