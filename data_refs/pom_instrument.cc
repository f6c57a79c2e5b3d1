// SPDX-License-Identifier: Apache-2.0
#include "data_refs/pom_instrument.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "data_refs/csv.h"
#include "model/base/input_file.h"
#include "model/base/text.h"

namespace skyfit::refs {
namespace {

constexpr double kNmPerCm = 1e7;

// Lists with commas between numbers, and D before an exponent.
std::string as_fortran_reads(std::string line) {
  std::ranges::replace(line, ',', ' ');
  const auto is_part = [&](std::size_t i, std::string_view of) {
    return i < line.size() && of.find(line[i]) != of.npos;
  };
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (is_part(i, "dD") && is_part(i - 1, "0123456789.") && is_part(i + 1, "+-0123456789"))
      line[i] = 'E';
  }
  return line;
}

class Reader {
 public:
  Reader(std::string_view text, std::string_view source)
      : lines_{std::string(text)}, source_(source) {}

  std::string line(std::string_view what) {
    std::string content;
    ++number_;
    if (!std::getline(lines_, content)) fail(what, "the file ends here");
    return content;
  }

  // That begin on the next line and may go on below it.
  std::vector<double> numbers(std::size_t count, std::string_view what) {
    std::vector<double> found;
    while (found.size() < count) {
      const std::size_t before = found.size();
      std::istringstream words(as_fortran_reads(line(what)));
      for (std::string word; found.size() < count && words >> word;) {
        const std::optional<double> number = csv_number(word);
        if (!number || !std::isfinite(*number)) break;
        found.push_back(*number);
      }
      if (found.size() == before)
        fail(what, fmt::format("{} of {} numbers were found", before, count));
    }
    return found;
  }

  std::size_t count(std::string_view what, double most) {
    const double value = numbers(1, what).front();
    if (!(value >= 1 && value <= most && value == std::floor(value)))
      fail(what, fmt::format("{:.9g} is not a whole number from 1 to {}", value, most));
    return static_cast<std::size_t>(value);
  }

  [[noreturn]] void fail(std::string_view expected, std::string_view but) const {
    fail_at(source_, number_, fmt::format("expected {}, but {}", expected, but));
  }

 private:
  std::istringstream lines_;
  std::string source_;
  int number_ = 0;
};

PomCalibration read_calibration(Reader& reader, std::size_t wavelengths) {
  constexpr std::size_t kTime = 4;
  const std::string_view what = "year, month, day, hour and the calibration constants in A";
  std::vector<double> values = reader.numbers(kTime + wavelengths, what);
  const double hour = values[3];
  const auto day = instant(
      fmt::format("{:04.0f}-{:02.0f}-{:02.0f}", values[0], values[1], values[2]), "00:00:00", 0);
  if (!day || !(hour >= 0 && hour <= 24))
    reader.fail(what, fmt::format("{:g} {:g} {:g} {:g} is no date and hour", values[0], values[1],
                                  values[2], hour));
  const auto since = std::chrono::milliseconds(std::llround(3.6e6 * hour));
  return {*day + since, {values.begin() + kTime, values.end()}};
}

}  // namespace

std::optional<double> PomInstrument::current_a(std::size_t wavelength, Instant time) const {
  const auto after = std::ranges::upper_bound(calibrations, time, {}, &PomCalibration::time);
  const PomCalibration& next = after == calibrations.end() ? calibrations.back() : *after;
  const PomCalibration& last = after == calibrations.begin() ? next : *(after - 1);
  const double from = last.current_a[wavelength], to = next.current_a[wavelength];
  if (!(from > 0 && to > 0)) return std::nullopt;
  if (next.time == last.time) return from;
  return std::lerp(from, to,
                   static_cast<double>((time - last.time).count()) /
                       static_cast<double>((next.time - last.time).count()));
}

PomInstrument parse_pom_instrument(std::string_view text, std::string_view source) {
  constexpr double kMostWavelengths = 20, kMostCalibrations = 1000;
  Reader reader(text, source);
  PomInstrument instrument;
  reader.line("a title");
  const std::string named = reader.line("the number of the instrument in double quotes");
  const std::size_t open = named.find('"'), close = named.find('"', open + 1);
  if (open == named.npos || close == named.npos)
    reader.fail("the number of the instrument in double quotes", "found " + in_quotes(named));
  instrument.number = trim(named.substr(open + 1, close - open - 1));
  reader.numbers(1, "the type of the instrument");
  const std::size_t count = reader.count("the number of wavelengths", kMostWavelengths);
  for (const double cm : reader.numbers(count, "wavelengths in cm")) {
    if (!(cm > 0)) reader.fail("wavelengths in cm > 0", fmt::format("found {:g}", cm));
    instrument.wavelength_nm.push_back(cm * kNmPerCm);
  }
  instrument.solid_angle_sr = reader.numbers(count, "solid angles of view in sr");
  for (const double angle : instrument.solid_angle_sr) {
    if (!(angle > 0))
      reader.fail("solid angles of view in sr > 0", fmt::format("found {:g}", angle));
  }
  const std::size_t calibrations = reader.count("the number of calibrations", kMostCalibrations);
  for (std::size_t i = 0; i < calibrations; ++i)
    instrument.calibrations.push_back(read_calibration(reader, count));
  std::ranges::sort(instrument.calibrations, {}, &PomCalibration::time);
  return instrument;
}

PomInstrument load_pom_instrument(const std::filesystem::path& file) {
  return parse_pom_instrument(read_text_file(file, "an ins.para of SKYRAD.pack"), file.string());
}

}  // namespace skyfit::refs
