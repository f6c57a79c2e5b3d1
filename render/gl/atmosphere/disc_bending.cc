// SPDX-License-Identifier: Apache-2.0
#include "render/gl/atmosphere/disc_bending.h"

#include <algorithm>
#include <cmath>

namespace skyfit {

std::array<glm::vec4, 2> disc_bending(const Refraction& refraction, double height_m,
                                      double true_zenith, double radius) {
  constexpr double kNone = 1e-12;  // what no bending at all counts as, radians
  const double height = refraction.refractive_height(height_m);
  const auto seen = [&](double zenith) { return refraction.apparent_zenith(height, zenith); };
  const auto logarithm = [&](double zenith) {
    return std::log(std::max(refraction.bending(height, zenith), kNone));
  };
  const double middle = seen(true_zenith), up = seen(true_zenith - radius) - middle,
               down = seen(true_zenith + radius) - middle, at = logarithm(middle),
               to_up = (logarithm(middle + up) - at) / up,
               to_down = (logarithm(middle + down) - at) / down,
               bend = (to_down - to_up) / (down - up);
  constexpr double kBeyond = 1.5;
  return {glm::dvec4(middle, at, to_up - bend * up, bend),
          glm::dvec4(kBeyond * up, kBeyond * down, 0, 0)};
}

}  // namespace skyfit
