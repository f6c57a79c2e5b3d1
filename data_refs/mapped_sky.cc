// SPDX-License-Identifier: Apache-2.0
#include "data_refs/mapped_sky.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "data_refs/column_mapping.h"
#include "data_refs/measured_sky.h"
#include "data_refs/sample_csv_columns.h"
#include "data_refs/sun_mends.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

using namespace sample_csv;

// Makes a CSV of samples, not a spectral scan.
bool makes_samples(const ColumnMapping& mapping) {
  return std::ranges::any_of(kValueColumns,
                             [&](const ValueColumn& column) { return mapping.has(column.name); });
}

// The columns that tell the time of each line; none without one.
std::vector<std::string_view> time_columns(const ColumnMapping& mapping, std::string_view source) {
  if (mapping.has(kMappedLocalDate) && !mapping.has(kMappedLocalTime))
    throw std::invalid_argument(fmt::format("{}: columns.{}: expected columns.{} beside it", source,
                                            kMappedLocalDate, kMappedLocalTime));
  if (mapping.has(kMappedLocalDate)) return {kMappedLocalDate, kMappedLocalTime};
  if (mapping.has(kMappedLocalTime)) return {kMappedLocalTime};
  if (mapping.has(kTime) && !mapping.has(kSunZenith)) return {kTime};
  return {};
}

ImportOptions facts_of_line(const ImportOptions& facts, bool is_utc, const std::string& time) {
  ImportOptions of_line = facts;
  of_line.local_time = time;
  if (is_utc) of_line.utc_offset_h = 0;
  return of_line;
}

// The columns of a sun, and a label of its scan.
class SunColumns {
 public:
  SunColumns(const ImportOptions& facts, std::string_view source)
      : facts_(facts), has_azimuths_(facts.columns->has(kViewAzimuth)) {
    scan_ = std::filesystem::path(source).filename().string();
  }

  std::vector<std::string> names(bool timed) const {
    std::vector<std::string> names = {std::string(kScan), std::string(kSunZenith)};
    if (has_azimuths_) names.emplace_back(kSunAzimuth);
    if (timed) names.insert(names.end(), {std::string(kTime), std::string(kDistance)});
    if (facts_.elevation_m) names.emplace_back(kElevation);
    return names;
  }

  std::vector<std::string> values(const ScanSun& sun) const {
    std::vector<std::string> values = {scan_, fmt::format("{}", sun.zenith * kDegreesPerRadian)};
    if (has_azimuths_)
      values.push_back(fmt::format("{}", sun.azimuth.value_or(0) * kDegreesPerRadian));
    if (sun.time) {
      values.push_back(iso_text(*sun.time));
      values.push_back(fmt::format("{}", sun.distance_au));
    }
    if (facts_.elevation_m) values.push_back(fmt::format("{}", *facts_.elevation_m));
    return values;
  }

  // Of the next line: its scan may be another one.
  std::vector<std::string> next(const ScanSun& sun) {
    constexpr double kJump = 1 * kRadiansPerDegree;
    const bool jumps =
        !last_ || angle_to_stated(last_->zenith, last_->azimuth)(
                      {.zenith = sun.zenith, .azimuth = sun.azimuth.value_or(0)}) >= kJump;
    if (jumps && sun.time) scan_ = iso_text(*sun.time);
    last_ = sun;
    return values(sun);
  }

 private:
  const ImportOptions& facts_;
  bool has_azimuths_;
  std::string scan_;
  std::optional<ScanSun> last_;
};

// Mapped columns take the place of those that would be added.
void leave_out_mapped(const ColumnMapping& mapping, AddedColumns& added) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < added.names.size(); ++i) {
    if (!mapping.has(added.names[i]) || added.is_time(added.names[i])) kept.push_back(i);
  }
  const auto chosen = [kept](const std::vector<std::string>& all) {
    std::vector<std::string> some;
    for (const std::size_t i : kept) some.push_back(all[i]);
    return some;
  };
  added.names = chosen(added.names);
  added.values = [chosen, all = std::move(added.values)](const std::string& time, int line) {
    auto values = all(time, line);
    if (values) *values = chosen(*values);
    return values;
  };
}

}  // namespace

MappedSky mapped_sky(std::string_view text, std::string_view source, const ImportOptions& facts) {
  const ColumnMapping& mapping = *facts.columns;
  const std::vector<std::string_view> times = time_columns(mapping, source);
  if (!makes_samples(mapping)) {
    if (!times.empty())
      throw std::invalid_argument(
          fmt::format("{}: columns.{}: expected local_time of the sidecar in its place; a spectral "
                      "scan has one",
                      source, times.back()));
    return {mapped_text(text, source, mapping, {})};
  }
  MappedSky result;
  AddedColumns added;
  SunColumns suns(facts, source);
  LeftOut left_out("line");
  const bool states_suns = mapping.has(kSunZenith), needs_azimuth = mapping.has(kViewAzimuth);
  if (states_suns && facts.sun_zenith_deg)
    throw std::invalid_argument(
        fmt::format("{}: sun_zenith_deg: expected none beside columns.sun_zenith_deg", source));
  if (!times.empty()) {
    added.time_columns = times;
    added.names = states_suns ? std::vector{std::string(kTime)} : suns.names(true);
    added.values = [&](const std::string& time,
                       int line) -> std::optional<std::vector<std::string>> {
      std::optional<std::vector<std::string>> values;
      const std::string place = fmt::format("{}:{}", source, line);
      const ImportOptions of_line = facts_of_line(facts, times.back() == kTime, time);
      left_out.attempt([&] {
        if (states_suns) {
          values = {iso_text(*stated_time(of_line, place))};
          return;
        }
        const ScanSun sun = sun_of_scan(of_line, place, needs_azimuth);
        result.site = sun.site;
        values = suns.next(sun);
      });
      return values;
    };
  } else if (!states_suns) {
    const ScanSun sun = sun_of_scan(facts, source, needs_azimuth);
    result.site = sun.site;
    added.names = suns.names(sun.time.has_value());
    added.values = [values = suns.values(sun)](const std::string&, int) {
      return std::optional(values);
    };
  }
  result.facts_are_used = !added.names.empty() || (facts.latitude_deg && facts.longitude_deg);
  if (added.values) leave_out_mapped(mapping, added);
  result.text = mapped_text(text, source, mapping, added);
  if (!times.empty()) result.notes = left_out.notes();
  return result;
}

std::vector<std::string> check_mapped_suns(const Reference& sky, std::string_view source,
                                           const ImportOptions& facts) {
  std::vector<std::string> notes;
  if (!facts.columns->has(kSunZenith) || !facts.latitude_deg || !facts.longitude_deg) return notes;
  for (std::size_t i = 0; i < sky.scans.size(); ++i) {
    const Scan& scan = sky.scans[i];
    ImportOptions stated = facts;
    if (!scan.time_utc.empty()) {
      stated.local_time = scan.time_utc;
      stated.utc_offset_h.reset();
    } else if (!facts.local_time || sky.scans.size() > 1) {
      continue;
    }
    const auto first = std::ranges::find(sky.samples, static_cast<int>(i), &Sample::scan);
    stated.sun_zenith_deg = first->sun_zenith * kDegreesPerRadian;
    stated.sun_azimuth_deg.reset();
    if (scan.sun_azimuth) stated.sun_azimuth_deg = *scan.sun_azimuth * kDegreesPerRadian;
    const ScanSun sun = sun_of_scan(stated, fmt::format("{}: {}", source, scan.name), false);
    if (!sun.remark.empty()) notes.push_back(scan.name + ": " + sun.remark);
  }
  return notes;
}

}  // namespace skyfit::refs
