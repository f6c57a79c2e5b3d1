// SPDX-License-Identifier: Apache-2.0
#include "data_refs/image_directions.h"

#include <fmt/format.h>

#include <stdexcept>

#include "data_refs/fisheye.h"
#include "data_refs/panorama.h"
#include "data_refs/sphere_map.h"

namespace skyfit::refs {
namespace {

void expect_no_lens(const ImportOptions& facts, std::string_view source) {
  const auto refuse_if = [&](bool stated, std::string_view name, std::string_view kinds) {
    if (stated)
      throw std::invalid_argument(fmt::format("{}: {}: expected with {}, got projection = {}",
                                              source, name, kinds, *facts.projection));
  };
  refuse_if(facts.radius_px.has_value(), "radius_px", "a fisheye");
  refuse_if(facts.centre_x_px.has_value(), "centre_x_px", "a fisheye");
  refuse_if(facts.lens_polynomial.has_value(), "lens_polynomial", "a fisheye");
  refuse_if(facts.centre_y_px && is_sphere_map(*facts.projection), "centre_y_px",
            "a fisheye or a panorama");
}

}  // namespace

std::unique_ptr<ImageDirections> image_directions(const ImportOptions& facts, int width, int height,
                                                  std::string_view source) {
  const std::string_view projection = facts.projection ? *facts.projection : "";
  if (projection == "equirectangular" || is_sphere_map(projection)) {
    expect_no_lens(facts, source);
    if (is_sphere_map(projection)) return std::make_unique<SphereMap>(facts, width, height, source);
    return std::make_unique<Panorama>(facts, width, height, source);
  }
  if (width == 2 * height && !facts.radius_px) {
    throw std::invalid_argument(
        fmt::format("{}: {} x {} pixels: expected a fisheye, this is as wide as a panorama; state "
                    "projection = equirectangular, or radius_px where it is none",
                    source, width, height));
  }
  return std::make_unique<Fisheye>(facts, width, height, source);
}

}  // namespace skyfit::refs
