// SPDX-License-Identifier: Apache-2.0
#include "render/image/gamut.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "render/image/color_matrices.h"
#include "render/image/oklab.h"

namespace skyfit {
namespace {

constexpr int kHalvings = 24;

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

// The largest t in 0..1 for which `color_at(t)` is `good`; at 0 it is.
template <class ColorAt, class Good>
ColorChannels last_good(ColorAt&& color_at, Good&& good) {
  double low = 0, high = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (good(color_at(middle)) ? low : high) = middle;
  }
  return color_at(low);
}

bool in_display(const ColorChannels& color) {
  return std::ranges::min(color) >= 0 && std::ranges::max(color) <= 1;
}

}  // namespace

glm::dvec3 xyz_of(const ColorChannels& color, const ColorSpace& space) {
  return matrices_of(space).xyz_from * glm::dvec3(color[0], color[1], color[2]);
}

ColorChannels from_xyz(const glm::dvec3& xyz, const ColorSpace& space) {
  const glm::dvec3 made = matrices_of(space).from_xyz * xyz;
  return {made.x, made.y, made.z};
}

double luminance_of(const ColorChannels& color, const ColorSpace& space) {
  return xyz_of(color, space).y;
}

ColorChannels converted(const ColorChannels& color, const ColorSpace& from, const ColorSpace& to) {
  return &from == &to ? color : from_xyz(xyz_of(color, from), to);
}

ColorChannels into_gamut(const ColorChannels& color, double luminance, const ColorSpace& space) {
  if (std::ranges::min(color) >= 0) return color;
  if (!(luminance > 0)) return {};
  const Oklab lab = oklab_of(color, space);
  ColorChannels mapped = last_good(
      [&](double t) {
        return from_oklab({1, t * lab.a / lab.l, t * lab.b / lab.l}, space);
      },
      [](const ColorChannels& c) { return std::ranges::min(c) >= 0; });
  *std::ranges::min_element(mapped) = 0;  // but for rounding
  const double factor = luminance / luminance_of(mapped, space);
  for (double& channel : mapped) channel *= factor;
  return mapped;
}

ColorChannels into_display(const ColorChannels& color) {
  // Between the chroma, which 0 would keep, and the lightness.
  constexpr double kKeepChroma = 0.05;
  if (in_display(color)) return color;
  const ColorSpace& display = color_space(Primaries::kRec709);
  const Oklab lab = oklab_of(color, display);
  const double off = lab.l - 0.5;
  const double e = 0.5 + std::abs(off) + kKeepChroma * std::hypot(lab.a, lab.b);
  const double step = 0.5 * (e - std::sqrt(std::max(e * e - 2 * std::abs(off), 0.0)));
  const double grey = std::clamp(0.5 + std::copysign(step, off), 0.0, 1.0);
  ColorChannels mapped = last_good(
      [&](double t) {
        return from_oklab({grey + t * (lab.l - grey), t * lab.a, t * lab.b}, display);
      },
      in_display);
  for (double& channel : mapped) channel = std::clamp(channel, 0.0, 1.0);  // but for rounding
  return mapped;
}

}  // namespace skyfit
