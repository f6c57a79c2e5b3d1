// SPDX-License-Identifier: Apache-2.0
#include "render/image/gamut.h"

#include <algorithm>
#include <glm/glm.hpp>

namespace skyfit {
namespace {

glm::dmat3 matrix_of(const ColorSpace& space) {
  glm::dmat3 from_xyz;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      from_xyz[column][row] =
          space.from_xyz[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    }
  }
  return from_xyz;
}

glm::dvec3 xyz_of(const ColorChannels& color, const ColorSpace& space) {
  return glm::inverse(matrix_of(space)) * glm::dvec3(color[0], color[1], color[2]);
}

}  // namespace

double luminance_of(const ColorChannels& color, const ColorSpace& space) {
  return xyz_of(color, space).y;
}

ColorChannels converted(const ColorChannels& color, const ColorSpace& from, const ColorSpace& to) {
  if (from.name == to.name) return color;
  const glm::dvec3 made = matrix_of(to) * xyz_of(color, from);
  return {made.x, made.y, made.z};
}

ColorChannels into_gamut(const ColorChannels& color, double luminance, const ColorChannels& white) {
  if (std::ranges::min(color) >= 0) return color;
  if (!(luminance > 0)) return {};
  double saturation = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double grey = luminance * white[k];
    if (color[k] < 0) saturation = std::min(saturation, grey / (grey - color[k]));
  }
  ColorChannels mapped;
  for (std::size_t k = 0; k < 3; ++k) {
    const double grey = luminance * white[k];
    mapped[k] = std::max(grey + saturation * (color[k] - grey), 0.0);  // 0 but for rounding
  }
  return mapped;
}

}  // namespace skyfit
