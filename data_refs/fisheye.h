// SPDX-License-Identifier: Apache-2.0
// The geometry of an image of the whole sky: which direction a pixel looks into, and how much of
// the sky it sees. Distances in pixels from the upper left corner of the image, so that the centre
// of the first pixel is at 0.5.
//
// The radius r from the image of the zenith over that of the horizon, t the zenith angle in
// radians:
//   equidistant   2 t / pi
//   equisolid     sin(t / 2) / sin(pi / 4)
//   orthographic  sin t
//   polynomial    c1 s + c2 s^2 + .., s = 2 t / pi
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "data_refs/import_options.h"

namespace skyfit::refs {

class Fisheye {
 public:
  // From the facts of the image; what they leave out is as import_option_table() says. Throws
  // std::invalid_argument that begins with `source` when the projection is not stated or its
  // polynomial is not monotonic up to the horizon.
  Fisheye(const ImportOptions& facts, int width, int height, std::string_view source);

  struct View {
    double zenith, azimuth;  // radians, azimuth clockwise from north
    double solid_angle_sr;   // of one pixel
  };
  // Nothing below the horizon.
  std::optional<View> view(double x_px, double y_px) const;

 private:
  double radius_of(double zenith) const;  // relative to that of the horizon
  double slope_of(double zenith) const;   // d radius_of / d zenith
  double zenith_of(double radius) const;

  enum class Projection { kEquidistant, kEquisolid, kOrthographic, kPolynomial };
  Projection projection_;
  std::vector<double> polynomial_;
  double centre_x_, centre_y_, radius_px_, north_;
  bool east_is_left_;
};

}  // namespace skyfit::refs
