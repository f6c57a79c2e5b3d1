// SPDX-License-Identifier: Apache-2.0
#include "render/sky_map/light_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/numerics/angles.h"
#include "render/sky_map/sky_map.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kRadiansPerDegree;
constexpr double kDarkest = 1e-30;  // cd/m^2 or W m^-2 sr^-1 nm^-1, in the place of 0

// From `from` to `to`, each step as long as step(there) says at most.
template <class Step>
void append_range(double from, double to, const Step& step, std::vector<double>& nodes) {
  nodes.push_back(from);
  while (nodes.back() < to) nodes.push_back(std::min(nodes.back() + step(nodes.back()), to));
}

double weighted(const std::vector<double>& weight, const SkyValues& values, int point) {
  double sum = 0;
  for (std::size_t k = 0; k < weight.size(); ++k)
    sum += weight[k] * values.at(point, static_cast<int>(k));
  return sum;
}

struct Between {
  std::size_t low;
  double part;
};

Between between(const std::vector<double>& nodes, std::size_t first, std::size_t end, double x) {
  const auto begin = nodes.begin() + static_cast<std::ptrdiff_t>(first),
             last = nodes.begin() + static_cast<std::ptrdiff_t>(end) - 1;
  const auto above = std::clamp(std::upper_bound(begin, last, x), begin + 1, last);
  const double low = *(above - 1), high = *above;
  return {static_cast<std::size_t>(above - 1 - nodes.begin()),
          std::clamp((x - low) / (high - low), 0.0, 1.0)};
}

}  // namespace

LightGrid::LightGrid(const SkyModel& model, const Atmosphere<double>& atmosphere,
                     const MapChannels& channels, const SkyMapOptions& options)
    : channels_(channels.names.size()) {
  const double h = options.altitude_m, radius = atmosphere.bottom_radius_m;
  horizon_ = options.level_horizon ? 0.5 * kPi : kPi - std::asin(radius / (radius + h));
  constexpr double kBeside = 1e-5;  // of the horizon, so that a ray is on its side
  const auto zenith_step = [&](double zenith) {
    if (std::abs(zenith - horizon_) < 2.05 * kDegree) return 0.1 * kDegree;
    return std::abs(zenith - options.sun_zenith) < 12 * kDegree ? 0.25 * kDegree : 0.5 * kDegree;
  };
  append_range(0, horizon_ - kBeside, zenith_step, zeniths_);
  first_ground_ = zeniths_.size();
  append_range(horizon_ + kBeside, kPi, zenith_step, zeniths_);
  append_range(
      0, kPi, [](double a) { return a < 12 * kDegree ? 0.25 * kDegree : kDegree; }, azimuths_);
  const std::size_t rows = options.ground ? zeniths_.size() : first_ground_;
  std::vector<SkyPoint> points;
  for (std::size_t i = 0; i < rows; ++i) {
    for (const double azimuth : azimuths_)
      points.push_back({h, options.sun_zenith, zeniths_[i], azimuth});
  }
  StokesValues sky;
  if (options.stokes) {
    sky = model.stokes(atmosphere, channels.nodes, points, {});
    polarised_ = channels.polarised.size();
  } else {
    sky.i = model.radiance(atmosphere, channels.nodes, points, {});
  }
  logs_.reserve(points.size() * channels_);
  for (int p = 0; p < sky.i.points; ++p) {
    for (const std::vector<double>& weight : channels.weight)
      logs_.push_back(std::log(std::max(weighted(weight, sky.i, p), kDarkest)));
    if (!options.stokes) continue;
    for (const std::size_t c : channels.polarised) {
      const std::vector<double>& weight = channels.weight[c];
      const double i = weighted(weight, sky.i, p);
      q_u_.push_back(
          i > kDarkest ? std::array{weighted(weight, sky.q, p) / i, weighted(weight, sky.u, p) / i}
                       : std::array{0.0, 0.0});
    }
  }
}

struct LightGrid::Place {
  Between z, a;
  std::size_t low, high;  // nodes [zenith][azimuth] at the lower azimuth
};

LightGrid::Place LightGrid::place_of(double zenith, double azimuth) const {
  const bool is_ground = zenith > horizon_;
  const Between z = is_ground ? between(zeniths_, first_ground_, zeniths_.size(), zenith)
                              : between(zeniths_, 0, first_ground_, zenith);
  const Between a =
      between(azimuths_, 0, azimuths_.size(), std::abs(std::remainder(azimuth, 2 * kPi)));
  const std::size_t low = z.low * azimuths_.size() + a.low;
  return {z, a, low, low + azimuths_.size()};
}

void LightGrid::add(double zenith, double azimuth, double share, std::vector<double>& light) const {
  const Place place = place_of(zenith, azimuth);
  const double* const low = &logs_[place.low * channels_];
  const double* const high = &logs_[place.high * channels_];
  for (std::size_t c = 0; c < channels_; ++c) {
    const double below = low[c] + place.a.part * (low[c + channels_] - low[c]),
                 above = high[c] + place.a.part * (high[c + channels_] - high[c]);
    const double value = std::exp(below + place.z.part * (above - below));
    if (value > 2 * kDarkest) light[c] += share * value;
  }
}

std::vector<std::array<double, 2>> LightGrid::polarisation(double zenith, double azimuth) const {
  const Place place = place_of(zenith, azimuth);
  // The model's azimuths count counter-clockwise, on which side U changes its sign.
  const double side = std::remainder(azimuth, 2 * kPi) > 0 ? -1 : 1;
  std::vector<std::array<double, 2>> result(polarised_);
  for (std::size_t c = 0; c < polarised_; ++c) {
    for (std::size_t k = 0; k < 2; ++k) {
      const auto along = [&](std::size_t node) {
        const double low = q_u_[node * polarised_ + c][k];
        return low + place.a.part * (q_u_[(node + 1) * polarised_ + c][k] - low);
      };
      result[c][k] = std::lerp(along(place.low), along(place.high), place.z.part);
    }
    result[c][1] *= side;
  }
  return result;
}

}  // namespace skyfit
