// SPDX-License-Identifier: Apache-2.0
// The geometry of a fisheye lens that looks to the zenith. The radius r from the image of the
// zenith over that of the horizon, t the zenith angle in radians:
//   equidistant   2 t / pi
//   equisolid     sin(t / 2) / sin(pi / 4)
//   orthographic  sin t
//   stereographic tan(t / 2)
//   polynomial    c1 s + c2 s^2 + .., s = 2 t / pi
#pragma once

#include <vector>

#include "data_refs/image_directions.h"

namespace skyfit::refs {

class Fisheye final : public ImageDirections {
 public:
  // From the facts of the image; what they leave out is as import_option_table() says. Throws
  // std::invalid_argument that begins with `source` when the projection is not stated or its
  // polynomial is not monotonic up to the horizon.
  Fisheye(const ImportOptions& facts, int width, int height, std::string_view source);

  std::optional<PixelView> view(double x_px, double y_px) const override;

 private:
  double radius_of(double zenith) const;  // relative to that of the horizon
  double slope_of(double zenith) const;   // d radius_of / d zenith
  double zenith_of(double radius) const;

  enum class Projection { kEquidistant, kEquisolid, kOrthographic, kStereographic, kPolynomial };
  Projection projection_;
  std::vector<double> polynomial_;
  double centre_x_, centre_y_, radius_px_, north_;
  bool east_is_left_;
};

}  // namespace skyfit::refs
