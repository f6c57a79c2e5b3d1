// SPDX-License-Identifier: Apache-2.0
#include "data_refs/aeronet_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <sstream>

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
                           kElevation = "elevation", kRadiance = "radiance_for";

// "solarzenithangle" of "Solar_Zenith_Angle(Degrees)".
std::string plain_name(std::string_view column) {
  std::string name = lower_case(column.substr(0, column.find('(')));
  std::erase_if(name, [](char c) { return c == '_' || c == ' '; });
  return name;
}

bool holds_columns(std::string_view line) {
  const std::string text = lower_case(line);
  return text.find("date(") != text.npos && text.find("time(") != text.npos &&
         text.find("wavelength") != text.npos && text.find("wavelengths_of_aod") == text.npos &&
         (text.find("solar_zenith_angle") != text.npos || text.find(kSunZenith) != text.npos);
}

std::string_view after_last(std::string_view text, char separator) {
  return text.substr(text.rfind(separator) + 1);
}

std::optional<double> finite_number(std::string_view text) {
  const std::optional<double> number = csv_number(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

// Without what stands in parentheses, such as a unit.
std::string_view without_unit(std::string_view name) { return name.substr(0, name.find('(')); }

bool is_of_scattering(const std::string& column, const std::string& title) {
  return lower_case(title + column).find("scatter") != std::string::npos;
}

bool is_of_radiance(std::string_view title) {
  static const std::regex pattern(R"(\s*(sky[ _]?)?radiance.*)");
  return whole_match(lower_case(title), pattern).has_value();
}

// The angle that a column's name holds, if it is one of radiances. `titled`: titles speak of
// radiances; those of other blocks, as of the parts P1, P2 and P3 of polarised light, are none.
std::optional<double> angle_of(const std::string& column, const std::string& title, bool titled) {
  if (is_of_scattering(column, title)) return {};
  if (titled && !is_of_radiance(title)) return {};
  if (!lower_case(column).starts_with(kRadiance)) return finite_number(without_unit(column));
  return finite_number(without_unit(after_last(column, '_')));
}

// "uW/cm^2/sr/nm" of "Radiance_for_Azimuth_Angle_in_Degrees(uW/cm^2/sr/nm)"; empty where there is
// none.
std::string unit_in(std::string_view name) {
  const std::size_t open = name.find_first_of("([");
  if (open == name.npos || lower_case(name.substr(0, open)).find("radiance") == name.npos)
    return {};
  const std::size_t close = name.find_first_of(")]", open);
  return std::string(trim(name.substr(open + 1, close - open - 1)));
}

// The titles of groups of columns, each spread over its group; empty when it is no such line.
std::vector<std::string> group_titles(const std::vector<std::string>& fields) {
  constexpr std::size_t kFewestColumns = 6;
  if (fields.size() < kFewestColumns || !fields.front().empty()) return {};
  std::vector<std::string> titles;
  for (const std::string& field : fields)
    titles.push_back(field.empty() && !titles.empty() ? titles.back() : field);
  return titles;
}

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
    if (holds_columns(content)) return true;
    text.remove_prefix(std::min(text.size(), content.size() + 1));
  }
  return false;
}

AeronetTable::AeronetTable(std::string_view text, std::string_view source) : source_(source) {
  std::istringstream lines{std::string(text)};
  std::vector<std::string> titles;
  std::string raw;
  for (int number = 1; std::getline(lines, raw); ++number) {
    const std::string content = without_tags(raw);
    if (content.find_first_not_of(" \t\r") == content.npos) continue;
    std::vector<std::string> fields = csv_fields(content, source_, number);
    while (!fields.empty() && fields.back().empty()) fields.pop_back();
    if (fields.empty()) continue;
    if (holds_columns(content)) {
      if (const std::string_view other = other_delimiter(content); !other.empty())
        fail_at(source_, number, fmt::format("columns between {}: expected commas", other));
      if (!columns_.empty() && fields != columns_)
        fail_at(source_, number, "expected the columns once, or again the same");
      if (columns_.empty()) read_columns(std::move(fields), titles, number);
    } else if (columns_.empty()) {
      head_ += lower_case(content) + "\n";
      titles = group_titles(csv_fields(content, source_, number));
    } else {
      lines_.push_back({number, std::move(fields)});
    }
  }
}

void AeronetTable::read_columns(std::vector<std::string> columns,
                                const std::vector<std::string>& titles, int number) {
  columns_ = std::move(columns);
  header_line_ = number;
  const bool titled = std::ranges::any_of(titles, [](const std::string& title) {
    return lower_case(title).find("radiance") != title.npos;
  });
  for (const std::string& name : columns_) names_.push_back(plain_name(name));
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const std::string title = i < titles.size() ? titles[i] : "";
    titled_.push_back(lower_case(title.empty() ? columns_[i] : title + "_" + columns_[i]));
    if (const auto angle = angle_of(columns_[i], title, titled)) {
      expect_no_gap(i, titles);
      angles_.push_back({i, *angle});
    }
    read_unit(title, number - 1);
    read_unit(columns_[i], number);
  }
  drop_second_block(angles_);
  for (const std::string_view name : {kDate, kTime, kSunZenith}) {
    if (!column(name)) fail_at(source_, number, fmt::format("expected a column {}", name));
  }
  if (!column(kNominal) && !column(kExact) && !column(kWavelength))
    fail_at(source_, number, "expected a column Nominal_Wavelength or Wavelength");
  read_unit_of_head();
  date_ = aeronet_date(columns_[*column(kDate)]);
  place_.longitude_deg = head_number(head_, "long");
  place_.latitude_deg = head_number(head_, "lat");
  place_.elevation_m = head_number(head_, "elev");
}

// Whether the columns since the last angle are of another block.
void AeronetTable::expect_no_gap(std::size_t column, const std::vector<std::string>& titles) const {
  if (angles_.empty()) return;
  for (std::size_t i = angles_.back().column + 1; i < column; ++i) {
    if (is_of_scattering(columns_[i], i < titles.size() ? titles[i] : "")) continue;
    fail_at(source_, header_line_,
            fmt::format("column {} = {}: expected the angle of radiances from the sun, in degrees",
                        i + 1, in_quotes(columns_[i])));
  }
}

// A line of version 2, "Level 1.5 sky radiances, units uW/cm^2/sr/nm".
void AeronetTable::read_unit_of_head() {
  static const std::regex pattern(R"(radiance.*\bunits?\b[ :=(\[]*([^\s,;)\]]*/sr[^\s,;)\]]*))");
  for (const std::string_view line : split(head_, '\n')) {
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
  if (unit_.value_or(unit->name) != unit->name) {
    fail_at(source_, number,
            fmt::format("unit = {}: expected {} as before", in_quotes(text), *unit_));
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
    if (const auto angle = finite_number(after_last(titled_[i], '_'))) found.push_back({i, *angle});
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

std::string AeronetTable::scan_type(const AeronetLine& line) const {
  if (const auto type = column(kType)) return lower_case(line.fields[*type]);
  return head_.find("principal") == head_.npos ? "almucantar" : "principal plane";
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
