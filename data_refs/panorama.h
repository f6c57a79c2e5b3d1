// SPDX-License-Identifier: Apache-2.0
// A latitude-longitude panorama: columns are azimuths, 360 deg over the width, rows are zenith
// angles, as many degrees to the pixel. North lies facts.north_deg right of the middle column; to
// the right of north lies east, or west where facts.east says "left". The horizon lies in the
// middle, at the lower edge of a panorama that is four times as wide as high, or at
// facts.centre_y_px.
#pragma once

#include "data_refs/image_directions.h"

namespace skyfit::refs {

class Panorama final : public ImageDirections {
 public:
  // Throws std::invalid_argument that begins with `source` when the image is neither twice nor four
  // times as wide as high and the horizon is not stated.
  Panorama(const ImportOptions& facts, int width, int height, std::string_view source);

  std::optional<PixelView> view(double x_px, double y_px) const override;

 private:
  double width_, horizon_, north_;
  bool east_is_left_;
};

}  // namespace skyfit::refs
