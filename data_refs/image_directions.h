// SPDX-License-Identifier: Apache-2.0
// Which direction a pixel of an image of the sky looks into, and how much of the sky it sees.
// Distances in pixels from the upper left corner, so that the centre of the first pixel is at 0.5.
#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "data_refs/import_options.h"

namespace skyfit::refs {

struct PixelView {
  double zenith, azimuth;  // radians, azimuth clockwise from north
  double solid_angle_sr;   // of one pixel
};

class ImageDirections {
 public:
  virtual ~ImageDirections() = default;
  // Nothing below the horizon.
  virtual std::optional<PixelView> view(double x_px, double y_px) const = 0;
};

// A fisheye (fisheye.h), a panorama (panorama.h) or a map of the whole sphere (sphere_map.h), as
// facts.projection says. Throws std::invalid_argument that begins with `source` when it is not
// stated, does not fit the image, or facts of another kind of images are stated beside it.
std::unique_ptr<ImageDirections> image_directions(const ImportOptions& facts, int width, int height,
                                                  std::string_view source);

}  // namespace skyfit::refs
