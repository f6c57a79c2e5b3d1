// SPDX-License-Identifier: Apache-2.0
#include "data_refs/solar_position.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "data_refs/csv.h"
#include "data_refs/embedded.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr double kTurn = 2 * std::numbers::pi, kArcsecond = kRadiansPerDegree / 3600;
constexpr double kDay_ms = 86400e3;

double wrapped(double angle) {
  const double rest = std::fmod(angle, kTurn);
  return rest < 0 ? rest + kTurn : rest;
}

struct OrbitTerm {
  std::string coordinate;  // "longitude", "latitude" or "distance"
  int power;
  double amplitude, phase, frequency;
};

std::vector<OrbitTerm> read_orbit() {
  constexpr std::string_view kFile = "earth_orbit_vsop87.csv";
  const CsvTable table(embedded_text(kFile), kFile);
  std::vector<OrbitTerm> terms;
  for (const CsvRecord& record : table.records()) {
    terms.push_back(
        {table.text(record, "coordinate"), static_cast<int>(table.number(record, "power")),
         1e-8 * table.number(record, "amplitude_1e8"), table.number(record, "phase_rad"),
         table.number(record, "frequency_rad_per_millennium")});
  }
  return terms;
}

// Of the Earth, heliocentric: radians or au.
double orbit_coordinate(std::string_view coordinate, double millennia) {
  static const std::vector<OrbitTerm> terms = read_orbit();
  double sum = 0;
  for (const OrbitTerm& term : terms) {
    if (term.coordinate != coordinate) continue;
    sum += term.amplitude * std::cos(term.phase + term.frequency * millennia) *
           std::pow(millennia, term.power);
  }
  return sum;
}

// TT - UT in seconds: Stephenson & Morrison's table to 2000, then IERS. An error of 10 s moves the
// sun by 0.0001 deg.
double terrestrial_minus_universal_s(double year) {
  constexpr std::array kSeconds = {-2.8, 10.5, 21.2, 24.0, 24.3, 29.2, 33.2,
                                   40.2, 50.5, 56.9, 63.8, 66.1, 69.4};  // 1900, 1910 .. 2020
  const double position = std::clamp((year - 1900) / 10, 0.0, kSeconds.size() - 1.0);
  const auto below = std::min(static_cast<std::size_t>(position), kSeconds.size() - 2);
  return std::lerp(kSeconds[below], kSeconds[below + 1], position - static_cast<double>(below));
}

// Since J2000.0, in days of 86400 s.
struct Epoch {
  double universal_days, terrestrial_days;
};

Epoch epoch(Instant time) {
  constexpr double kJ2000_unix_days = 10957.5;
  const double days =
      static_cast<double>(time.time_since_epoch().count()) / kDay_ms - kJ2000_unix_days;
  return {days, days + terrestrial_minus_universal_s(2000 + days / 365.25) / 86400};
}

struct Nutation {
  double longitude, obliquity;
};

// Meeus, Astronomical Algorithms, chapter 22: within 0.5 and 0.1 arc seconds.
Nutation nutation(double centuries) {
  const double node = kRadiansPerDegree * (125.04452 - 1934.136261 * centuries);
  const double sun = kRadiansPerDegree * (280.4665 + 36000.7698 * centuries);
  const double moon = kRadiansPerDegree * (218.3165 + 481267.8813 * centuries);
  return {kArcsecond * (-17.20 * std::sin(node) - 1.32 * std::sin(2 * sun) -
                        0.23 * std::sin(2 * moon) + 0.21 * std::sin(2 * node)),
          kArcsecond * (9.20 * std::cos(node) + 0.57 * std::cos(2 * sun) +
                        0.10 * std::cos(2 * moon) - 0.09 * std::cos(2 * node))};
}

struct EquatorialSun {
  double right_ascension, declination, distance_au, sidereal_time;  // sidereal time at Greenwich
};

// Apparent and geocentric.
EquatorialSun equatorial_sun(Instant time) {
  const auto [universal, terrestrial] = epoch(time);
  const double t = terrestrial / 36525, millennia = t / 10;
  const double distance = orbit_coordinate("distance", millennia);
  const auto [in_longitude, in_obliquity] = nutation(t);
  const double obliquity =
      kArcsecond * (84381.448 + t * (-46.8150 + t * (-0.00059 + t * 0.001813))) + in_obliquity;
  const double aberration = -20.4898 * kArcsecond / distance;
  const double longitude =
      orbit_coordinate("longitude", millennia) + std::numbers::pi + in_longitude + aberration;
  const double latitude = -orbit_coordinate("latitude", millennia);
  const double u = universal / 36525;
  const double mean_sidereal = kRadiansPerDegree * (280.46061837 + 360.98564736629 * universal +
                                                    u * u * (0.000387933 - u / 38710000));
  return {std::atan2(
              std::sin(longitude) * std::cos(obliquity) - std::tan(latitude) * std::sin(obliquity),
              std::cos(longitude)),
          std::asin(std::sin(latitude) * std::cos(obliquity) +
                    std::cos(latitude) * std::sin(obliquity) * std::sin(longitude)),
          distance, mean_sidereal + in_longitude * std::cos(obliquity)};
}

}  // namespace

SolarPosition solar_position(Instant time, const Site& site) {
  constexpr double kEquatorialRadius_m = 6378140, kPolarOverEquatorial = 0.99664719;
  constexpr double kParallaxAtOneAu = 8.794 * kArcsecond;
  const EquatorialSun sun = equatorial_sun(time);
  const double hour_angle = sun.sidereal_time + site.longitude - sun.right_ascension;
  const double reduced = std::atan(kPolarOverEquatorial * std::tan(site.latitude));
  const double height = site.elevation_m / kEquatorialRadius_m;
  const double from_axis = std::cos(reduced) + height * std::cos(site.latitude);
  const double from_equator =
      kPolarOverEquatorial * std::sin(reduced) + height * std::sin(site.latitude);
  const double sin_parallax = std::sin(kParallaxAtOneAu / sun.distance_au);
  // From the observer, in units of the distance: toward the meridian's point of the equator, west,
  // and the pole.
  const double meridian =
      std::cos(sun.declination) * std::cos(hour_angle) - from_axis * sin_parallax;
  const double west = std::cos(sun.declination) * std::sin(hour_angle);
  const double pole = std::sin(sun.declination) - from_equator * sin_parallax;
  const double up = meridian * std::cos(site.latitude) + pole * std::sin(site.latitude);
  const double north = pole * std::cos(site.latitude) - meridian * std::sin(site.latitude);
  return {std::atan2(std::hypot(north, west), up), wrapped(std::atan2(-west, north)),
          sun.distance_au};
}

double sun_distance_au(Instant time) {
  return orbit_coordinate("distance", epoch(time).terrestrial_days / 365250);
}

double refraction(double zenith) {
  constexpr double kArcMinute = kRadiansPerDegree / 60;
  const double altitude_deg = 90 - zenith / kRadiansPerDegree;
  if (altitude_deg < -1) return 0;
  return kArcMinute * 1.02 /
         std::tan((altitude_deg + 10.3 / (altitude_deg + 5.11)) * kRadiansPerDegree);
}

}  // namespace skyfit::refs
