// SPDX-License-Identifier: Apache-2.0
#include "data_refs/aeronet_polarised.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "data_refs/aeronet_table.h"
#include "data_refs/csv.h"
#include "data_refs/photometer_scans.h"
#include "model/base/text.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kDegree = "Degree_of_Polarization";
constexpr std::array<std::string_view, 3> kRadiances = {"P1_Radiance", "P2_Radiance",
                                                        "P3_Radiance"};
constexpr double kAgreement = 0.05;  // of imperfect polarisers, not of percent or other columns

// The columns of one direction.
struct Direction {
  double deg;  // azimuth from the sun
  std::size_t degree;
  std::array<std::size_t, 3> radiance;

  std::size_t last() const { return std::max(degree, std::ranges::max(radiance)); }
};

std::vector<Direction> directions_of(const AeronetTable& table, std::string_view source) {
  std::vector<Direction> directions;
  for (const AeronetAngle& angle : table.columns_of(std::string(kDegree)))
    directions.push_back({angle.deg, angle.column, {}});
  if (directions.empty()) {
    fail_at(source, table.header_line(),
            fmt::format("expected columns {}_for_Azimuth_Angle.., those of a polarised almucantar; "
                        "other polarised scans are not read",
                        kDegree));
  }
  for (std::size_t p = 0; p < kRadiances.size(); ++p) {
    const std::vector<AeronetAngle> columns = table.columns_of(std::string(kRadiances[p]));
    for (Direction& direction : directions) {
      const auto found = std::ranges::find(columns, direction.deg, &AeronetAngle::deg);
      if (found == columns.end()) {
        fail_at(source, table.header_line(),
                fmt::format("expected a column {}_for_Azimuth_Angle.._{:g}, as {} has",
                            kRadiances[p], direction.deg, kDegree));
      }
      direction.radiance[p] = found->column;
    }
  }
  return directions;
}

// Of three radiances, through polarisers 60 deg apart.
double degree_of(const std::array<double, 3>& p) {
  const double differences = p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - p[0] * p[1] - p[1] * p[2] -
                             p[2] * p[0];  // >= 0, but for rounding
  return 2 * std::sqrt(std::max(0.0, differences)) / (p[0] + p[1] + p[2]);
}

PhotometerReading reading_of(const AeronetTable& table, const AeronetLine& line,
                             const Direction& direction, double degree_unit) {
  std::array<double, 3> p{};
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::optional<double> radiance = table.number(line, direction.radiance[i]);
    if (!radiance) return reading_along(ScanPath::kAlmucantar, direction.deg, std::nullopt);
    p[i] = *radiance;
  }
  PhotometerReading reading =
      reading_along(ScanPath::kAlmucantar, direction.deg, (p[0] + p[1] + p[2]) / 3);
  const std::optional<double> stated = table.number(line, direction.degree);
  if (!stated) return reading;
  const double degree = *stated * degree_unit;
  if (!(degree >= 0 && degree <= 1 && std::abs(degree - degree_of(p)) <= kAgreement)) {
    reading.flaw = "degree of polarisation is not that of P1, P2 and P3";
    return reading;
  }
  reading.polarisation = {{Polarisation::kDegree, degree, std::nullopt}};
  return reading;
}

PhotometerLine read_line(const AeronetTable& table, const AeronetLine& line,
                         const std::vector<Direction>& directions, std::string_view source) {
  table.expect_fields(line, std::ranges::max(directions, {}, &Direction::last).last() + 1);
  const std::string place = fmt::format("{}:{}", source, line.number);
  if (table.path(line) != ScanPath::kAlmucantar) {
    throw std::invalid_argument(fmt::format("{}: Sky_Scan_Type = {}: expected an almucantar", place,
                                            in_quotes(table.scan_type(line))));
  }
  PhotometerLine read{
      place, ScanPath::kAlmucantar, table.site(line), table.wavelength_nm(line), table.facts(line),
      {}};
  // Somewhere along an almucantar the light of a sky is polarised by more than 1 %.
  const bool in_percent = std::ranges::any_of(directions, [&](const Direction& direction) {
    return table.number(line, direction.degree).value_or(0) > 1;
  });
  for (const Direction& direction : directions)
    read.readings.push_back(reading_of(table, line, direction, in_percent ? 0.01 : 1));
  return read;
}

}  // namespace

bool is_aeronet_polarised(std::string_view text) {
  constexpr std::size_t kHead = 20'000;  // the titles and names of some 200 columns
  const std::string head = lower_case(text.substr(0, kHead));
  return AeronetTable::is_in(text) && head.find("degree_of_polarization_for") != head.npos;
}

Reference parse_aeronet_polarised(std::string_view text, std::string_view source,
                                  const ImportOptions& options) {
  const std::vector<AeronetTable> tables = aeronet_tables(text, source);
  MeasuredSky sky = photometer_sky(source, options, tables.front().unit());
  sky.note(
      "radiances are the means of P1, P2 and P3, which were calibrated with unpolarised light as "
      "far as is known; --scale profiled leaves their factor open");
  PhotometerScans scans(options, sky);
  LeftOut tables_left_out("table"), lines_left_out("line");
  for (const AeronetTable& table : tables) {
    std::vector<Direction> directions;
    if (!tables_left_out.attempt([&] { directions = directions_of(table, source); })) continue;
    for (const AeronetLine& line : table.lines())
      lines_left_out.attempt([&] { scans.add(read_line(table, line, directions, source)); });
  }
  for (const LeftOut& left_out : {tables_left_out, lines_left_out}) {
    for (const std::string& note : left_out.notes()) sky.note(note);
  }
  return sky.finish();
}

}  // namespace skyfit::refs
