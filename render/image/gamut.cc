// SPDX-License-Identifier: Apache-2.0
#include "render/image/gamut.h"

#include <glm/glm.hpp>

#include "render/image/color_matrices.h"
#include "render/image/oklab.h"
#include "render/image/view_transform.h"

namespace skyfit {
namespace {

struct Matrices {
  glm::dmat3 from_xyz, xyz_from;
};

const Matrices& matrices_of(const ColorSpace& space) {
  static const auto all = [] {
    std::array<Matrices, kColorSpaces.size()> made;
    for (std::size_t i = 0; i < made.size(); ++i) {
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
          made[i].from_xyz[column][row] =
              kColorSpaces[i]
                  .from_xyz[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        }
      }
      made[i].xyz_from = glm::inverse(made[i].from_xyz);
    }
    return made;
  }();
  return all[static_cast<std::size_t>(&space - kColorSpaces.data())];
}

glm::dvec3 vector(const ColorChannels& color) { return {color[0], color[1], color[2]}; }
ColorChannels channels(const glm::dvec3& color) { return {color.x, color.y, color.z}; }

}  // namespace

glm::dvec3 xyz_of(const ColorChannels& color, const ColorSpace& space) {
  return matrices_of(space).xyz_from * vector(color);
}

ColorChannels from_xyz(const glm::dvec3& xyz, const ColorSpace& space) {
  return channels(matrices_of(space).from_xyz * xyz);
}

double luminance_of(const ColorChannels& color, const ColorSpace& space) {
  return xyz_of(color, space).y;
}

ColorChannels converted(const ColorChannels& color, const ColorSpace& from, const ColorSpace& to) {
  return &from == &to ? color : from_xyz(xyz_of(color, from), to);
}

Oklab oklab_of(const ColorChannels& color, const ColorSpace& space) {
  const glm::dvec3 lab = view_transform::oklab_from(vector(color), matrices_of(space).xyz_from);
  return {lab.x, lab.y, lab.z};
}

ColorChannels from_oklab(const Oklab& lab, const ColorSpace& space) {
  return channels(
      view_transform::color_from_oklab({lab.l, lab.a, lab.b}, matrices_of(space).from_xyz));
}

ColorChannels into_gamut(const ColorChannels& color, double luminance, const ColorSpace& space) {
  const Matrices& m = matrices_of(space);
  return channels(view_transform::gamut_mapped(vector(color), luminance, m.from_xyz, m.xyz_from));
}

ColorChannels into_display(const ColorChannels& color) {
  const Matrices& m = matrices_of(color_space(Primaries::kRec709));
  return channels(view_transform::display_mapped(vector(color), m.from_xyz, m.xyz_from));
}

ColorChannels displayed(const ColorChannels& color, double luminance, double curved_luminance) {
  const Matrices& m = matrices_of(color_space(Primaries::kRec709));
  return channels(view_transform::displayed(vector(color), luminance, curved_luminance, m.from_xyz,
                                            m.xyz_from));
}

}  // namespace skyfit
