// SPDX-License-Identifier: Apache-2.0
#include "data_refs/sphere_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "model/numerics/angles.h"

namespace skyfit::refs {

bool is_sphere_map(std::string_view projection) {
  constexpr std::array<std::string_view, 3> kMaps = {"angular", "cube", "octahedral"};
  return std::ranges::count(kMaps, projection) > 0;
}

SphereMap::SphereMap(const ImportOptions& facts, int width, int height, std::string_view source)
    : map_(make_map_projection(*facts.projection, height)),
      north_(facts.north_deg.value_or(0) * kRadiansPerDegree),
      east_is_left_(facts.east == "left") {
  if (map_->width() == width) return;
  throw std::invalid_argument(
      fmt::format("{}: {} x {} pixels: expected {} x {} of a map with projection = {}", source,
                  width, height, map_->width(), height, *facts.projection));
}

std::optional<PixelView> SphereMap::view(double x_px, double y_px) const {
  const auto axis = map_->direction(x_px, y_px);
  if (!axis) return {};
  const auto& [east, north, up] = *axis;
  if (!(up > 0)) return {};
  const double turn = std::atan2(east, north) - north_;
  return PixelView{std::atan2(std::hypot(east, north), up),
                   std::remainder(east_is_left_ ? -turn : turn, 2 * std::numbers::pi),
                   map_->solid_angle_sr(static_cast<int>(x_px), static_cast<int>(y_px))};
}

}  // namespace skyfit::refs
