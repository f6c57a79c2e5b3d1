// SPDX-License-Identifier: Apache-2.0
// The primaries in which a frame's light is given. All have the white of D65, light without colour:
// three equal channels of red, green and blue.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "model/photometry/photometry.h"

namespace skyfit {

enum class Primaries { kRec709, kRec2020, kXyz };  // Rec. 709 has those of sRGB

struct ColorSpace {
  std::string_view name;
  std::array<std::array<double, 3>, 3> from_xyz;  // row major
  std::array<double, 3> white;                    // D65 of luminance 1
  std::array<float, 8> chromaticities;            // x, y of the primaries and of the white
};

// ITU-R BT.709-6, BT.2020-2 and CIE 1931, with kLinearSrgbFromXyz's white. The chromaticities of
// XYZ are those that the OpenEXR library's documentation gives to it, with the white E.
inline constexpr std::array<ColorSpace, 3> kColorSpaces = {
    {{"rec709",
      kLinearSrgbFromXyz,
      {1, 1, 1},
      {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f}},
     {"rec2020",
      {{{1.7165107, -0.3556417, -0.2533455},
        {-0.6666930, 1.6165022, 0.0157688},
        {0.0176436, -0.0427798, 0.9423051}}},
      {1, 1, 1},
      {0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.3290f}},
     {"xyz",
      {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
      {0.95047, 1, 1.08883},
      {1, 0, 0, 1, 0, 0, 1.0f / 3, 1.0f / 3}}}};

constexpr const ColorSpace& color_space(Primaries primaries) {
  return kColorSpaces[static_cast<std::size_t>(primaries)];
}

}  // namespace skyfit
