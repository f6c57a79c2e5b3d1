// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>

#include "render/gl/buffers.h"
#include "render/gl/shader.h"
#include "render/gl/uniforms.h"

namespace skyfit {
namespace {

// Sizes of the materials' textures: one unit of a texture is this long.
constexpr double kNearPeriod = 9, kFarPeriod = 520;  // m

struct BlockInstance {
  glm::vec3 offset_km;  // of the block's centre from the camera, planet axes
  float morph_begin_km, morph_end_km;
  glm::vec3 near_phase, far_phase;  // texture coordinates of the block's centre, 0..1
};

struct DrawCommand {
  GLuint count, instances, first_index;
  GLint base_vertex;
  GLuint base_instance;
};

glm::vec3 phase(const glm::dvec3& position, double period) {
  return glm::vec3(glm::fract(position / period));
}

const std::vector<std::uint16_t>& indices() {
  static const std::vector<std::uint16_t> made = block_indices();
  return made;
}

GlProgram terrain_program(std::span<const std::string> defined) {
  return build_program(std::array{ShaderStage{GL_VERTEX_SHADER, "render/shaders/terrain.vert"},
                                  ShaderStage{GL_FRAGMENT_SHADER, "render/shaders/terrain.frag"}},
                       {}, defined);
}

// The distances between which a block becomes the coarser one: at the end the coarser one may be
// drawn, before the beginning the finer ones may.
std::pair<double, double> morph_range(const CubeBlock& block, const TerrainView& view) {
  if (block.level == 0) return {1e30, 2e30};
  const double end = view.split_ratio * block_arc_m(block.level - 1, view.radius_m);
  const double diagonals = 0.5 * (1 + 1.6 / view.split_ratio);
  return {std::max(0.75, diagonals) * end, end};
}

}  // namespace

TerrainPass::TerrainPass(const Ground& ground, double radius_m,
                         const std::filesystem::path& textures)
    : radius_m_(radius_m),
      store_(ground, radius_m),
      near_program_(terrain_program(std::array{std::string("NEAR")})),
      far_program_(terrain_program({})),
      depth_program_(build_program(
          std::array{ShaderStage{GL_VERTEX_SHADER, "render/shaders/terrain_depth.vert"},
                     ShaderStage{GL_FRAGMENT_SHADER, "render/shaders/depth_only.frag"}})),
      soil_(material_texture(load_material(Material::kSoil, textures))),
      rock_(material_texture(load_material(Material::kRock, textures))),
      indices_(upload(std::span(indices()))),
      layout_(make_vertex_array()) {
  const GLuint id = layout_.id();
  glVertexArrayElementBuffer(id, indices_.id());
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
  glVertexArrayBindingDivisor(id, 1, 1);
  attribute(6, 1, 3, GL_FLOAT, GL_FALSE, offsetof(BlockInstance, offset_km));
  attribute(7, 1, 2, GL_FLOAT, GL_FALSE, offsetof(BlockInstance, morph_begin_km));
  attribute(8, 1, 3, GL_FLOAT, GL_FALSE, offsetof(BlockInstance, far_phase));
  attribute(9, 1, 3, GL_FLOAT, GL_FALSE, offsetof(BlockInstance, near_phase));
  Uniforms(near_program_.id()).set("near_per_km", 1e3 / kNearPeriod);
  for (const GLuint program : {near_program_.id(), far_program_.id()})
    Uniforms(program).set("far_per_km", 1e3 / kFarPeriod);
}

TerrainDraw TerrainPass::prepare(std::span<const CubeBlock> blocks,
                                 const TerrainView& view) const {
  std::vector<BlockInstance> instances;
  std::vector<DrawCommand> commands;
  // Beyond this distance a texture of the finer scale is less than two samples long.
  const double near_m = kNearPeriod / (2 * view.sample_angle);
  int near_blocks = 0;
  for (const CubeBlock& block : blocks) {
    const glm::dvec3 centre = block_centre(block, radius_m_);
    const auto [begin, end] = morph_range(block, view);
    if (distance_to(block, store_.heights(block), view) < near_m) near_blocks = static_cast<int>(commands.size()) + 1;
    commands.push_back({static_cast<GLuint>(indices().size()), 1, 0, store_.first_vertex(block),
                        static_cast<GLuint>(instances.size())});
    instances.push_back({glm::vec3(1e-3 * (centre - view.camera())), static_cast<float>(1e-3 * begin),
                         static_cast<float>(1e-3 * end), phase(centre, kNearPeriod),
                         phase(centre, kFarPeriod)});
  }
  return {upload(std::span<const BlockInstance>(instances)),
          upload(std::span<const DrawCommand>(commands)), static_cast<int>(commands.size()),
          near_blocks};
}

std::int64_t TerrainPass::triangles(const TerrainDraw& draw) {
  return draw.blocks * static_cast<std::int64_t>(indices().size() / 3);
}

void TerrainPass::submit(const TerrainDraw& draw, int first, int count) const {
  if (count == 0) return;
  glVertexArrayVertexBuffer(layout_.id(), 0, store_.vertices(), 0, sizeof(BlockVertex));
  glVertexArrayVertexBuffer(layout_.id(), 1, draw.instances.id(), 0, sizeof(BlockInstance));
  glBindVertexArray(layout_.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, draw.commands.id());
  glEnable(GL_CULL_FACE);
  const auto* const begin = static_cast<const DrawCommand*>(nullptr) + first;
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, begin, count, 0);
  glDisable(GL_CULL_FACE);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
}

void TerrainPass::draw(const TerrainDraw& draw, const Projection& projection,
                       const SiteAxes& axes) const {
  const glm::dmat3 site_from_planet = axes.site_from_planet();
  glBindTextureUnit(0, soil_.id());
  glBindTextureUnit(1, rock_.id());
  const auto part = [&](GLuint program, int first, int count) {
    const Uniforms uniforms(program);
    uniforms.set("site_from_planet", glm::mat3(site_from_planet));
    uniforms.set("view_from_planet",
                 glm::mat3(glm::dmat3(projection.view_from_site) * site_from_planet));
    uniforms.set("tangent", projection.tangent);
    uniforms.set("near_km", projection.near_km);
    glUseProgram(program);
    submit(draw, first, count);
  };
  part(near_program_.id(), 0, draw.near_blocks);
  part(far_program_.id(), draw.near_blocks, draw.blocks - draw.near_blocks);
}

void TerrainPass::draw_depth(const TerrainDraw& draw, const glm::mat4& clip_from_planet) const {
  Uniforms(depth_program_.id()).set("clip_from_planet", clip_from_planet);
  glUseProgram(depth_program_.id());
  submit(draw, 0, draw.blocks);
}

}  // namespace skyfit
