// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/block_boxes.h"

#include <algorithm>
#include <array>

namespace skyfit {
namespace {

constexpr glm::dvec3 kDrawn(0.05, 0.8, 0.05), kOutside(0.9, 0.04, 0.04), kBehind(0.35, 0.5, 1.0);

// Corner i of a box is high along the axes whose bits i has.
glm::dvec3 corner(const Box& box, unsigned i) {
  return {(i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y,
          (i & 4) != 0 ? box.high.z : box.low.z};
}

// Of a line, so that what the sphere of the bottom radius hides can be left out: no ground may have
// been drawn before it.
constexpr std::uint32_t kParts = 16;

struct Lines {
  double radius_m;
  glm::dvec3 camera, sun;
  ObjectMesh mesh;

  void add(const Box& box, const NodeValues& reflectance) {
    for (unsigned i = 0; i < 8; ++i)
      for (const unsigned axis : {1u, 2u, 4u})
        if ((i & axis) == 0) add(corner(box, i), corner(box, i | axis), reflectance);
  }

 private:
  // The way from the camera stays outside of the sphere.
  bool is_seen(const glm::dvec3& point) const {
    const glm::dvec3 way = point - camera;
    const double share = std::clamp(-glm::dot(camera, way) / glm::dot(way, way), 0.0, 1.0);
    return glm::length(camera + share * way) >= radius_m;
  }

  void add(const glm::dvec3& from, const glm::dvec3& to, const NodeValues& reflectance) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    std::array<float, 4> shared{};
    for (std::size_t k = 0; k < 4; ++k) shared[k] = static_cast<float>(reflectance[k]);
    bool was_seen = false;
    for (std::uint32_t part = 0; part <= kParts; ++part) {
      const glm::dvec3 point = glm::mix(from, to, part / static_cast<double>(kParts));
      const bool seen = is_seen(point);
      mesh.vertices.push_back({glm::vec3(1e-3 * (point - camera)), glm::vec3(sun), shared});
      if (seen && was_seen)
        mesh.indices.insert(mesh.indices.end(), {first + part - 1, first + part});
      was_seen = seen;
    }
  }
};

}  // namespace

glm::dvec3 level_color(int level) {
  constexpr std::array<glm::dvec3, 6> kColors = {{{0.9, 0.04, 0.04},
                                                  {0.9, 0.45, 0.02},
                                                  {0.8, 0.8, 0.05},
                                                  {0.05, 0.8, 0.05},
                                                  {0.05, 0.6, 0.8},
                                                  {0.55, 0.3, 1.0}}};
  return kColors[static_cast<std::size_t>(level) % kColors.size()];
}

ObjectMesh block_boxes(const BoxedBlocks& blocks, const TerrainView& view, double camera_m,
                       BlockColors colors, const glm::dvec3& sun, const ColorReflectance& color) {
  const glm::dmat3 site_from_planet = view.axes.site_from_planet();
  Lines lines{view.radius_m, {0, 0, view.radius_m + camera_m}, sun, {}};
  const auto add = [&](std::span<const MeasuredNode> nodes, const auto& color_of) {
    for (const auto& [block, heights] : nodes)
      lines.add(block_box(block, heights, site_from_planet, view.radius_m),
                color.at(color_of(block)));
  };
  const bool by_level = colors == BlockColors::kLevel;
  add(blocks.drawn,
      [&](const CubeBlock& block) { return by_level ? level_color(block.level) : kDrawn; });
  if (by_level) return lines.mesh;
  add(blocks.selection.outside, [](const CubeBlock&) { return kOutside; });
  add(blocks.selection.behind, [](const CubeBlock&) { return kBehind; });
  return lines.mesh;
}

}  // namespace skyfit
