// SPDX-License-Identifier: Apache-2.0
// The truth tables in tests/model/data and data_refs/truth: Monte Carlo in spherical geometry and
// discrete ordinates; their headers say how they were made.
#pragma once

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "model/sky_model.h"
#include "tests/atmospheres.h"

namespace skyfit::truth {

inline constexpr double kDegree = std::numbers::pi / 180;

struct Row {
  std::vector<std::string> field;
  double number(int i) const { return std::stod(field[i]); }
};

inline std::vector<Row> read_rows(const std::string& name) {
  std::ifstream in(std::string(SKYFIT_TEST_DATA) + "/" + name);
  if (!in) throw std::runtime_error(name + ": cannot be read");
  std::vector<Row> rows;
  bool header = true;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (std::exchange(header, false)) continue;
    Row row;
    std::stringstream fields(line);
    for (std::string f; std::getline(fields, f, ',');) row.field.push_back(f);
    rows.push_back(row);
  }
  return rows;
}

// The atmosphere of the Monte Carlo tables.
inline Atmosphere<double> monte_carlo_earth(bool haze) {
  Atmosphere<double> a;
  set_scattering(a.at("rayleigh"), 550, 0.01216e-3, 4.08);
  set_scattering(a.at("mie"), 550, haze ? 0.1583e-3 : 0.0040e-3, 1.0);
  a.at("mie").single_scattering_albedo = haze ? 0.95 : 0.9;
  a.at("mie").phase.g = haze ? 0.65 : 0.76;
  a.at("ozone").amount = 0;
  a.ground_albedo = haze ? 0.2 : 0.1;
  return a;
}

// The cases R1, R3, A3 of the plane-parallel table, on a planet of 10^6 km.
inline Atmosphere<double> plane_parallel(const std::string& name) {
  Atmosphere<double> a;
  a.bottom_radius_m = 1e9;
  a.top_radius_m = 1e9 + 100e3;
  const double depth = name == "R3" ? 0.25 : 0.0973;
  set_scattering(a.at("rayleigh"), 550, depth / 8000, 4);
  set_scattering(a.at("mie"), 550, name == "A3" ? 0.9 * 0.10 / 1200 : 0.0, 0);
  a.at("mie").single_scattering_albedo = 0.9;
  a.at("mie").phase.g = 0.76;
  a.at("ozone").amount = 0;
  a.ground_albedo = name == "R1" ? 0 : name == "R3" ? 0.3 : 0.1;
  return a;
}

// The cases of monte_carlo.csv.
struct MonteCarloCase {
  Atmosphere<double> atmosphere;
  double wavelength_nm = 550;
};
inline MonteCarloCase monte_carlo_case(const std::string& name) {
  MonteCarloCase c;
  Atmosphere<double>& a = c.atmosphere;
  set_scattering(a.at("rayleigh"), 550, 1.216e-5, 4.08);
  a.at("ozone").amount = 0;
  set_scattering(a.at("mie"), 550, 1.583e-4, 1.0);  // aerosol optical depth 0.2
  a.at("mie").single_scattering_albedo = 0.95;
  a.at("mie").phase.g = 0.65;
  a.ground_albedo = 0.2;
  if (name == "clear-400nm") {
    c.wavelength_nm = 400;
    set_scattering(a.at("mie"), 550, 3e-5, 1.3);
    a.at("ozone").amount = 300;
  } else if (name == "haze-650nm") {
    c.wavelength_nm = 650;
    set_scattering(a.at("mie"), 550, 2.1e-4, 1.3);
    a.at("mie").phase.g = 0.76;
    a.at("ozone").amount = 300;
    a.ground_albedo = 0.5;
  } else if (name == "peaked-haze") {
    set_scattering(a.at("mie"), 550, 2.0e-4, 1.3);
    a.at("mie").phase.type = PhaseType::kTwoLobe;
    a.at("mie").phase.g1 = 0.9;
    a.at("mie").phase.g2 = 0.3;
    a.at("mie").phase.weight = 0.6;
  } else if (name == "twilight-clear") {
    a.at("mie").amount = 4e-6;
    a.at("mie").phase.g = 0.76;
  } else if (name == "deep-twilight") {
    a.at("mie").amount = 4e-5;
  } else if (name == "thick-haze-450nm") {  // aerosol optical depth 1.36
    c.wavelength_nm = 450;
    set_scattering(a.at("mie"), 550, 8e-4, 1.2);
    a.at("mie").single_scattering_albedo = 0.9;
    a.at("mie").phase.g = 0.75;
    a.at("ozone").amount = 350;
  } else if (name == "altitude-clear") {
    a.at("mie").amount = 4e-6;
  } else if (name == "mars") {
    a.bottom_radius_m = 3389.5e3;
    a.top_radius_m = a.bottom_radius_m + 100e3;
    a.at("rayleigh").amount = 1e-6;
    a.at("rayleigh").profile.scale_height_m = 11e3;
    set_scattering(a.at("mie"), 550, 4e-5, 0);
    a.at("mie").profile.scale_height_m = 11e3;
    a.at("mie").single_scattering_albedo = 0.94;
    a.at("mie").phase.g = 0.7;
  } else if (name != "low-sun-haze" && name != "twilight-haze" && name != "altitude-haze" &&
             name != "space") {
    throw std::runtime_error(name + ": no such case");
  }
  return c;
}
inline SkyPoint point_of(const Row& row) {
  return {row.number(1), row.number(2) * kDegree, row.number(3) * kDegree, row.number(4) * kDegree};
}

struct Compared {
  SkyPoint point;
  double truth, model;
  double error() const { return model / truth - 1; }
};

// Root mean square and largest absolute relative error of the rows that `keep` accepts.
struct Errors {
  int count = 0;
  double rms = 0, worst = 0;
  std::string where;
};
template <class Keep>
Errors errors(const std::vector<Compared>& rows, Keep keep) {
  Errors e;
  double sum = 0;
  for (const Compared& c : rows) {
    if (!keep(c.point)) continue;
    ++e.count;
    sum += c.error() * c.error();
    if (std::abs(c.error()) > e.worst) {
      e.worst = std::abs(c.error());
      std::ostringstream text;
      text << "sun " << c.point.sun_zenith / kDegree << " view " << c.point.view_zenith / kDegree
           << " azimuth " << c.point.relative_azimuth / kDegree << " deg: " << 100 * c.error()
           << " %";
      e.where = text.str();
    }
  }
  e.rms = e.count > 0 ? std::sqrt(sum / e.count) : 0;
  return e;
}

inline std::vector<Compared> compare(const SkyModel& model, const Atmosphere<double>& atmosphere,
                                     const std::vector<SkyPoint>& points,
                                     const std::vector<double>& truth,
                                     const WavelengthNode& node = {550, 0}) {
  const SkyValues values = model.radiance(atmosphere, {&node, 1}, points, {});
  std::vector<Compared> rows;
  for (std::size_t i = 0; i < points.size(); ++i)
    rows.push_back({points[i], truth[i], values.at(static_cast<int>(i), 0)});
  return rows;
}

inline std::vector<Compared> compare_monte_carlo(const SkyModel& model, bool haze) {
  std::vector<SkyPoint> points;
  std::vector<double> truth;
  for (const Row& r :
       read_rows("../../../data_refs/truth/" +
                 std::string(haze ? "earth_550nm_haze_ground.csv" : "earth_550nm_ground.csv"))) {
    points.push_back({0, r.number(0) * kDegree, r.number(1) * kDegree, r.number(2) * kDegree});
    truth.push_back(r.number(7));
  }
  return compare(model, monte_carlo_earth(haze), points, truth);
}

inline std::vector<Compared> compare_plane_parallel(const SkyModel& model,
                                                    const std::string& name) {
  std::vector<SkyPoint> points;
  std::vector<double> truth;
  for (const Row& r : read_rows("../../../data_refs/truth/plane_parallel.csv")) {
    if (r.field[0] != name || r.field[6] != "ok") continue;
    points.push_back({0, r.number(2) * kDegree, r.number(3) * kDegree, r.number(4) * kDegree});
    truth.push_back(r.number(5));
  }
  return compare(model, plane_parallel(name), points, truth);
}

}  // namespace skyfit::truth
