// SPDX-License-Identifier: Apache-2.0
#include "data_refs/civil_time.h"

#include <fmt/format.h>

#include <cmath>
#include <regex>

#include "model/base/pattern.h"

namespace skyfit::refs {
namespace chr = std::chrono;

namespace {

// After a clock time, so that the last part of a date is no offset.
const std::regex& offset_pattern() {
  static const std::regex pattern(R"(\s*(?:[Zz]|UTC|([+-])(\d{2}):?(\d{2})?)$)");
  return pattern;
}

// Of a match of the pattern; nothing where no clock is so far ahead of or behind UTC.
std::optional<double> offset_h(const std::cmatch& match) {
  if (!match[1].matched) return 0;
  const int minutes = match[3].matched ? std::stoi(match[3]) : 0;
  const double hours = std::stoi(match[2]) + minutes / 60.0;
  if (minutes > 59 || hours > kMostUtcOffset_h) return {};
  return match[1] == "-" ? -hours : hours;
}

}  // namespace

std::optional<double> stated_utc_offset_h(std::string_view date_and_clock) {
  if (date_and_clock.find(':') == date_and_clock.npos) return {};
  const auto match = first_match(date_and_clock, offset_pattern());
  return match ? offset_h(*match) : std::nullopt;
}

std::optional<Instant> instant(std::string_view date, std::string_view clock, double utc_offset_h) {
  static const std::regex kDate(R"((\d{4})[-/.](\d{1,2})[-/.](\d{1,2}))"),
      kClock(R"((\d{1,2})[:.](\d{2})(?:[:.](\d{2}(?:\.\d{1,9})?))?)");
  const auto date_parts = whole_match(date, kDate), clock_parts = whole_match(clock, kClock);
  if (!date_parts || !clock_parts) return {};
  const std::cmatch &d = *date_parts, &c = *clock_parts;
  const chr::year_month_day day{chr::year{std::stoi(d[1])},
                                chr::month{static_cast<unsigned>(std::stoi(d[2]))},
                                chr::day{static_cast<unsigned>(std::stoi(d[3]))}};
  const int hour = std::stoi(c[1]), minute = std::stoi(c[2]);
  const double second = c[3].matched ? std::stod(c[3]) : 0.0;
  if (!day.ok() || hour > 23 || minute > 59 || second >= 60) return {};
  const double since_midnight_s = hour * 3600.0 + minute * 60.0 + second - utc_offset_h * 3600.0;
  return chr::sys_days(day) + chr::milliseconds(std::llround(since_midnight_s * 1000));
}

std::optional<Instant> instant(std::string_view date_and_clock, double utc_offset_h) {
  if (date_and_clock.find(':') != date_and_clock.npos) {
    if (const auto match = first_match(date_and_clock, offset_pattern())) {
      if (!offset_h(*match)) return {};
      date_and_clock.remove_suffix(static_cast<std::size_t>(match->length()));
    }
  }
  const std::size_t gap = date_and_clock.find_first_of("T ");
  if (gap == std::string_view::npos) return {};
  return instant(date_and_clock.substr(0, gap), date_and_clock.substr(gap + 1), utc_offset_h);
}

std::string iso_text(Instant time) {
  const auto seconds = chr::floor<chr::seconds>(time);
  const auto midnight = chr::floor<chr::days>(seconds);
  const chr::year_month_day day(midnight);
  const chr::hh_mm_ss clock(seconds - midnight);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(day.year()),
                     static_cast<unsigned>(day.month()), static_cast<unsigned>(day.day()),
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count());
}

}  // namespace skyfit::refs
