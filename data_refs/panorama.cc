// SPDX-License-Identifier: Apache-2.0
#include "data_refs/panorama.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double horizon_row(const ImportOptions& facts, int width, int height, std::string_view source) {
  if (facts.centre_y_px) return *facts.centre_y_px;
  if (width == 2 * height) return 0.5 * height;
  if (width == 4 * height) return height;
  throw std::invalid_argument(fmt::format(
      "{}: {} x {} pixels: expected a panorama twice as wide as high (or four times, the sky "
      "alone), or centre_y_px, the row of the horizon",
      source, width, height));
}

}  // namespace

Panorama::Panorama(const ImportOptions& facts, int width, int height, std::string_view source)
    : width_(width),
      horizon_(horizon_row(facts, width, height, source)),
      north_(facts.north_deg.value_or(0) * kRadiansPerDegree),
      east_is_left_(facts.east == "left") {}

std::optional<PixelView> Panorama::view(double x_px, double y_px) const {
  const double step = kTurn / width_;
  const double zenith = kTurn / 4 + (y_px - horizon_) * step;
  if (zenith >= kTurn / 4 || zenith < 0) return {};
  const double turn = (x_px - 0.5 * width_) * step - north_;
  // Between the rows above and below by half a pixel.
  const double half = 0.5 * step;
  const double solid_angle =
      step * (std::cos(std::max(zenith - half, 0.0)) - std::cos(zenith + half));
  return PixelView{zenith, std::remainder(east_is_left_ ? -turn : turn, kTurn), solid_angle};
}

}  // namespace skyfit::refs
