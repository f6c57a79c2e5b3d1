// SPDX-License-Identifier: Apache-2.0
#include "data_refs/perez_sky.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "data_refs/csv.h"
#include "data_refs/embedded.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kPrefix = "perez:";
constexpr std::string_view kFile = "perez_1993.csv";

struct Bin {
  double from;                             // epsilon
  std::array<std::array<double, 4>, 5> x;  // a to e: x1 .. x4
};

std::vector<Bin> read_bins() {
  const CsvTable table(embedded_text(kFile), kFile);
  std::vector<Bin> bins;
  for (const CsvRecord& record : table.records()) {
    Bin bin{table.number(record, "epsilon_from"), {}};
    for (std::size_t k = 0; k < 5; ++k) {
      for (std::size_t i = 0; i < 4; ++i)
        bin.x[k][i] = table.number(record, fmt::format("{}{}", "abcde"[k], i + 1));
    }
    bins.push_back(bin);
  }
  return bins;
}

double parse_part(std::string_view name, std::string_view text) {
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(std::string(text), &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !std::isfinite(value)) {
    throw std::invalid_argument(
        fmt::format("{}: \"{}\": expected perez:EPSILON,DELTA with two numbers", name, text));
  }
  return value;
}

}  // namespace

bool is_perez_name(std::string_view name) { return name.starts_with(kPrefix); }

PerezSky perez_sky_named(std::string_view name) {
  const std::string_view numbers = name.substr(kPrefix.size());
  const std::size_t comma = numbers.find(',');
  if (comma == std::string_view::npos) {
    throw std::invalid_argument(
        fmt::format("{}: expected perez:EPSILON,DELTA, such as perez:4,0.15", name));
  }
  const PerezSky sky{parse_part(name, numbers.substr(0, comma)),
                     parse_part(name, numbers.substr(comma + 1))};
  if (sky.epsilon < 1) {
    throw std::invalid_argument(
        fmt::format("{}: epsilon = {:.9g}: expected a clearness >= 1", name, sky.epsilon));
  }
  if (!(sky.delta > 0 && sky.delta <= 1)) {
    throw std::invalid_argument(
        fmt::format("{}: delta = {:.9g}: expected a brightness > 0, at most 1", name, sky.delta));
  }
  return sky;
}

PerezCoefficients perez_coefficients(const PerezSky& sky, double sun_zenith) {
  static const std::vector<Bin> bins = read_bins();
  std::size_t k = 0;
  while (k + 1 < bins.size() && sky.epsilon >= bins[k + 1].from) ++k;
  const double delta = sky.delta;
  const auto linear = [&](std::size_t i) {
    const std::array<double, 4>& x = bins[k].x[i];
    return x[0] + x[1] * sun_zenith + delta * (x[2] + x[3] * sun_zenith);
  };
  PerezCoefficients p{linear(0), linear(1), linear(2), linear(3), linear(4)};
  if (k == 0) {  // overcast: c and d have forms of their own
    const std::array<double, 4>&c = bins[0].x[2], &d = bins[0].x[3];
    p.c = std::exp(std::pow(delta * (c[0] + c[1] * sun_zenith), c[2])) - c[3];
    p.d = -std::exp(delta * (d[0] + d[1] * sun_zenith)) + d[2] + delta * d[3];
  }
  return p;
}

double perez_relative_luminance(const PerezSky& sky, double sun_zenith, double view_zenith,
                                double scattering_angle) {
  const PerezCoefficients p = perez_coefficients(sky, sun_zenith);
  const auto l = [&](double mu, double angle) {
    const double nu = std::cos(angle);
    return (1 + p.a * std::exp(p.b / mu)) * (1 + p.c * std::exp(p.d * angle) + p.e * nu * nu);
  };
  return l(std::cos(view_zenith), scattering_angle) / l(1, sun_zenith);
}

}  // namespace skyfit::refs
