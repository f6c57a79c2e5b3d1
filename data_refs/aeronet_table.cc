// SPDX-License-Identifier: Apache-2.0
#include "data_refs/aeronet_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <regex>
#include <sstream>
#include <utility>

#include "data_refs/aeronet_columns.h"
#include "data_refs/csv.h"
#include "data_refs/units.h"
#include "model/base/pattern.h"
#include "model/base/text.h"

namespace skyfit::refs {
namespace {

constexpr double kMissing = -999;
constexpr std::string_view kDate = "date", kTime = "time", kNominal = "nominalwavelength",
                           kExact = "exactwavelength", kWavelength = "wavelength",
                           kSunZenith = "solarzenithangle", kType = "skyscantype",
                           kSite = "aeronetsite", kLatitude = "latitude", kLongitude = "longitude",
                           kElevation = "elevation";

// Scattering angles without a title repeat the names of the radiances.
void drop_second_block(std::vector<AeronetAngle>& angles) {
  const auto half = static_cast<std::ptrdiff_t>(angles.size() / 2);
  const auto same = [](const AeronetAngle& a, const AeronetAngle& b) { return a.deg == b.deg; };
  if (half > 1 && angles.size() % 2 == 0 &&
      std::equal(angles.begin(), angles.begin() + half, angles.begin() + half, same))
    angles.resize(static_cast<std::size_t>(half));
}

}  // namespace

std::optional<double> head_number(const std::string& line, const std::string& name) {
  for (std::size_t at = line.find(name); at != line.npos; at = line.find(name, at + 1)) {
    std::string_view value = trim(std::string_view(line).substr(at + name.size()));
    if (!value.starts_with('=')) continue;
    value = trim(value.substr(1));
    return finite_number(value.substr(0, value.find_first_not_of("-.0123456789")));
  }
  return {};
}

std::string without_tags(const std::string& line) {
  std::string result;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t open = line.find('<', at), close = line.find('>', open);
    if (close == line.npos) return result + line.substr(at);
    result += line.substr(at, open - at);
    at = close + 1;
  }
  return result;
}

AeronetDate aeronet_date(std::string_view column) {
  const std::string name = lower_case(column.substr(std::min(column.find('('), column.size())));
  if (name.starts_with("(mm")) return AeronetDate::kMonthFirst;
  return name.starts_with("(yyyy") ? AeronetDate::kYearFirst : AeronetDate::kDayFirst;
}

std::string_view aeronet_date_form(AeronetDate order) {
  switch (order) {
    case AeronetDate::kMonthFirst:
      return "mm:dd:yyyy";
    case AeronetDate::kYearFirst:
      return "yyyy:mm:dd";
    case AeronetDate::kDayFirst:
      break;
  }
  return "dd:mm:yyyy";
}

std::optional<Instant> aeronet_instant(const std::string& date, const std::string& clock,
                                       AeronetDate order) {
  static const std::regex year_last(R"((\d{1,2})[:/.-](\d{1,2})[:/.-](\d{4}))"),
      year_first(R"((\d{4})[:/.-](\d{1,2})[:/.-](\d{1,2}))");
  const auto match = whole_match(date, order == AeronetDate::kYearFirst ? year_first : year_last);
  if (!match) return {};
  std::array<std::string, 3> parts = {(*match)[1].str(), (*match)[2].str(), (*match)[3].str()};
  if (order == AeronetDate::kDayFirst) std::swap(parts[0], parts[2]);
  if (order == AeronetDate::kMonthFirst) std::ranges::rotate(parts, parts.begin() + 2);
  return instant(fmt::format("{}-{:0>2}-{:0>2}", parts[0], parts[1], parts[2]), clock, 0);
}

bool AeronetTable::is_in(std::string_view text) {
  for (int line = 0; line < 30 && !text.empty(); ++line) {  // of a head without end
    const std::string_view content = text.substr(0, text.find('\n'));
    if (names_columns(without_tags(std::string(content)))) return true;
    text.remove_prefix(std::min(text.size(), content.size() + 1));
  }
  return false;
}

std::vector<AeronetTable> aeronet_tables(std::string_view text, std::string_view source) {
  std::istringstream input{std::string(text)};
  std::vector<AeronetTable> tables;
  std::vector<AeronetLine> lines;  // since the last columns
  std::string raw;
  for (int number = 1; std::getline(input, raw); ++number) {
    const std::string content = without_tags(raw);
    if (content.find_first_not_of(" \t\r") == content.npos) continue;
    AeronetLine line{number, csv_fields(content, source, number)};
    while (!line.fields.empty() && line.fields.back().empty()) line.fields.pop_back();
    if (line.fields.empty()) continue;
    if (!names_columns(content)) {
      lines.push_back(std::move(line));
      continue;
    }
    if (const std::string_view other = other_delimiter(content); !other.empty())
      fail_at(source, number, fmt::format("columns between {}: expected commas", other));
    if (!tables.empty()) lines = tables.back().take(std::move(lines));
    const AeronetTable* const above = tables.empty() ? nullptr : &tables.back();
    tables.push_back(AeronetTable(source, lines, std::move(line), above));
    lines.clear();
  }
  if (!tables.empty()) tables.back().lines_ = std::move(lines);
  return tables;
}

AeronetTable::AeronetTable(std::string_view source, const std::vector<AeronetLine>& head,
                           AeronetLine columns, const AeronetTable* above)
    : source_(source), header_line_(columns.number), columns_(std::move(columns.fields)) {
  if (above != nullptr) {
    place_ = above->place_;
    unit_above_ = above->unit();
    path_of_head_ = above->path_of_head_;
  }
  std::string text;
  for (const AeronetLine& line : head)
    text += lower_case(fmt::format("{}\n", fmt::join(line.fields, ",")));
  read_columns(group_titles(head.empty() ? std::vector<std::string>{} : head.back().fields,
                            columns_.size()));
  read_head(text);
}

// Keeps the lines up to the last that holds a measurement; the rest is the head of what follows.
std::vector<AeronetLine> AeronetTable::take(std::vector<AeronetLine> lines) {
  const std::size_t date = *column(kDate);
  const auto is_measurement = [&](const AeronetLine& line) {
    const std::size_t fields = line.fields.size();
    return (fields > date && aeronet_instant(line.fields[date], "00:00:00", date_)) ||
           (!line.fields.front().empty() && !angles_.empty() && fields > angles_.back().column);
  };
  auto end = lines.end();
  while (end != lines.begin() && !is_measurement(*std::prev(end))) --end;
  std::vector<AeronetLine> rest(std::make_move_iterator(end), std::make_move_iterator(lines.end()));
  lines.erase(end, lines.end());
  lines_ = std::move(lines);
  return rest;
}

void AeronetTable::read_columns(const std::vector<std::string>& titles) {
  const bool titled = std::ranges::any_of(titles, [](const std::string& title) {
    return lower_case(title).find("radiance") != title.npos;
  });
  for (const std::string& name : columns_) names_.push_back(plain_name(name));
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::string& title = titles[i];
    titled_.push_back(lower_case(title.empty() ? columns_[i] : title + "_" + columns_[i]));
    if (const auto angle = angle_of(columns_[i], title, titled)) {
      expect_no_gap(i, titles);
      angles_.push_back({i, *angle});
      are_scattering_angles_ |= names_scattering(titled_.back());
    }
    read_unit(title, header_line_ - 1);
    read_unit(columns_[i], header_line_);
  }
  drop_second_block(angles_);
  for (const std::string_view name : {kDate, kTime, kSunZenith}) {
    if (!column(name)) fail_at(source_, header_line_, fmt::format("expected a column {}", name));
  }
  if (!column(kNominal) && !column(kExact) && !column(kWavelength))
    fail_at(source_, header_line_, "expected a column Nominal_Wavelength or Wavelength");
  date_ = aeronet_date(columns_[*column(kDate)]);
}

// What it does not say is as in the head above.
void AeronetTable::read_head(const std::string& head) {
  read_unit_of_head(head);
  ImportOptions place;
  place.longitude_deg = head_number(head, "long");
  place.latitude_deg = head_number(head, "lat");
  place.elevation_m = head_number(head, "elev");
  place_ = overlaid(place, place_);
  if (const auto path = path_in_head(head)) path_of_head_ = *path;
}

// Whether the columns since the last angle are of another block.
void AeronetTable::expect_no_gap(std::size_t column, const std::vector<std::string>& titles) const {
  if (angles_.empty()) return;
  for (std::size_t i = angles_.back().column + 1; i < column; ++i) {
    if (is_of_scattering(columns_[i], titles[i])) continue;
    fail_at(source_, header_line_,
            fmt::format("column {} = {}: expected the angle of radiances from the sun, in degrees",
                        i + 1, in_quotes(columns_[i])));
  }
}

// A line of version 2, "Level 1.5 sky radiances, units uW/cm^2/sr/nm".
void AeronetTable::read_unit_of_head(const std::string& head) {
  static const std::regex pattern(R"(radiance.*\bunits?\b[ :=(\[]*([^\s,;)\]]*/sr[^\s,;)\]]*))");
  for (const std::string_view line : split(head, '\n')) {
    const auto match = unit_ ? std::nullopt : first_match(line, pattern);
    if (!match) continue;
    std::string unit = (*match)[1].str();
    std::ranges::replace(unit, 'w', 'W');  // the head is in lower case
    add_unit(unit, header_line_);
  }
}

void AeronetTable::read_unit(std::string_view name, int number) {
  if (const std::string text = unit_in(name); !text.empty()) add_unit(text, number);
}

void AeronetTable::add_unit(const std::string& text, int number) {
  const std::optional<Unit> unit = find_unit(text);
  if (!unit || unit->quantity != Quantity::kSpectralRadiance) {
    fail_at(source_, number,
            fmt::format("unit = {}: expected one of {}", in_quotes(text),
                        unit_names({Quantity::kSpectralRadiance})));
  }
  const std::string_view before = unit_.value_or(unit_above_.value_or(unit->name));
  if (before != unit->name) {
    fail_at(source_, number,
            fmt::format("unit = {}: expected {} as before", in_quotes(text), before));
  }
  unit_ = unit->name;
}

std::optional<std::size_t> AeronetTable::column(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) return {};
  return static_cast<std::size_t>(found - names_.begin());
}

void AeronetTable::fail(const AeronetLine& line, std::size_t index,
                        std::string_view expectation) const {
  fail_at(
      source_, line.number,
      fmt::format("{} = \"{}\": expected {}", columns_[index], line.fields[index], expectation));
}

std::vector<AeronetAngle> AeronetTable::columns_of(const std::string& name) const {
  const std::string start = lower_case(name) + "_for_azimuth_angle";
  std::vector<AeronetAngle> found;
  for (std::size_t i = 0; i < titled_.size(); ++i) {
    if (!titled_[i].starts_with(start)) continue;
    if (const auto angle = number_at_end(titled_[i])) found.push_back({i, *angle});
  }
  return found;
}

void AeronetTable::expect_fields(const AeronetLine& line, std::size_t needed) const {
  if (line.fields.size() >= needed) return;
  fail_at(source_, line.number,
          fmt::format("expected {} fields, got {}", needed, line.fields.size()));
}

std::optional<double> AeronetTable::number(const AeronetLine& line,
                                           std::optional<std::size_t> column) const {
  if (!column || line.fields[*column].empty() || line.fields[*column] == "N/A") return {};
  const std::optional<double> value = csv_number(line.fields[*column]);
  if (!value) fail(line, *column, "a number, -999 where there is none");
  return *value == kMissing ? std::nullopt : value;
}

// Of a wavelength in nm or um; no sky is measured below 100 nm or beyond 10 um.
double AeronetTable::nanometres(const AeronetLine& line, std::optional<std::size_t> column) const {
  constexpr double kLongest_um = 10;
  const double value = number(line, column).value_or(0);
  return value > 0 && value < kLongest_um ? 1000 * value : value;
}

double AeronetTable::wavelength_nm(const AeronetLine& line) const {
  std::optional<std::size_t> last;
  for (const std::string_view name : {kExact, kNominal, kWavelength}) {
    const double nm = nanometres(line, column(name));
    if (nm > 0) return nm;
    if (column(name)) last = column(name);
  }
  fail(line, *last, "a wavelength");
}

std::optional<ScanPath> AeronetTable::path(const AeronetLine& line) const {
  const auto type = column(kType);
  return type ? path_named(line.fields[*type]) : path_of_head_;
}

std::string AeronetTable::scan_type(const AeronetLine& line) const {
  if (const auto type = column(kType)) return line.fields[*type];
  return std::string(path_name(path_of_head_));
}

std::string AeronetTable::site(const AeronetLine& line) const {
  const auto site = column(kSite);
  return site ? line.fields[*site] : "";
}

Instant AeronetTable::time(const AeronetLine& line) const {
  const std::size_t clock = *column(kTime), date = *column(kDate);
  const auto time = aeronet_instant(line.fields[date], line.fields[clock], date_);
  if (!aeronet_instant(line.fields[date], "00:00:00", date_))
    fail(line, date, aeronet_date_form(date_));
  if (!time) fail(line, clock, "hh:mm:ss of a day that exists");
  return *time;
}

ImportOptions AeronetTable::facts(const AeronetLine& line) const {
  ImportOptions facts;
  facts.local_time = iso_text(time(line)).substr(0, 19);
  facts.utc_offset_h = 0;
  facts.latitude_deg = number(line, column(kLatitude));
  facts.longitude_deg = number(line, column(kLongitude));
  facts.elevation_m = number(line, column(kElevation));
  facts.sun_zenith_deg = number(line, column(kSunZenith));
  facts = overlaid(facts, place_);
  for (const ImportOptionRow& row : import_option_table()) {
    if (row.number == nullptr || !row.is_set(facts) || row.accepts_number(*(facts.*row.number)))
      continue;
    fail_at(
        source_, line.number,
        fmt::format("{} = {:.9g}: expected {}", row.name, *(facts.*row.number), row.expectation));
  }
  return facts;
}

}  // namespace skyfit::refs
