// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/color_reflectance.h"

#include <algorithm>
#include <glm/glm.hpp>

namespace skyfit {
namespace {

// sum of a'[k] b'[k], where ' is the difference between neighbouring nodes.
template <class A>
A bend(const std::array<A, 4>& a, const NodeValues& b) {
  A sum{};
  for (std::size_t k = 0; k < 3; ++k) sum += (a[k + 1] - a[k]) * (b[k + 1] - b[k]);
  return sum;
}

}  // namespace

ColorReflectance::ColorReflectance(const ColorRule& rule) {
  glm::dvec3 white(0);
  for (std::size_t k = 0; k < 4; ++k) {
    glm::dvec3& color = color_of_node_[k];
    color = glm::dvec3(0);
    for (int channel = 0; channel < 3; ++channel) {
      for (std::size_t c = 0; c < 3; ++c) {
        color[channel] +=
            kLinearSrgbFromXyz[static_cast<std::size_t>(channel)][c] * rule.xyz_from_nodes[c][k];
      }
    }
    white += color;
  }
  for (glm::dvec3& color : color_of_node_) color /= white;

  // Three equations for four nodes: the solution of least norm, plus a multiple of what they do not
  // see that makes the sum of squared differences least.
  const auto& a = color_of_node_;
  glm::dmat3 normal(0);
  for (const glm::dvec3& color : a) normal += glm::outerProduct(color, color);
  const glm::dmat3 inverse = glm::inverse(normal);
  for (std::size_t k = 0; k < 4; ++k) node_of_color_[k] = inverse * a[k];
  unseen_ = {glm::dot(a[1], glm::cross(a[2], a[3])), -glm::dot(a[0], glm::cross(a[2], a[3])),
             glm::dot(a[0], glm::cross(a[1], a[3])), -glm::dot(a[0], glm::cross(a[1], a[2]))};
  const glm::dvec3 amount = bend(node_of_color_, unseen_) / bend(unseen_, unseen_);
  for (std::size_t k = 0; k < 4; ++k) node_of_color_[k] -= unseen_[k] * amount;
}

NodeValues ColorReflectance::at(const glm::dvec3& linear_srgb) const {
  NodeValues value;
  for (std::size_t k = 0; k < 4; ++k) value[k] = glm::dot(node_of_color_[k], linear_srgb);
  // Less flat where that brings all four into 0..1 without a change of colour.
  double least = -1e9, most = 1e9;
  for (std::size_t k = 0; k < 4; ++k) {
    const double to_zero = -value[k] / unseen_[k], to_one = (1 - value[k]) / unseen_[k];
    least = std::max(least, std::min(to_zero, to_one));
    most = std::min(most, std::max(to_zero, to_one));
  }
  const double amount = least <= most ? std::clamp(0.0, least, most) : 0.5 * (least + most);
  for (std::size_t k = 0; k < 4; ++k)
    value[k] = std::clamp(value[k] + amount * unseen_[k], 0.0, 1.0);
  return value;
}

glm::dvec3 ColorReflectance::linear_srgb(const NodeValues& reflectance) const {
  glm::dvec3 color(0);
  for (std::size_t k = 0; k < 4; ++k) color += reflectance[k] * color_of_node_[k];
  return color;
}

}  // namespace skyfit
