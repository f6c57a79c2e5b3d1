// SPDX-License-Identifier: Apache-2.0
#include "render/gl/passes/object_pass.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "render/gl/context/buffers.h"
#include "render/gl/context/shader.h"
#include "render/gl/context/uniforms.h"
#include "render/gl/terrain/noise.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;

GlProgram object_program(const char* vertex, const char* fragment) {
  return build_program(
      std::array{ShaderStage{GL_VERTEX_SHADER, vertex}, ShaderStage{GL_FRAGMENT_SHADER, fragment}});
}

}  // namespace

ObjectPlace place_of(const PlacedMesh& mesh, const SiteAxes& axes, double radius_m,
                     double altitude_m) {
  const glm::dmat3 site_from_planet = axes.site_from_planet();
  const glm::dvec3 camera = (radius_m + altitude_m) * axes.z;
  return {1e-3 * site_from_planet * planet_from_mesh(mesh),
          1e-3 * (site_from_planet * (origin_of(mesh, radius_m) - camera))};
}

ObjectPlace place_of(const Moon& moon) {
  const double s = std::sin(moon.zenith);
  const glm::dvec3 direction(s * std::cos(moon.azimuth), -s * std::sin(moon.azimuth),
                             std::cos(moon.zenith));
  return {glm::dmat3(1e-3 * moon.radius_m), 1e-3 * moon.distance_m * direction};
}

ObjectMesh moon_mesh(const Moon& moon) {
  constexpr int kRows = 128, kColumns = 256;
  constexpr double kContrast = 0.9;
  ObjectMesh mesh;
  double sum = 0, area = 0;
  for (int row = 0; row <= kRows; ++row) {
    const double theta = kPi * row / kRows;
    for (int column = 0; column <= kColumns; ++column) {
      const double phi = 2 * kPi * (column % kColumns) / kColumns;
      const glm::dvec3 p(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                         std::cos(theta));
      const double plains = fractal_noise(p + glm::dvec3(3.1), 1.1, 0.05);
      const double light = 1 + kContrast * std::clamp(plains, -0.6, 0.6);
      sum += light * std::sin(theta);
      area += std::sin(theta);
      const auto reflectance = static_cast<float>(light);
      mesh.vertices.push_back(
          {glm::vec3(p), glm::vec3(p), {reflectance, reflectance, reflectance, reflectance}});
    }
  }
  const auto scale = static_cast<float>(moon.reflectance * area / sum);
  for (ObjectVertex& vertex : mesh.vertices) {
    for (float& value : vertex.reflectance) value = std::min(value * scale, 1.0f);
  }
  for (std::uint32_t row = 0; row < kRows; ++row) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const std::uint32_t a = row * (kColumns + 1) + column, b = a + kColumns + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  }
  return mesh;
}

ObjectPass::ObjectPass()
    : program_(object_program("render/shaders/object.vert", "render/shaders/object.frag")),
      depth_program_(
          object_program("render/shaders/object_depth.vert", "render/shaders/depth_only.frag")),
      layout_(make_vertex_array()) {
  const GLuint id = layout_.id();
  const auto attribute = [id](GLuint slot, int size, std::size_t offset) {
    glEnableVertexArrayAttrib(id, slot);
    glVertexArrayAttribFormat(id, slot, size, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(id, slot, 0);
  };
  attribute(0, 3, offsetof(ObjectVertex, position));
  attribute(1, 3, offsetof(ObjectVertex, normal));
  attribute(2, 4, offsetof(ObjectVertex, reflectance));
}

ObjectPass::Model ObjectPass::upload_mesh(const ObjectMesh& mesh) {
  return {upload(std::span<const ObjectVertex>(mesh.vertices)),
          upload(std::span<const std::uint32_t>(mesh.indices)),
          static_cast<int>(mesh.indices.size())};
}

void ObjectPass::submit(const Model& model) const {
  glVertexArrayVertexBuffer(layout_.id(), 0, model.vertices.id(), 0, sizeof(ObjectVertex));
  glVertexArrayElementBuffer(layout_.id(), model.indices.id());
  glBindVertexArray(layout_.id());
  glDrawElements(model.primitive, model.index_count, GL_UNSIGNED_INT, nullptr);
}

void ObjectPass::draw(const Model& model, const ObjectPlace& place, const Projection& projection,
                      const SiteAxes& axes) const {
  const Uniforms uniforms(program_.id());
  uniforms.set("site_from_object", glm::mat3(place.site_from_object));
  uniforms.set("offset_km", glm::vec3(place.offset_km));
  uniforms.set("view_from_site", projection.view_from_site);
  uniforms.set("planet_from_site", glm::mat3(axes.planet_from_site()));
  uniforms.set("tangent", projection.tangent);
  uniforms.set("near_km", projection.near_km);
  uniforms.set("eye_in_air", projection.eye_in_air);
  glUseProgram(program_.id());
  submit(model);
}

void ObjectPass::draw_depth(const Model& model, const ObjectPlace& place,
                            const glm::dmat4& clip_from_site) const {
  glm::dmat4 site_from_object(place.site_from_object);
  site_from_object[3] = glm::dvec4(place.offset_km, 1);
  Uniforms(depth_program_.id())
      .set("clip_from_object", glm::mat4(clip_from_site * site_from_object));
  glUseProgram(depth_program_.id());
  submit(model);
}

}  // namespace skyfit
