// SPDX-License-Identifier: Apache-2.0
// The irradiances of one observer under one sun, and their names in options and tables.
#pragma once

#include <array>
#include <string_view>

namespace skyfit {

enum Irradiance : int {
  kDirectNormal,       // the sun's beam on a surface that faces it
  kDirectHorizontal,   // direct normal * cos(sun zenith), 0 when the sun is down
  kDiffuseHorizontal,  // sky on a horizontal surface that faces up
  kGlobalHorizontal,   // direct + diffuse
};
inline constexpr int kIrradianceCount = 4;
inline constexpr std::array<std::string_view, kIrradianceCount> kIrradianceNames = {
    "direct_normal", "direct_horizontal", "diffuse_horizontal", "global_horizontal"};

}  // namespace skyfit
