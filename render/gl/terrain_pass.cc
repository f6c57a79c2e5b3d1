// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>

#include "render/gl/shader.h"
#include "render/gl/uniforms.h"
#include "render/gl/view_basis.h"

namespace skyfit {
namespace {

template <class T>
GlBuffer upload(const std::vector<T>& data) {
  GLuint id = 0;
  glCreateBuffers(1, &id);
  glNamedBufferStorage(id, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), 0);
  return GlBuffer(id);
}

}  // namespace

Projection make_projection(const Camera& camera, double aspect) {
  const ViewBasis basis = view_basis(camera);
  const double tall = std::tan(0.5 * camera.vertical_fov);
  // Nothing is nearer than the ground below, of which the picture sees at least a quarter of the
  // height away.
  const double near_m = std::min(0.25 * camera.altitude_m, 1e3);
  return {glm::mat3(glm::transpose(glm::dmat3(basis.right, basis.up, -basis.forward))),
          glm::vec2(tall * aspect, tall), static_cast<float>(1e-3 * near_m)};
}

TerrainPass::TerrainPass(const TerrainMesh& mesh)
    : program_(build_program(
          std::array{ShaderStage{GL_VERTEX_SHADER, "render/shaders/terrain.vert"},
                     ShaderStage{GL_FRAGMENT_SHADER, "render/shaders/terrain.frag"}})),
      vertices_(upload(mesh.vertices)),
      indices_(upload(mesh.indices)),
      index_count_(static_cast<std::int64_t>(mesh.indices.size())) {
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  layout_ = GlVertexArray(id);
  glVertexArrayVertexBuffer(id, 0, vertices_.id(), 0, sizeof(TerrainVertex));
  glVertexArrayElementBuffer(id, indices_.id());
  const auto attribute = [id](GLuint slot, int size, std::size_t offset) {
    glEnableVertexArrayAttrib(id, slot);
    glVertexArrayAttribFormat(id, slot, size, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(id, slot, 0);
  };
  attribute(0, 3, offsetof(TerrainVertex, position_km));
  attribute(1, 3, offsetof(TerrainVertex, normal));
  attribute(2, 4, offsetof(TerrainVertex, reflectance));
}

void TerrainPass::draw(const Projection& projection) const {
  const Uniforms uniforms(program_.id());
  uniforms.set("view_from_site", projection.view_from_site);
  uniforms.set("tangent", projection.tangent);
  uniforms.set("near_km", projection.near_km);
  const std::array<float, 4> nothing{};
  const float far_depth = 0;
  glClearBufferfv(GL_COLOR, 0, nothing.data());
  glClearBufferfv(GL_COLOR, 1, nothing.data());
  glClearBufferfv(GL_DEPTH, 0, &far_depth);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glUseProgram(program_.id());
  glBindVertexArray(layout_.id());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(index_count_), GL_UNSIGNED_INT, nullptr);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace skyfit
