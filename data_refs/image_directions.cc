// SPDX-License-Identifier: Apache-2.0
#include "data_refs/image_directions.h"

#include <fmt/format.h>

#include <stdexcept>

#include "data_refs/fisheye.h"
#include "data_refs/panorama.h"

namespace skyfit::refs {

std::unique_ptr<ImageDirections> image_directions(const ImportOptions& facts, int width, int height,
                                                  std::string_view source) {
  if (facts.projection == "equirectangular")
    return std::make_unique<Panorama>(facts, width, height, source);
  if (width == 2 * height && !facts.radius_px) {
    throw std::invalid_argument(
        fmt::format("{}: {} x {} pixels: expected a fisheye, this is as wide as a panorama; state "
                    "projection = equirectangular, or radius_px where it is none",
                    source, width, height));
  }
  return std::make_unique<Fisheye>(facts, width, height, source);
}

}  // namespace skyfit::refs
