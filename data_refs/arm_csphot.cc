// SPDX-License-Identifier: Apache-2.0
#include "data_refs/arm_csphot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "data_refs/netcdf_header.h"
#include "data_refs/photometer_scans.h"
#include "fit/exchange/netcdf/netcdf_module.h"
#include "model/base/module_file.h"
#include "model/base/text.h"

namespace skyfit::refs {
namespace {

using fit::NetcdfFile;
using fit::NetcdfVariable;

// The variables of one file.
class Datastream {
 public:
  Datastream(const NetcdfFile& content, std::string_view source)
      : content_(content), source_(source) {}

  // Of the dimensions, in the unit (any, where it is empty).
  std::vector<double> numbers(std::string_view name, const std::vector<std::string>& dimensions,
                              std::string_view unit) const {
    const auto found = std::ranges::find(content_.variables, name, &NetcdfVariable::name);
    if (found == content_.variables.end()) {
      throw std::invalid_argument(fmt::format(
          "{}: no variable {}: expected almucantars of ARM (csphotalm)", source_, name));
    }
    if (found->dimensions != dimensions) {
      throw std::invalid_argument(fmt::format("{}: {}({}): expected {}({})", source_, name,
                                              fmt::join(found->dimensions, ", "), name,
                                              fmt::join(dimensions, ", ")));
    }
    if (!unit.empty() && found->units != unit) {
      throw std::invalid_argument(
          fmt::format("{}: {} in {}: expected {}", source_, name, in_quotes(found->units), unit));
    }
    if (const auto* doubles = std::get_if<std::vector<double>>(&found->values)) return *doubles;
    if (const auto* integers = std::get_if<std::vector<int>>(&found->values))
      return {integers->begin(), integers->end()};
    throw std::invalid_argument(fmt::format("{}: {}: expected numbers", source_, name));
  }

  // The one number of a variable without dimensions.
  double number(std::string_view name, double low, double high, std::string_view expected) const {
    const double value = numbers(name, {}, "").front();
    if (value >= low && value <= high) return value;
    throw std::invalid_argument(fmt::format("{}: {} = {:.9g}: expected {} from {:.9g} to {:.9g}",
                                            source_, name, value, expected, low, high));
  }

  // Of a variable that has one.
  void require_unit(std::string_view name, bool (*holds)(std::string_view),
                    std::string_view expected) const {
    const auto found = std::ranges::find(content_.variables, name, &NetcdfVariable::name);
    if (found == content_.variables.end() || found->units.empty() || holds(found->units)) return;
    throw std::invalid_argument(
        fmt::format("{}: {} in {}: expected {}", source_, name, in_quotes(found->units), expected));
  }

 private:
  const NetcdfFile& content_;
  std::string_view source_;
};

bool is_seconds(std::string_view unit) {
  return unit.starts_with("second") || unit == "s" || unit.starts_with("s since");
}
bool is_since_1970(std::string_view unit) {
  return is_seconds(unit) &&
         (unit.find("1970-1-1") != unit.npos || unit.find("1970-01-01") != unit.npos);
}
bool is_degrees(std::string_view unit) { return unit.starts_with("deg"); }

constexpr double kLowestGround_m = -500, kHighestGround_m = 9000;

// "2014-09-01T13:25:59"; throws where a number is no time of this age.
std::string time_of(double seconds, const std::string& place) {
  constexpr double kLatest = 4102444800;  // 2100
  if (!(seconds >= 0 && seconds < kLatest)) {
    throw std::invalid_argument(
        fmt::format("{}: {:.9g} s since 1970: expected a time before 2100", place, seconds));
  }
  const Instant time{std::chrono::milliseconds(std::llround(1e3 * seconds))};
  return iso_text(time).substr(0, 19);
}

std::optional<double> present(double radiance) {
  if (!std::isfinite(radiance) || radiance < 0) return std::nullopt;
  return radiance;
}

struct Almucantars {
  std::vector<double> seconds, wavelength_um, sun_zenith_deg, azimuth_deg, radiance;
  double latitude_deg, longitude_deg;
  std::optional<double> elevation_m;
};

Almucantars almucantars_of(const Datastream& data) {
  data.require_unit("base_time", is_since_1970, "seconds since 1970-01-01");
  data.require_unit("time_offset", is_seconds, "seconds");
  for (const char* name : {"lat", "lon"}) data.require_unit(name, is_degrees, "degrees");
  Almucantars read{data.numbers("time_offset", {"time"}, ""),
                   data.numbers("wavelength", {"time"}, "um"),
                   data.numbers("zenith", {"time"}, "degree"),
                   data.numbers("azimuth", {"azimuth"}, "degree"),
                   data.numbers("alm_rad", {"time", "azimuth"}, "microWatt/(cm^2 * nm * ster)"),
                   data.number("lat", -90, 90, "a latitude in degrees"),
                   data.number("lon", -360, 360, "a longitude in degrees"),
                   {}};
  constexpr double kNoHeight = -900;  // -999 and -9999 say that none is known
  const double height = data.numbers("alt", {}, "m").front();
  if (height > kNoHeight)
    read.elevation_m = data.number("alt", kLowestGround_m, kHighestGround_m, "a height in m");
  const double base = data.numbers("base_time", {}, "").front();
  for (double& seconds : read.seconds) seconds += base;
  return read;
}

PhotometerLine line_of(const Almucantars& data, std::size_t i, std::string_view source) {
  PhotometerLine line{
      fmt::format("{}: time {}", source, i),
      ScanPath::kAlmucantar,
      {},
      std::round(1e6 * data.wavelength_um[i]) / 1e3,  // to what single precision holds
      {},
      {}};
  line.facts.local_time = time_of(data.seconds[i], line.place);
  line.facts.utc_offset_h = 0;
  line.facts.latitude_deg = data.latitude_deg;
  line.facts.longitude_deg = data.longitude_deg;
  line.facts.elevation_m = data.elevation_m;
  line.facts.sun_zenith_deg = data.sun_zenith_deg[i];
  for (std::size_t k = 0; k < data.azimuth_deg.size(); ++k) {
    line.readings.push_back(reading_along(line.path, data.azimuth_deg[k],
                                          present(data.radiance[i * data.azimuth_deg.size() + k])));
  }
  return line;
}

}  // namespace

bool is_netcdf(const std::filesystem::path& file) {
  std::array<char, 4> bytes{};
  std::ifstream(file, std::ios::binary).read(bytes.data(), bytes.size());
  const std::string_view first(bytes.data(), bytes.size());
  return first.starts_with("CDF") || first == "\x89HDF";
}

Reference load_arm_csphot(const std::filesystem::path& file, const ImportOptions& options) {
  const std::string source = file.string();
  require_sound_netcdf(file);
  const NetcdfFile content =
      module_named<fit::NetcdfModule>("skyfit_netcdf_module").read(std::filesystem::absolute(file));
  const Almucantars data = almucantars_of({content, source});
  MeasuredSky sky = photometer_sky(source, options);
  PhotometerScans scans(options, sky);
  LeftOut left_out("time");
  for (std::size_t i = 0; i < data.seconds.size(); ++i)
    left_out.attempt([&] { scans.add(line_of(data, i, source)); });
  for (const std::string& note : left_out.notes()) sky.note(note);
  return sky.finish();
}

}  // namespace skyfit::refs
