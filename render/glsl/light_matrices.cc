// SPDX-License-Identifier: Apache-2.0
#include "render/glsl/light_matrices.h"

#include <cstddef>
#include <glm/glm.hpp>

namespace skyfit {
namespace {

glm::dmat4x3 xyz_from_nodes(const ColorRule& color) {
  glm::dmat4x3 matrix;
  for (int node = 0; node < 4; ++node) {
    for (int k = 0; k < 3; ++k)
      matrix[node][k] =
          color.xyz_from_nodes[static_cast<std::size_t>(k)][static_cast<std::size_t>(node)];
  }
  return matrix;
}

}  // namespace

std::array<double, 16> light_from_nodes(const ColorRule& color, const ColorSpace& space) {
  std::array<double, 16> columns{};
  for (std::size_t node = 0; node < 4; ++node) {
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 3; ++k)
        columns[4 * node + row] += space.from_xyz[row][k] * color.xyz_from_nodes[k][node];
    }
    columns[4 * node + 3] = color.xyz_from_nodes[1][node];
  }
  return columns;
}

std::array<double, 16> alike_nodes(const ColorRule& first, const ColorRule& other) {
  const glm::dmat4x3 xyz = xyz_from_nodes(first);
  // Moore and Penrose's inverse: the nodes of a colour whose sum of squares is least.
  const glm::dmat3x4 nodes_from_xyz = glm::transpose(xyz) * glm::inverse(xyz * glm::transpose(xyz));
  const glm::dmat4 matrix = nodes_from_xyz * xyz_from_nodes(other);
  std::array<double, 16> columns{};
  for (int node = 0; node < 4; ++node) {
    for (int k = 0; k < 4; ++k) columns[static_cast<std::size_t>(4 * node + k)] = matrix[node][k];
  }
  return columns;
}

}  // namespace skyfit
