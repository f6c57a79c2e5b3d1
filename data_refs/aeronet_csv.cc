// SPDX-License-Identifier: Apache-2.0
#include "data_refs/aeronet_csv.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "data_refs/aeronet_table.h"
#include "data_refs/csv.h"
#include "data_refs/photometer_scans.h"

namespace skyfit::refs {
namespace {

PhotometerLine read_line(const AeronetTable& table, const AeronetLine& line,
                         std::string_view source) {
  table.expect_fields(line, table.angles().back().column + 1);
  const std::string place = fmt::format("{}:{}", source, line.number);
  const std::string type = table.scan_type(line);
  const bool is_almucantar = type.starts_with("almucantar");
  if (!is_almucantar && !type.starts_with("principal plane")) {
    throw std::invalid_argument(
        fmt::format("{}: Sky_Scan_Type = \"{}\": expected Almucantar or Principal Plane, whose "
                    "directions are known",
                    place, type));
  }
  PhotometerLine read{place,
                      is_almucantar ? ScanPath::kAlmucantar : ScanPath::kPrincipalPlane,
                      table.site(line),
                      table.wavelength_nm(line),
                      table.facts(line),
                      {}};
  for (const AeronetAngle& angle : table.angles())
    read.readings.push_back(reading_along(read.path, angle.deg, table.number(line, angle.column)));
  return read;
}

}  // namespace

bool is_aeronet_csv(std::string_view text) { return AeronetTable::is_in(text); }

Reference parse_aeronet_csv(std::string_view text, std::string_view source,
                            const ImportOptions& options) {
  const AeronetTable table(text, source);
  if (table.angles().empty()) {
    fail_at(source, table.header_line(),
            "expected columns of radiances, named by their angle from the sun");
  }
  MeasuredSky sky = photometer_sky(source, options, table.unit().value_or(kAeronetUnit));
  PhotometerScans scans(options, sky);
  LeftOut left_out("line");
  for (const AeronetLine& line : table.lines())
    left_out.attempt([&] { scans.add(read_line(table, line, source)); });
  for (const std::string& note : left_out.notes()) sky.note(note);
  return sky.finish();
}

}  // namespace skyfit::refs
