// SPDX-License-Identifier: Apache-2.0
#include "data_refs/spectral_scan_csv.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data_refs/csv.h"
#include "data_refs/measured_sky.h"
#include "data_refs/scan_header.h"
#include "model/base/pattern.h"
#include "model/base/text.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kSample = "sample", kViewAzimuth = "view_azimuth_deg",
                           kViewZenith = "view_zenith_deg", kRadiance = "radiance_",
                           kLuminance = "luminance_cd_m2";

struct Band {
  std::string column;
  double wavelength_nm;
};

std::vector<Band> bands(const CsvTable& table) {
  std::vector<Band> result;
  for (const std::string& column : table.columns()) {
    if (!column.starts_with(kRadiance)) continue;
    const auto nm = csv_number(std::string_view(column).substr(kRadiance.size()));
    if (!nm || !(*nm > 0) || !std::isfinite(*nm))
      table.fail_header(column + ": expected radiance_ and a wavelength in nm");
    result.push_back({column, *nm});
  }
  return result;
}

// `radiance_<nm> in UNIT`, up to a semicolon or the end of the comment.
void read_unit(ScanHeader& header) {
  static const std::regex pattern(R"(radiance_<nm> in ([^;]*[^;\s]))");
  for (const CommentLine& comment : header.comments) {
    const auto match = first_match(comment.text, pattern);
    if (!match) continue;
    header.facts.unit = (*match)[1];
    header.line_of["unit"] = comment.line;
  }
}

class ScanReader {
 public:
  ScanReader(const CsvTable& table, MeasuredSky& sky)
      : table_(table), bands_(bands(table)), sky_(sky) {}

  void read(const CsvRecord& record) {
    Reading reading;
    reading.number = number_of(record);
    reading.view_azimuth_deg = within(record, kViewAzimuth, -360, 360, "-360 to 360");
    reading.view_zenith_deg = within(record, kViewZenith, 0, 180, "0 to 180");
    for (const Band& band : bands_) {
      reading.wavelength_nm = band.wavelength_nm;
      reading.value = table_.any_number(record, band.column);
      sky_.add(reading);
    }
  }

 private:
  int number_of(const CsvRecord& record) {
    const double number = table_.number(record, kSample);
    if (number != std::floor(number) || number < 0 || number > 1e6)
      table_.fail_value(record, kSample, "a whole number >= 0");
    if (!numbers_.insert(number).second) table_.fail_value(record, kSample, "every number once");
    return static_cast<int>(number);
  }

  double within(const CsvRecord& record, std::string_view column, double lower, double upper,
                std::string_view expectation) const {
    const double value = table_.number(record, column);
    if (value < lower || value > upper) table_.fail_value(record, column, expectation);
    return value;
  }

  const CsvTable& table_;
  std::vector<Band> bands_;
  MeasuredSky& sky_;
  std::set<double> numbers_;
};

}  // namespace

bool is_spectral_scan(std::string_view columns) {
  const auto is_radiance = [](std::string_view column) {
    column = trim(column);
    return column.size() > kRadiance.size() && column.starts_with(kRadiance) &&
           column[kRadiance.size()] >= '0' && column[kRadiance.size()] <= '9';
  };
  return columns.find(kViewAzimuth) != columns.npos &&
         std::ranges::any_of(split(columns, ','), is_radiance);
}

Reference parse_spectral_scan(std::string_view text, std::string_view source,
                              const ImportOptions& options) {
  const CsvTable table(text, source);
  for (const std::string_view column : {kSample, kViewAzimuth, kViewZenith}) {
    if (!table.has(column)) table.fail_header("expected a column " + std::string(column));
  }
  for (const std::string& column : table.columns()) {
    if (!column.starts_with(kRadiance) && column != kSample && column != kViewAzimuth &&
        column != kViewZenith && column != kLuminance)
      table.fail_header(in_quotes(column) +
                        ": unknown column, expected one of sample, view_azimuth_deg, "
                        "view_zenith_deg, luminance_cd_m2 and radiance_ with a wavelength in nm");
  }
  ScanHeader header = scan_header(text, source);
  read_unit(header);
  const Unit unit = stated_unit(header, options, source, {Quantity::kSpectralRadiance});
  const ImportOptions facts = overlaid(options, header.facts);
  MeasuredSky sky{std::string(source), unit, facts};
  sky.begin_scan(std::filesystem::path(source).filename().string(),
                 sun_of_scan(facts, header.place(source, "sun_zenith_deg")));
  ScanReader reader(table, sky);
  for (const CsvRecord& record : table.records()) reader.read(record);
  if (table.has(kLuminance))
    sky.note(std::string(kLuminance) + " is not used: a luminance is that of the radiances");
  return sky.finish();
}

}  // namespace skyfit::refs
