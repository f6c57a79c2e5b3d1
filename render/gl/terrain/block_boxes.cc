// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/block_boxes.h"

#include <array>

namespace skyfit {
namespace {

constexpr glm::dvec3 kDrawn(0.05, 0.8, 0.05), kOutside(0.9, 0.04, 0.04), kBehind(0.08, 0.15, 0.9);

// Corner i of a box is high along the axes whose bits i has.
glm::dvec3 corner(const Box& box, unsigned i) {
  return {(i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y,
          (i & 4) != 0 ? box.high.z : box.low.z};
}

void add_lines(const Box& box, const glm::dvec3& camera, const glm::dvec3& sun,
               const NodeValues& reflectance, ObjectMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  std::array<float, 4> shared{};
  for (std::size_t k = 0; k < 4; ++k) shared[k] = static_cast<float>(reflectance[k]);
  for (unsigned i = 0; i < 8; ++i)
    mesh.vertices.push_back({glm::vec3(1e-3 * (corner(box, i) - camera)), glm::vec3(sun), shared});
  for (std::uint32_t i = 0; i < 8; ++i)
    for (const std::uint32_t axis : {1u, 2u, 4u})
      if ((i & axis) == 0) mesh.indices.insert(mesh.indices.end(), {first + i, first + (i | axis)});
}

}  // namespace

glm::dvec3 level_color(int level) {
  constexpr std::array<glm::dvec3, 6> kColors = {{{0.9, 0.04, 0.04},
                                                  {0.9, 0.45, 0.02},
                                                  {0.8, 0.8, 0.05},
                                                  {0.05, 0.8, 0.05},
                                                  {0.05, 0.6, 0.8},
                                                  {0.3, 0.1, 0.9}}};
  return kColors[static_cast<std::size_t>(level) % kColors.size()];
}

ObjectMesh block_boxes(const BoxedBlocks& blocks, const TerrainView& view, double camera_m,
                       BlockColors colors, const glm::dvec3& sun, const ColorReflectance& color) {
  const glm::dmat3 site_from_planet = view.axes.site_from_planet();
  const glm::dvec3 camera(0, 0, view.radius_m + camera_m);
  ObjectMesh mesh;
  const auto add = [&](std::span<const MeasuredNode> nodes, const auto& color_of) {
    for (const auto& [block, heights] : nodes)
      add_lines(block_box(block, heights, site_from_planet, view.radius_m), camera, sun,
                color.at(color_of(block)), mesh);
  };
  const bool by_level = colors == BlockColors::kLevel;
  add(blocks.drawn,
      [&](const CubeBlock& block) { return by_level ? level_color(block.level) : kDrawn; });
  if (by_level) return mesh;
  add(blocks.selection.outside, [](const CubeBlock&) { return kOutside; });
  add(blocks.selection.behind, [](const CubeBlock&) { return kBehind; });
  return mesh;
}

}  // namespace skyfit
