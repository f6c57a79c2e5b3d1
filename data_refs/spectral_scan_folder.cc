// SPDX-License-Identifier: Apache-2.0
#include "data_refs/spectral_scan_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "data_refs/csv.h"
#include "data_refs/measured_sky.h"
#include "model/base/input_file.h"
#include "model/base/text.h"
#include "model/photometry/photometry.h"

namespace skyfit::refs {
namespace {

namespace fs = std::filesystem;

constexpr double kFirst_nm = 360, kLast_nm = 830;  // the visible
constexpr double kDefaultBand_nm = 5;  // of the solar irradiance that the model is multiplied with
constexpr std::string_view kNameExpected =
    "DATE___HH.MM.SS_-_INDEX____AZIMUTH___ALTITUDE.asd.rad.txt";

struct DirectionFile {
  fs::path path;
  std::string local_time;  // YYYY-MM-DDTHH.MM.SS
  double azimuth_deg, altitude_deg;
};

// By number.
using DirectionFiles = std::map<int, DirectionFile>;

// `others`: files of spectra by their names, which do not tell direction and time.
DirectionFiles direction_files(const fs::path& folder, std::vector<std::string>& others) {
  static const std::regex pattern(
      R"((\d{4}-\d{2}-\d{2})_+(\d{2}\.\d{2}\.\d{2})_+-_+(\d{1,6})_+(-?\d+\.?\d*)_+(-?\d+\.?\d*)\.asd\.rad\.txt)");
  DirectionFiles files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    std::smatch match;
    if (!std::regex_match(name, match, pattern)) {
      if (lower_case(name).find(".rad") != name.npos) others.push_back(name);
      continue;
    }
    const int number = std::stoi(match[3]);
    DirectionFile file{entry.path(), match[1].str() + "T" + match[2].str(), std::stod(match[4]),
                       std::stod(match[5])};
    const auto fail = [&](std::string_view expectation) {
      throw std::invalid_argument(
          fmt::format("{}: expected {}", entry.path().string(), expectation));
    };
    if (std::abs(file.azimuth_deg) > 360) fail("an azimuth from -360 to 360 in the name");
    if (std::abs(file.altitude_deg) > 90) fail("an altitude from -90 to 90 in the name");
    if (!instant(file.local_time, 0)) fail("a date and time in the name");
    if (!files.emplace(number, std::move(file)).second)
      fail(fmt::format("one file with index {}", number));
  }
  if (files.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: no measured sky: expected files {}", folder.string(), kNameExpected));
  }
  return files;
}

// Of a file of one direction.
Spectrum read_spectrum(const fs::path& file) {
  const std::string source = file.string();
  std::istringstream lines(read_text_file(file, "the spectrum of a direction"));
  std::string content;
  std::getline(lines, content);  // names of the columns
  Spectrum spectrum;
  for (int line = 2; std::getline(lines, content); ++line) {
    std::istringstream words(content);
    std::string nm_text, value_text, rest;
    if (!(words >> nm_text)) continue;
    words >> value_text >> rest;
    const std::optional<double> nm = csv_number(nm_text), value = csv_number(value_text);
    if (!nm || !std::isfinite(*nm) || !value || !rest.empty())
      fail_at(source, line, in_quotes(content) + ": expected a wavelength in nm and a radiance");
    if (!spectrum.wavelength_nm.empty() && *nm <= spectrum.wavelength_nm.back())
      fail_at(source, line,
              fmt::format("wavelength = {}: expected ascending wavelengths", nm_text));
    spectrum.wavelength_nm.push_back(*nm);
    spectrum.value.push_back(*value);
  }
  if (spectrum.wavelength_nm.size() < 2) fail_at(source, 2, "expected at least 2 wavelengths");
  if (spectrum.wavelength_nm.back() < kFirst_nm || spectrum.wavelength_nm.front() > kLast_nm)
    fail_at(source, 2,
            fmt::format("wavelengths {:g} to {:g}: expected some of {:g} to {:g} nm",
                        spectrum.wavelength_nm.front(), spectrum.wavelength_nm.back(), kFirst_nm,
                        kLast_nm));
  return spectrum;
}

// The mean of the spectrum, linear between its points, over nm - band/2 .. nm + band/2, which lies
// within the spectrum.
double band_mean(const Spectrum& spectrum, double nm, double band_nm) {
  const double low = nm - band_nm / 2, high = nm + band_nm / 2;
  std::vector<double> at = {low};
  for (const double w : spectrum.wavelength_nm) {
    if (w > low && w < high) at.push_back(w);
  }
  at.push_back(high);
  double integral = 0;
  for (std::size_t i = 1; i < at.size(); ++i)
    integral += (spectrum.at(at[i - 1]) + spectrum.at(at[i])) / 2 * (at[i] - at[i - 1]);
  return integral / band_nm;
}

// The multiples of the band's width whose band lies within the spectrum and 360 to 830 nm, the
// visible.
std::vector<double> band_centres(const Spectrum& spectrum, double band_nm) {
  const double low = std::max(kFirst_nm, spectrum.wavelength_nm.front()) + band_nm / 2;
  const double high = std::min(kLast_nm, spectrum.wavelength_nm.back()) - band_nm / 2;
  std::vector<double> centres;
  for (double k = std::ceil(low / band_nm); k * band_nm <= high; ++k)
    centres.push_back(k * band_nm);
  return centres;
}

// Of each direction, with the name of its file.
using BandCounts = std::vector<std::pair<std::size_t, std::string>>;

// Empty where all have as many; a file that was cut short has fewer.
std::string note_of_shorter_spectra(const BandCounts& counts) {
  if (counts.empty()) return {};
  const std::size_t most = std::ranges::max_element(counts)->first;
  const auto is_shorter = [most](const auto& count) { return count.first < most; };
  const auto first = std::ranges::find_if(counts, is_shorter);
  if (first == counts.end()) return {};
  const auto number = std::ranges::count_if(counts, is_shorter);
  return fmt::format(
      "{} of {} spectra hold{} fewer wavelengths than the others, as {}: {} bands in the place of "
      "{}",
      number, counts.size(), number == 1 ? "s" : "", in_quotes(first->second), first->first, most);
}

// Of the files, ascending; a scan takes minutes. Throws when they are not those of one scan.
std::vector<std::string> times_of_scan(const DirectionFiles& files, const fs::path& folder) {
  constexpr std::chrono::minutes kLongest{30};
  std::vector<std::string> times;
  for (const auto& [number, file] : files) times.push_back(file.local_time);
  std::ranges::sort(times);
  if (*instant(times.back(), 0) - *instant(times.front(), 0) > kLongest) {
    throw std::invalid_argument(
        fmt::format("{}: files of {} and {}: expected those of one scan, within 30 minutes",
                    folder.string(), times.front(), times.back()));
  }
  return times;
}

}  // namespace

Reference load_spectral_scan_folder(const fs::path& folder, const ImportOptions& options) {
  std::vector<std::string> others;
  const DirectionFiles files = direction_files(folder, others);
  const std::vector<std::string> times = times_of_scan(files, folder);
  ImportOptions facts = options;
  if (!facts.local_time) facts.local_time = times[times.size() / 2];
  ScanHeader layout;
  layout.facts.unit = options.unit.value_or("W m-2 sr-1 nm-1");
  MeasuredSky sky(folder.string(),
                  stated_unit(layout, {}, folder.string(), {Quantity::kSpectralRadiance}), facts,
                  {.counter_clockwise = true});
  const fs::path name = folder.filename().empty() ? folder.parent_path() : folder;
  sky.begin_scan(name.filename().string(), sun_of_scan(facts, folder.string()));
  const double band_nm = options.band_nm.value_or(kDefaultBand_nm);
  LeftOut left_out("direction");
  BandCounts counts;
  for (const auto& [number, file] : files) {
    Spectrum spectrum;
    if (!left_out.attempt([&, &path = file.path] { spectrum = read_spectrum(path); })) continue;
    const std::vector<double> centres = band_centres(spectrum, band_nm);
    counts.emplace_back(centres.size(), file.path.filename().string());
    for (const double nm : centres) {
      Reading reading;
      reading.number = number;
      reading.view_azimuth_deg = file.azimuth_deg;
      reading.view_zenith_deg = 90 - file.altitude_deg;
      reading.wavelength_nm = nm;
      reading.value = band_mean(spectrum, nm, band_nm);
      sky.add(reading);
    }
  }
  for (const std::string& note : left_out.notes()) sky.note(note);
  if (const std::string note = note_of_shorter_spectra(counts); !note.empty()) sky.note(note);
  if (!others.empty())
    sky.note(fmt::format("{} of .rad left out, as {}: expected a name {}",
                         others.size() == 1 ? "a file" : fmt::format("{} files", others.size()),
                         in_quotes(*std::ranges::min_element(others)), kNameExpected));
  return sky.finish();
}

}  // namespace skyfit::refs
