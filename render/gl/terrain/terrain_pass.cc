// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/terrain_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <limits>

#include "render/gl/context/buffers.h"
#include "render/gl/context/shader.h"
#include "render/gl/context/uniforms.h"

namespace skyfit {
namespace {

struct BlockInstance {
  glm::vec3 offset_km;  // of the block's centre from the camera, planet axes
  float morph_begin_km, morph_end_km;
};

struct DrawCommand {
  GLuint count, instances, first_index;
  GLint base_vertex;
  GLuint base_instance;
};

GlProgram terrain_program(const char* vertex, const char* fragment) {
  return build_program(
      std::array{ShaderStage{GL_VERTEX_SHADER, vertex}, ShaderStage{GL_FRAGMENT_SHADER, fragment}});
}

// Of a block, in arcs: sqrt(2), and more where it is steep.
constexpr double kDiagonal = 1.75;

// The distances between which a block becomes the coarser one: at the end the coarser one may be
// drawn, before the beginning the finer ones may.
std::pair<double, double> morph_range(const CubeBlock& block, const TerrainView& view) {
  if (block.level == 0) return {1e30, 2e30};
  const double end = view.split_ratio * block_arc_m(block.level - 1, view.radius_m);
  const double diagonals = 0.5 * (1 + kDiagonal / view.split_ratio);
  return {std::max(0.75, diagonals) * end, end};
}

// The numbers of a block's patches, as far as whole rows and columns can be in that order.
std::array<std::size_t, kPatches> near_to_far(const CubeBlock& block, const TerrainView& view) {
  const auto toward = [&](double u, double v) {
    return glm::dot(view.camera(), block_direction(block, u, v));
  };
  const bool from_right = toward(1, 0.5) > toward(0, 0.5);
  const bool from_above = toward(0.5, 1) > toward(0.5, 0);
  constexpr std::size_t kLast = kPatchesPerSide - 1;
  std::array<std::size_t, kPatches> patches{};
  for (std::size_t i = 0; i < kPatches; ++i) {
    const std::size_t column = i % kPatchesPerSide, row = i / kPatchesPerSide;
    patches[i] =
        (from_above ? kLast - row : row) * kPatchesPerSide + (from_right ? kLast - column : column);
  }
  return patches;
}

}  // namespace

TerrainPass::TerrainPass(const Ground& ground, double radius_m, ContentCache* cache)
    : radius_m_(radius_m),
      water_reflectance_(ground.water_reflectance()),
      store_(ground, radius_m, cache),
      program_(terrain_program("render/shaders/terrain.vert", "render/shaders/terrain.frag")),
      depth_program_(
          terrain_program("render/shaders/terrain_depth.vert", "render/shaders/depth_only.frag")),
      layout_(make_vertex_array()) {
  const GLuint id = layout_.id();
  const auto attribute = [id](GLuint slot, GLuint binding, int size, GLenum type, GLboolean normal,
                              std::size_t offset) {
    glEnableVertexArrayAttrib(id, slot);
    glVertexArrayAttribFormat(id, slot, size, type, normal, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(id, slot, binding);
  };
  attribute(0, 0, 3, GL_FLOAT, GL_FALSE, offsetof(BlockVertex, fine_km));
  attribute(1, 0, 3, GL_FLOAT, GL_FALSE, offsetof(BlockVertex, coarse_km));
  attribute(2, 0, 4, GL_SHORT, GL_TRUE, offsetof(BlockVertex, fine_normal));
  attribute(3, 0, 4, GL_SHORT, GL_TRUE, offsetof(BlockVertex, coarse_normal));
  attribute(4, 0, 4, GL_UNSIGNED_SHORT, GL_TRUE, offsetof(BlockVertex, fine_reflectance));
  attribute(5, 0, 4, GL_UNSIGNED_SHORT, GL_TRUE, offsetof(BlockVertex, coarse_reflectance));
  attribute(8, 0, 2, GL_SHORT, GL_TRUE, offsetof(BlockVertex, above_water));
  glVertexArrayBindingDivisor(id, 1, 1);
  attribute(6, 1, 3, GL_FLOAT, GL_FALSE, offsetof(BlockInstance, offset_km));
  attribute(7, 1, 2, GL_FLOAT, GL_FALSE, offsetof(BlockInstance, morph_begin_km));
}

void TerrainPass::prepare(std::span<const CubeBlock> blocks, const TerrainView& view,
                          double camera_m, TerrainDraw& draw) const {
  const glm::dvec3 camera = (view.radius_m + camera_m) * view.axes.z;
  draw.eye_km = glm::vec3(1e-3 * (view.camera() - camera));
  std::vector<MeasuredBlock> measured;
  for (const CubeBlock& block : blocks)
    measured.push_back({block, store_.heights(block), morph_range(block, view).second});
  const std::vector<BlockPatches> chosen = choose_patches(view, measured);
  draw.seen.clear();
  draw.hidden = 0;
  draw.triangles = 0;
  draw.nearest_m = std::numeric_limits<double>::infinity();
  std::vector<BlockInstance> instances;
  std::vector<DrawCommand> commands;
  std::vector<std::uint16_t> indices;
  indices.reserve(blocks.size() * block_indices().patches[kWholePatch].back());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto& [seen, coarse, nearest_m] = chosen[i];
    if (seen.none()) {
      ++draw.hidden;
      continue;
    }
    draw.seen.push_back(blocks[i]);
    draw.nearest_m = std::min(draw.nearest_m, nearest_m);
    commands.push_back({0, 1, static_cast<GLuint>(indices.size()), store_.first_vertex(blocks[i]),
                        static_cast<GLuint>(instances.size())});
    for (const std::size_t patch : near_to_far(blocks[i], view)) {
      if (!seen[patch]) continue;
      const auto& places = block_indices().patches[shape_of(patch, coarse)];
      const auto& all = block_indices().indices;
      indices.insert(indices.end(), all.begin() + places[patch], all.begin() + places[patch + 1]);
      commands.back().count += places[patch + 1] - places[patch];
      draw.triangles += (places[patch + 1] - places[patch]) / 3;
    }
    const glm::dvec3 centre = block_centre(blocks[i], radius_m_);
    const auto [morph_begin, morph_end] = morph_range(blocks[i], view);
    instances.push_back({glm::vec3(1e-3 * (centre - camera)),
                         static_cast<float>(1e-3 * morph_begin),
                         static_cast<float>(1e-3 * morph_end)});
  }
  if (camera_m != view.altitude_m) draw.nearest_m = 0;
  refill(draw.instances, std::span<const BlockInstance>(instances));
  refill(draw.indices, std::span<const std::uint16_t>(indices));
  refill(draw.commands, std::span<const DrawCommand>(commands));
  draw.blocks = static_cast<int>(commands.size());
}

void TerrainPass::submit(const TerrainDraw& draw) const {
  if (draw.blocks == 0) return;
  glVertexArrayVertexBuffer(layout_.id(), 0, store_.vertices(), 0, sizeof(BlockVertex));
  glVertexArrayVertexBuffer(layout_.id(), 1, draw.instances.id(), 0, sizeof(BlockInstance));
  glVertexArrayElementBuffer(layout_.id(), draw.indices.id());
  glBindVertexArray(layout_.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, draw.commands.id());
  glEnable(GL_CULL_FACE);
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, nullptr, draw.blocks, 0);
  glDisable(GL_CULL_FACE);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
}

void TerrainPass::draw(const TerrainDraw& draw, const Projection& projection, const SiteAxes& axes,
                       bool wireframe) const {
  const glm::dmat3 view_from_planet =
      glm::dmat3(projection.view_from_site) * axes.site_from_planet();
  const glm::dmat3 clip_from_view(1 / projection.tangent.x, 0, 0,  //
                                  0, 1 / projection.tangent.y, 0,  //
                                  0, 0, -1);
  const Uniforms uniforms(program_.id());
  uniforms.set("clip_from_planet", glm::mat3(clip_from_view * view_from_planet));
  uniforms.set("near_km", projection.near_km);
  uniforms.set("eye_in_air", projection.eye_in_air);
  uniforms.set("up", glm::vec3(axes.z));
  uniforms.set("eye_km", draw.eye_km);
  const NodeValues water = water_reflectance_.value_or(NodeValues{});
  uniforms.set("water_reflectance", glm::vec4(water[0], water[1], water[2], water[3]));
  uniforms.set("own_reflectance_of_water", water_reflectance_ ? 1.0f : 0.0f);
  glUseProgram(program_.id());
  if (wireframe) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  submit(draw);
  if (wireframe) glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void TerrainPass::draw_depth(const TerrainDraw& draw, const glm::mat4& clip_from_planet) const {
  const Uniforms uniforms(depth_program_.id());
  uniforms.set("clip_from_planet", clip_from_planet);
  uniforms.set("eye_km", draw.eye_km);
  glUseProgram(depth_program_.id());
  submit(draw);
}

}  // namespace skyfit
