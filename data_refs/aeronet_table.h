// SPDX-License-Identifier: Apache-2.0
// The lines of a file of AERONET's sky radiances, of version 2 or 3, as a download or the web
// service (with its HTML) gives them. Columns are known by their names, without unit, case and
// underscores:
//   version 3: Date, Time, Nominal_Wavelength, Exact_Wavelength, Solar_Zenith_Angle, Sky_Scan_Type,
//              AERONET_Site, Latitude, Longitude, Elevation
//   version 2: Date, Time, Wavelength, SolarZenithAngle; the site in a line `Location=..,long=..`
// A column of radiances is named by its angle, `-6.000000` or `Radiance_for_.._-6.000`. A line of
// group titles may stand above; titles, names or a line of the head, `.. radiances, units
// W/m^2/sr/um`, may state the unit, `Radiance_for_..(W/m^2/sr/um)`;
// columns of scattering angles, which follow in some files with the same names, are none of
// radiances, those under a title `Radiance_for_Scattering_Angle..` are.
// A file may hold several tables, such as one of almucantars and one of principal planes: each
// begins with its own columns, above which a head and titles of its own may stand.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data_refs/civil_time.h"
#include "data_refs/import_options.h"
#include "data_refs/photometer_scans.h"

namespace skyfit::refs {

// What the web service adds to a line is taken away.
std::string without_tags(const std::string& line);

// The order that a column's name states, Date(dd:mm:yyyy) or another; else the first.
enum class AeronetDate { kDayFirst, kMonthFirst, kYearFirst };
AeronetDate aeronet_date(std::string_view column);
std::string_view aeronet_date_form(AeronetDate order);  // "dd:mm:yyyy"

// Of "15:05:2024" and "06:30:00", UTC; nothing when they are no such instant.
std::optional<Instant> aeronet_instant(const std::string& date, const std::string& clock,
                                       AeronetDate order);

// 11 of "long=11.000" in the head of version 2, `line` in lower case.
std::optional<double> head_number(const std::string& line, const std::string& name);

struct AeronetLine {
  int number;  // 1 is the first of the file
  std::vector<std::string> fields;
};

struct AeronetAngle {
  std::size_t column;
  double deg;  // from the sun
};

class AeronetTable {
 public:
  // Whether a text holds such a table.
  static bool is_in(std::string_view text);

  const std::vector<AeronetLine>& lines() const { return lines_; }
  const std::vector<AeronetAngle>& angles() const { return angles_; }  // of radiances
  // Whether they are scattering angles, by which files name the radiances of principal planes.
  bool are_scattering_angles() const { return are_scattering_angles_; }
  int header_line() const { return header_line_; }  // that names the columns
  // Of the radiances, as titles, names or heads state it, else kAeronetUnit.
  std::string_view unit() const { return unit_.value_or(unit_above_.value_or(kAeronetUnit)); }
  // The columns whose names, or titles and names, are NAME_for_Azimuth_Angle.._-6.000, case aside.
  std::vector<AeronetAngle> columns_of(const std::string& name) const;

  // The rest throws std::invalid_argument `source:line: column = value: expected ...`.
  void expect_fields(const AeronetLine& line, std::size_t needed) const;
  // As its type says, else the head, else an almucantar; nothing where the type is another one.
  std::optional<ScanPath> path(const AeronetLine& line) const;
  std::string scan_type(const AeronetLine& line) const;  // as it is written
  std::string site(const AeronetLine& line) const;       // empty: not known
  double wavelength_nm(const AeronetLine& line) const;   // the exact one where there is one
  // Of a column or value that may be missing.
  std::optional<double> number(const AeronetLine& line, std::optional<std::size_t> column) const;
  // Time, place and the sun's zenith angle.
  ImportOptions facts(const AeronetLine& line) const;

 private:
  friend std::vector<AeronetTable> aeronet_tables(std::string_view text, std::string_view source);

  // The columns under a head; `above` is the table above it, if there is one.
  AeronetTable(std::string_view source, const std::vector<AeronetLine>& head, AeronetLine columns,
               const AeronetTable* above);
  std::vector<AeronetLine> take(std::vector<AeronetLine> lines);
  void read_columns(const std::vector<std::string>& titles);
  void read_head(const std::string& head);
  void expect_no_gap(std::size_t column, const std::vector<std::string>& titles) const;
  void read_unit(std::string_view name, int number);
  void read_unit_of_head(const std::string& head);
  void add_unit(const std::string& text, int number);
  std::optional<std::size_t> column(std::string_view name) const;
  double nanometres(const AeronetLine& line, std::optional<std::size_t> column) const;
  Instant time(const AeronetLine& line) const;
  [[noreturn]] void fail(const AeronetLine& line, std::size_t index,
                         std::string_view expectation) const;

  std::string source_;
  ImportOptions place_;
  ScanPath path_of_head_ = ScanPath::kAlmucantar;
  std::optional<std::string_view> unit_, unit_above_;  // of units(); of the table above
  int header_line_;
  bool are_scattering_angles_ = false;
  AeronetDate date_ = AeronetDate::kDayFirst;
  std::vector<std::string> columns_, names_;  // as in the file; without unit, case and underscores
  std::vector<std::string> titled_;           // lower case, after the title of their group
  std::vector<AeronetAngle> angles_;
  std::vector<AeronetLine> lines_;
};

// The tables of a text, at least one where AeronetTable::is_in() holds. Throws
// std::invalid_argument `source:line: ...` when columns are missing, one between those of radiances
// has no angle, or a unit is none of spectral radiance or another one than before.
std::vector<AeronetTable> aeronet_tables(std::string_view text, std::string_view source);

}  // namespace skyfit::refs
