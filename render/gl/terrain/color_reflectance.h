// SPDX-License-Identifier: Apache-2.0
// Reflectances at the four nodes of a colour rule from a colour. Of the spectra that have the
// colour in sunlight, the flattest; a colour that no spectrum within 0..1 at the nodes has becomes
// a near one.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "model/tables/tables.h"

namespace skyfit {

class ColorReflectance {
 public:
  explicit ColorReflectance(const ColorRule& rule);

  // `linear_srgb`: 0..1, a share of the colour of a white surface in the same light. Grey is flat.
  NodeValues at(const glm::dvec3& linear_srgb) const;

  // The inverse of at(): the colour of a surface in sunlight as a share of a white one's.
  glm::dvec3 linear_srgb(const NodeValues& reflectance) const;

 private:
  std::array<glm::dvec3, 4> color_of_node_;  // their sum is white, 1
  std::array<glm::dvec3, 4> node_of_color_;  // [node]: times the colour
  NodeValues unseen_;                        // the spectrum without a colour
};

}  // namespace skyfit
