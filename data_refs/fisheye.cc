// SPDX-License-Identifier: Apache-2.0
#include "data_refs/fisheye.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr double kPi = std::numbers::pi;

[[noreturn]] void fail(std::string_view source, std::string_view message) {
  throw std::invalid_argument(fmt::format("{}: {}", source, message));
}

}  // namespace

Fisheye::Fisheye(const ImportOptions& facts, int width, int height, std::string_view source)
    : centre_x_(facts.centre_x_px.value_or(width / 2.0)),
      centre_y_(facts.centre_y_px.value_or(height / 2.0)),
      radius_px_(facts.radius_px.value_or(std::min(width, height) / 2.0)),
      north_(facts.north_deg.value_or(0) * kRadiansPerDegree),
      east_is_left_(facts.east != "right") {
  if (!facts.projection) {
    fail(source,
         "projection: not stated, expected equidistant, equisolid, orthographic, stereographic, "
         "polynomial, equirectangular, angular, cube or octahedral");
  }
  const std::string& name = *facts.projection;
  projection_ = name == "equidistant"     ? Projection::kEquidistant
                : name == "equisolid"     ? Projection::kEquisolid
                : name == "orthographic"  ? Projection::kOrthographic
                : name == "stereographic" ? Projection::kStereographic
                                          : Projection::kPolynomial;
  if (projection_ != Projection::kPolynomial) {
    if (facts.lens_polynomial)
      fail(source,
           fmt::format("lens_polynomial: expected with projection polynomial, got {}", name));
    return;
  }
  if (!facts.lens_polynomial) fail(source, "lens_polynomial: not stated, expected C1,C2,..");
  polynomial_ = number_list(*facts.lens_polynomial);
  for (int deg = 0; deg <= 90; ++deg) {
    if (slope_of(deg * kRadiansPerDegree) > 0) continue;
    fail(source,
         fmt::format("lens_polynomial = {}: expected a radius that grows to the horizon; at "
                     "{} deg it does not",
                     *facts.lens_polynomial, deg));
  }
}

double Fisheye::radius_of(double zenith) const {
  switch (projection_) {
    case Projection::kEquidistant:
      return zenith * 2 / kPi;
    case Projection::kEquisolid:
      return std::sin(zenith / 2) / std::sin(kPi / 4);
    case Projection::kOrthographic:
      return std::sin(zenith);
    case Projection::kStereographic:
      return std::tan(zenith / 2);
    case Projection::kPolynomial:
      break;
  }
  const double s = zenith * 2 / kPi;
  double sum = 0;
  for (auto c = polynomial_.rbegin(); c != polynomial_.rend(); ++c) sum = (sum + *c) * s;
  return sum;
}

double Fisheye::slope_of(double zenith) const {
  switch (projection_) {
    case Projection::kEquidistant:
      return 2 / kPi;
    case Projection::kEquisolid:
      return std::cos(zenith / 2) / 2 / std::sin(kPi / 4);
    case Projection::kOrthographic:
      return std::cos(zenith);
    case Projection::kStereographic:
      return 0.5 / (std::cos(zenith / 2) * std::cos(zenith / 2));
    case Projection::kPolynomial:
      break;
  }
  const double s = zenith * 2 / kPi;
  double sum = 0;
  for (std::size_t k = polynomial_.size(); k > 0; --k)
    sum = sum * s + static_cast<double>(k) * polynomial_[k - 1];
  return sum * 2 / kPi;
}

double Fisheye::zenith_of(double radius) const {
  switch (projection_) {
    case Projection::kEquidistant:
      return radius * kPi / 2;
    case Projection::kEquisolid:
      return 2 * std::asin(std::min(1.0, radius * std::sin(kPi / 4)));
    case Projection::kOrthographic:
      return std::asin(std::min(1.0, radius));
    case Projection::kStereographic:
      return 2 * std::atan(radius);
    case Projection::kPolynomial:
      break;
  }
  double low = 0, high = kPi / 2;
  constexpr int kHalvings = 50;  // of pi / 2, down to rounding
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (radius_of(middle) < radius ? low : high) = middle;
  }
  return low;
}

std::optional<PixelView> Fisheye::view(double x_px, double y_px) const {
  const double right = x_px - centre_x_, down = y_px - centre_y_;
  const double radius = std::hypot(right, down) / radius_px_;
  if (radius >= radius_of(kPi / 2)) return {};
  const double zenith = zenith_of(radius);
  // In the image clockwise from north; as one looks up, east lies on the left.
  const double turn = std::atan2(right, -down) - north_;
  // dOmega / dA = sin t / (r dr/dt); at the zenith 1 / (dr/dt)^2.
  const double slope = slope_of(zenith);
  constexpr double kAtZenith = 1e-6;
  const double per_area =
      radius < kAtZenith ? 1 / (slope * slope) : std::sin(zenith) / (radius * slope);
  return PixelView{zenith, std::remainder(east_is_left_ ? -turn : turn, 2 * kPi),
                   per_area / (radius_px_ * radius_px_)};
}

}  // namespace skyfit::refs
