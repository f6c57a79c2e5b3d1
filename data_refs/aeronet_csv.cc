// SPDX-License-Identifier: Apache-2.0
#include "data_refs/aeronet_csv.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "data_refs/aeronet_table.h"
#include "data_refs/csv.h"
#include "data_refs/photometer_scans.h"
#include "model/base/text.h"

namespace skyfit::refs {
namespace {

PhotometerLine read_line(const AeronetTable& table, const AeronetLine& line,
                         std::string_view source) {
  table.expect_fields(line, table.angles().back().column + 1);
  const std::string place = fmt::format("{}:{}", source, line.number);
  const std::optional<ScanPath> path = table.path(line);
  if (!path) {
    throw std::invalid_argument(
        fmt::format("{}: Sky_Scan_Type = {}: expected Almucantar or Principal Plane, whose "
                    "directions are known",
                    place, in_quotes(table.scan_type(line))));
  }
  if (*path == ScanPath::kAlmucantar && table.are_scattering_angles()) {
    throw std::invalid_argument(
        fmt::format("{}: Sky_Scan_Type = {}: expected Principal Plane under radiances that are "
                    "named by scattering angles",
                    place, in_quotes(table.scan_type(line))));
  }
  PhotometerLine read{place, *path, table.site(line), table.wavelength_nm(line), table.facts(line),
                      {}};
  for (const AeronetAngle& angle : table.angles())
    read.readings.push_back(reading_along(read.path, angle.deg, table.number(line, angle.column)));
  return read;
}

void expect_radiances(const AeronetTable& table, std::string_view source) {
  if (!table.angles().empty()) return;
  fail_at(source, table.header_line(),
          "expected columns of radiances, named by their angle from the sun");
}

}  // namespace

bool is_aeronet_csv(std::string_view text) { return AeronetTable::is_in(text); }

Reference parse_aeronet_csv(std::string_view text, std::string_view source,
                            const ImportOptions& options) {
  const std::vector<AeronetTable> tables = aeronet_tables(text, source);
  MeasuredSky sky = photometer_sky(source, options, tables.front().unit());
  PhotometerScans scans(options, sky);
  LeftOut tables_left_out("table"), lines_left_out("line");
  for (const AeronetTable& table : tables) {
    if (!tables_left_out.attempt([&] { expect_radiances(table, source); })) continue;
    for (const AeronetLine& line : table.lines())
      lines_left_out.attempt([&] { scans.add(read_line(table, line, source)); });
  }
  for (const LeftOut& left_out : {tables_left_out, lines_left_out}) {
    for (const std::string& note : left_out.notes()) sky.note(note);
  }
  return sky.finish();
}

}  // namespace skyfit::refs
