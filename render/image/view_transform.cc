// SPDX-License-Identifier: Apache-2.0
#include "render/image/view_transform.h"

#include <glm/glm.hpp>

namespace skyfit::view_transform {

using glm::abs, glm::clamp, glm::exp, glm::greaterThan, glm::inverse, glm::length, glm::max,
    glm::min, glm::pow, glm::sign, glm::sqrt;
using vec2 = glm::dvec2;
#define BISECTIONS 24
#include "render/shaders/view_transform.glsl"
#undef BISECTIONS

}  // namespace skyfit::view_transform
