// SPDX-License-Identifier: Apache-2.0
#include "model/polarisation.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "model/numerics/angles.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;

// Directions of the vertical circle by their angle from the zenith, > 0 on the sun's side.
SkyPoint on_vertical_circle(double altitude_m, double sun_zenith, double angle) {
  return {altitude_m, sun_zenith, std::abs(angle), angle < 0 ? kPi : 0};
}

NeutralPoint neutral_point(double sun_zenith, double angle) {
  NeutralPoint point{NeutralPointKind::kOther, std::abs(angle), angle < 0 ? kPi : 0,
                     std::abs(sun_zenith - angle)};
  if (point.distance > 0.5 * kPi) {
    point.kind = NeutralPointKind::kArago;
    point.distance = kPi - point.distance;
  } else {
    point.kind = angle < sun_zenith ? NeutralPointKind::kBabinet : NeutralPointKind::kBrewster;
  }
  return point;
}

// Of the points of a kind only the nearest has its name.
void keep_nearest_names(std::vector<NeutralPoint>& points) {
  const std::vector<NeutralPoint> all = points;
  for (NeutralPoint& point : points) {
    for (const NeutralPoint& other : all) {
      if (other.kind == point.kind && other.distance < point.distance)
        point.kind = NeutralPointKind::kOther;
    }
  }
}

}  // namespace

LinearPolarisation linear_polarisation(double i, double q, double u) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), polarised = std::hypot(q, u);
  if (!(i > 0)) return {nan, nan};
  if (!(polarised > 0)) return {0, nan};
  const double angle = 0.5 * std::atan2(u, q) * kDegreesPerRadian;
  return {polarised / i, angle <= -90 ? 90 : angle};
}

std::string_view neutral_point_name(NeutralPointKind kind) {
  switch (kind) {
    case NeutralPointKind::kBabinet:
      return "Babinet";
    case NeutralPointKind::kBrewster:
      return "Brewster";
    case NeutralPointKind::kArago:
      return "Arago";
    case NeutralPointKind::kOther:
      break;
  }
  return "neutral point";
}

std::vector<NeutralPoint> neutral_points(const SkyModel& model,
                                         const Atmosphere<double>& atmosphere,
                                         const WavelengthNode& wavelength, double altitude_m,
                                         double sun_zenith) {
  constexpr double kStep = 0.25 * kRadiansPerDegree;
  constexpr int kSteps = 359;  // to the zenith angle of 89.75 deg on both sides
  std::vector<SkyPoint> circle;
  for (int k = kSteps; k >= -kSteps; --k)
    circle.push_back(on_vertical_circle(altitude_m, sun_zenith, k * kStep));
  const StokesValues light = model.stokes(atmosphere, {&wavelength, 1}, circle, {});
  std::vector<NeutralPoint> points;
  for (int p = 0; p + 1 < light.q.points; ++p) {
    const double q = light.q.at(p, 0), next = light.q.at(p + 1, 0);
    if ((q > 0) == (next > 0)) continue;
    const double part = q / (q - next);
    points.push_back(neutral_point(sun_zenith, (kSteps - p - part) * kStep));
  }
  keep_nearest_names(points);
  return points;
}

}  // namespace skyfit
