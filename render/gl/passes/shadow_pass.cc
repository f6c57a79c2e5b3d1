// SPDX-License-Identifier: Apache-2.0
#include "render/gl/passes/shadow_pass.h"

#include <algorithm>
#include <cmath>

#include "render/gl/context/uniform_block.h"

namespace skyfit {
namespace {

constexpr int kSide = 2048;               // texels of a map
constexpr double kSmallestHalf = 600;     // m, of the finest map
constexpr double kHalfPerDistance = 1.5;  // and of one seen from high above
constexpr double kGrowth = 8;             // from map to map
constexpr double kBeyond = 60e3;          // m along the beam that a peak's shadow crosses

double texel_m(double half_m) { return 2 * half_m / kSide; }

}  // namespace

std::vector<ShadowView> shadow_views(const glm::dvec3& sun, double ground_distance_m,
                                     double highest_m) {
  const glm::dvec3 aside = std::abs(sun.z) < 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(aside, sun)), y = glm::cross(sun, x);
  std::vector<ShadowView> views;
  double half = std::max(kSmallestHalf, kHalfPerDistance * ground_distance_m);
  for (int i = 0; i < kShadowMaps && kShadowOffTexels * texel_m(half) < highest_m; ++i) {
    ShadowView& view = views.emplace_back();
    const double depth = 2 * half + kBeyond;
    const glm::dmat3 rows(x * (1e3 / half), y * (1e3 / half), -sun * (0.5e3 / depth));
    view.clip_from_site = glm::dmat4(glm::transpose(rows));
    view.clip_from_site[3] = glm::dvec4(0, 0, 0.5, 1);
    view.half_km = 1e-3 * half;
    for (const glm::dvec3& side : {x, -x, y, -y}) view.planes.emplace_back(side, half);
    view.planes.emplace_back(sun, depth);
    view.planes.emplace_back(-sun, depth);
    half *= kGrowth;
  }
  return views;
}

void ShadowPass::make_room(std::size_t maps) {
  if (maps <= room_) return;
  room_ = maps;
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &id);
  maps_ = GlTexture(id);
  glTextureStorage3D(id, 1, GL_DEPTH_COMPONENT32F, kSide, kSide, static_cast<GLsizei>(maps));
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTextureParameteri(id, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTextureParameteri(id, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
}

void ShadowPass::draw(std::size_t maps, const std::function<void(std::size_t)>& draw) {
  make_room(maps);
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  const GlFramebuffer target(id);
  glNamedFramebufferDrawBuffer(id, GL_NONE);
  glBindFramebuffer(GL_FRAMEBUFFER, id);
  glViewport(0, 0, kSide, kSide);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  // What stands nearer to the sun than the view begins casts its shadow too.
  glEnable(GL_DEPTH_CLAMP);
  const float farthest = 1;
  for (std::size_t i = 0; i < maps; ++i) {
    glNamedFramebufferTextureLayer(id, GL_DEPTH_ATTACHMENT, maps_.id(), 0, static_cast<GLint>(i));
    glClearNamedFramebufferfv(id, GL_DEPTH, 0, &farthest);
    draw(i);
  }
}

void ShadowPass::bind(std::span<const ShadowView> views, std::size_t suns, GLuint program,
                      GLuint unit, UniformBuffers& buffers) const {
  glBindTextureUnit(unit, maps_.id());
  // From -1..1 to texture coordinates.
  glm::dmat4 texture_from_clip(1);
  texture_from_clip[0][0] = texture_from_clip[1][1] = 0.5;
  texture_from_clip[3] = glm::dvec4(0.5, 0.5, 0, 1);
  const std::size_t count = views.size() / suns;
  std::vector<glm::mat4> matrices(suns * kShadowMaps);
  glm::vec4 offsets(0);
  for (std::size_t i = 0; i < views.size(); ++i)
    matrices[i] = glm::mat4(texture_from_clip * views[i].clip_from_site);
  for (std::size_t i = 0; i < count; ++i)
    offsets[static_cast<int>(i)] = static_cast<float>(kShadowOffTexels * texel_m(views[i].half_km));
  UniformBlock block(program, "Shadows");
  block.set("map_from_site", std::span<const glm::mat4>(matrices));
  block.set("shadow_offset_km", offsets);
  block.set("shadow_map_count", static_cast<double>(count));
  block.set("shadow_reach_km", views.back().half_km);
  block.bind(buffers);
}

}  // namespace skyfit
