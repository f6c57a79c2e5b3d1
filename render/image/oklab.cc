// SPDX-License-Identifier: Apache-2.0
#include "render/image/oklab.h"

#include <cmath>
#include <glm/glm.hpp>

#include "render/image/color_matrices.h"

namespace skyfit {
namespace {

// Columns, as glm has them.
const glm::dmat3 kConesFromXyz(0.8189330101, 0.0329845436, 0.0482003018, 0.3618667424, 0.9293118715,
                               0.2643662691, -0.1288597137, 0.0361456387, 0.6338517070);
const glm::dmat3 kLabFromRoots(0.2104542553, 1.9779984951, 0.0259040371, 0.7936177850,
                               -2.4285922050, 0.7827717662, -0.0040720468, 0.4505937099,
                               -0.8086757660);

}  // namespace

Oklab oklab_of(const ColorChannels& color, const ColorSpace& space) {
  const glm::dvec3 cones = kConesFromXyz * xyz_of(color, space);
  const glm::dvec3 lab =
      kLabFromRoots * glm::dvec3(std::cbrt(cones.x), std::cbrt(cones.y), std::cbrt(cones.z));
  return {lab.x, lab.y, lab.z};
}

ColorChannels from_oklab(const Oklab& lab, const ColorSpace& space) {
  static const glm::dmat3 roots_from_lab = glm::inverse(kLabFromRoots);
  static const glm::dmat3 xyz_from_cones = glm::inverse(kConesFromXyz);
  const glm::dvec3 roots = roots_from_lab * glm::dvec3(lab.l, lab.a, lab.b);
  return from_xyz(xyz_from_cones * (roots * roots * roots), space);
}

}  // namespace skyfit
