// SPDX-License-Identifier: Apache-2.0
#include "data_refs/eko_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "data_refs/csv.h"
#include "data_refs/patch_scan.h"
#include "data_refs/scan_header.h"
#include "data_refs/solar_position.h"
#include "data_refs/sun_mends.h"
#include "model/base/pattern.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr std::size_t kHeaderLines = 9;

struct EkoHeader {
  ScanHeader header;
  std::string date;
};

class EkoReader {
 public:
  EkoReader(std::string_view text, std::string_view source) : source_(source) {
    std::istringstream lines{std::string(text)};
    for (std::string content; std::getline(lines, content);) {
      if (content.ends_with('\r')) content.pop_back();
      lines_.push_back(content);
    }
  }

  EkoHeader header() const {
    EkoHeader result;
    result.date = matched(3, R"(Date\s*,\s*(\d{4}[/-]\d{1,2}[/-]\d{1,2}).*)", "Date,YYYY/MM/DD")[1];
    if (!instant(result.date, "00:00", 0)) fail_head(3, "Date,YYYY/MM/DD of a day that exists");
    ImportOptions& facts = result.header.facts;
    facts.longitude_deg = angle(5, R"(Lon(?:g(?:itude)?)?)", 360, "Lon140 d 8.0 m");
    facts.latitude_deg = angle(6, R"(Lat?(?:itude)?)", 90, "La36 d 3.0 m");
    const std::cmatch zone = matched(
        7, R"(Time\s?zone\s*,\s*UTC\s*([+-]?)(\d{1,2})(?::(\d{2}))?.*)", "Timezone,UTC +9:00");
    const double hours = std::stod(zone[2]) + (zone[3].matched ? std::stod(zone[3]) / 60 : 0.0);
    if (hours > kMostUtcOffset_h || (zone[3].matched && std::stoi(zone[3]) > 59))
      fail_head(7, "an offset of hours and minutes up to 14:00");
    facts.utc_offset_h = zone[1] == "-" ? -hours : hours;
    facts.unit = matched(8, R"(Unit\s*,\s*([^,]*[^,\s]).*)", "Unit,kcd/m^2")[1];
    result.header.line_of = {{"unit", 8}};
    expect_channels();
    return result;
  }

  std::vector<PatchScan> scans(const ImportOptions& facts, const std::string& date,
                               LeftOut& left_out) const {
    std::vector<PatchScan> scans;
    for (std::size_t i = kHeaderLines; i < lines_.size(); ++i) {
      const int line = static_cast<int>(i) + 1;
      if (lines_[i].find_first_not_of(" \t,") == std::string::npos) continue;
      std::string side(trim(std::string_view(lines_[i]).substr(0, lines_[i].find(','))));
      std::erase(side, '"');
      if (side == "R") continue;
      left_out.attempt([&] {
        const std::vector<std::string> fields = csv_fields(lines_[i], source_, line);
        if (fields[0] != "L")
          fail_at(source_, line, fmt::format("{}: expected a row L or R", in_quotes(fields[0])));
        scans.push_back(scan(fields, facts, date, line));
      });
    }
    return scans;
  }

 private:
  static constexpr std::size_t kStart = 1, kEnd = 2, kFirstPatch = 3,
                               kSunAzimuth = kFirstPatch + kPatches, kAltitude = kSunAzimuth + 1;

  const std::string& content(std::size_t line) const {
    if (line <= lines_.size()) return lines_[line - 1];
    throw std::invalid_argument(fmt::format("{}: {} lines: expected {} header lines", source_,
                                            lines_.size(), kHeaderLines));
  }

  std::cmatch matched(std::size_t line, const std::string& pattern,
                      std::string_view expectation) const {
    const auto match = whole_match(content(line), std::regex(pattern, std::regex::icase));
    if (!match) fail_head(line, expectation);
    return *match;
  }

  [[noreturn]] void fail_head(std::size_t line, std::string_view expectation) const {
    fail_at(source_, static_cast<int>(line),
            fmt::format("{}: expected {}", in_quotes(content(line)), expectation));
  }

  double angle(std::size_t line, const std::string& name, double most,
               std::string_view expectation) const {
    const std::cmatch match =
        matched(line,
                name + R"(\s*,?\s*([EWNS]?)\s*([+-]?)(\d{1,3})\s*d\s*,?\s*(\d+\.?\d*)\s*m)"
                       R"(\s*,?\s*([EWNS]?)\s*,*)",
                expectation);
    const double degrees = std::stod(match[3]) + std::stod(match[4]) / 60;
    const std::string side = match[1].length() > 0 ? match[1].str() : match[5].str();
    if (degrees > most || std::stod(match[4]) >= 60 || (!side.empty() && match[2].length() > 0)) {
      fail_head(line, fmt::format("{}, up to {:g} deg, minutes below 60, and a letter of the "
                                  "hemisphere or a sign, not both",
                                  expectation, most));
    }
    const bool is_west_or_south = side.find_first_of("WSws") != side.npos;
    return match[2] == "-" || is_west_or_south ? -degrees : degrees;
  }

  void expect_channels() const {
    const std::vector<std::string> fields = csv_fields(content(9), source_, 9);
    for (std::size_t channel = 1; channel <= kPatches; ++channel) {
      const std::size_t i = kFirstPatch + channel - 1;
      if (i < fields.size() && fields[i] == std::to_string(channel)) continue;
      fail_at(source_, 9,
              fmt::format("expected the channels 1 to {} from the fourth field on, "
                          "channel {} is not there",
                          kPatches, channel));
    }
  }

  double number(const std::vector<std::string>& fields, std::size_t i, std::string_view name,
                int line) const {
    if (const std::optional<double> value = csv_number(fields[i])) return *value;
    fail_at(source_, line, fmt::format("{} = \"{}\": expected a number", name, fields[i]));
  }

  Instant time(const std::string& date, const std::string& clock, double utc_offset_h,
               int line) const {
    if (const auto time = instant(date, clock, utc_offset_h)) return *time;
    fail_at(source_, line, fmt::format("time = \"{}\": expected HH:MM:SS", clock));
  }

  PatchScan scan(const std::vector<std::string>& fields, ImportOptions facts,
                 const std::string& date, int line) const {
    if (fields.size() <= kAltitude) {
      fail_at(source_, line,
              fmt::format("expected {} fields, got {}", kAltitude + 1, fields.size()));
    }
    const Instant start = time(date, fields[kStart], *facts.utc_offset_h, line);
    const Instant end = time(date, fields[kEnd], *facts.utc_offset_h, line);
    PatchScan scan;
    scan.name = date + " " + fields[kStart];
    std::ranges::replace(scan.name, '/', '-');  // no path of files
    const auto ahead = std::chrono::seconds(std::lround(3600 * *facts.utc_offset_h));
    facts.local_time = iso_text(start + (end - start) / 2 + ahead).substr(0, 19);
    scan.sun = sun_of_scan(facts, fmt::format("{}:{}", source_, line));
    expect_altitude(number(fields, kAltitude, "altitude of the sun", line), scan.sun, line);
    scan.stated_sun_azimuth =
        kRadiansPerDegree * number(fields, kSunAzimuth, "azimuth of the sun", line);
    for (std::size_t i = 0; i < kPatches; ++i)
      scan.values.push_back(
          number(fields, kFirstPatch + i, fmt::format("channel {}", i + 1), line));
    return scan;
  }

  void expect_altitude(double stated_deg, const ScanSun& sun, int line) const {
    constexpr double kMotion_deg = 1.5;  // of the sun in the 5 minutes of a scan, and rounding
    const double computed_deg = 90 - sun.zenith / kRadiansPerDegree;
    if (std::abs(stated_deg - computed_deg) <= kMotion_deg) return;
    fail_at(source_, line,
            fmt::format(
                "altitude of the sun = {:.9g}: expected {:.2f} within {} deg, that of {}; {}",
                stated_deg, computed_deg, kMotion_deg, iso_text(*sun.time),
                mended_by(mends_of_time_and_place(
                              *sun.time, *sun.site,
                              angle_to_stated((90 - stated_deg) * kRadiansPerDegree, std::nullopt)),
                          std::abs(stated_deg - computed_deg) * kRadiansPerDegree,
                          kMotion_deg * kRadiansPerDegree)));
  }

  std::string source_;
  std::vector<std::string> lines_;
};

}  // namespace

bool is_eko_csv(std::string_view first_line) {
  const auto has = [&](std::string_view word) { return first_line.find(word) != first_line.npos; };
  return has("MS-321LR") || (has("Sky Scanner") && !has("Krochmann"));
}

Reference parse_eko_csv(std::string_view text, std::string_view source,
                        const ImportOptions& options) {
  const EkoReader reader(text, source);
  const EkoHeader eko = reader.header();
  const ImportOptions facts = overlaid(options, eko.header.facts);
  LeftOut left_out("scan");
  const std::vector<PatchScan> scans = reader.scans(facts, eko.date, left_out);
  const std::vector<std::string> notes = left_out.notes();
  if (scans.empty())
    throw std::invalid_argument(fmt::format("{}: 0 rows L: expected at least 1", source));
  return patch_reference(std::string(source),
                         stated_unit(eko.header, options, source, {Quantity::kLuminance}), facts,
                         scans, notes);
}

}  // namespace skyfit::refs
