// SPDX-License-Identifier: Apache-2.0
// The terrain on the GPU and the pass that draws it into the G-buffer: writes colour, normal and
// reflectance, depth.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "render/gl/objects.h"
#include "render/gl/terrain.h"

namespace skyfit {

// What both passes know of the camera. Infinite reversed projection: depth = near / distance along
// the view axis.
struct Projection {
  glm::mat3 view_from_site;
  glm::vec2 tangent;  // of half the field of view
  float near_km;
};

Projection make_projection(const Camera& camera, double aspect);

class TerrainPass {
 public:
  explicit TerrainPass(const TerrainMesh& mesh);
  void draw(const Projection& projection) const;
  std::int64_t triangles() const { return index_count_ / 3; }

 private:
  GlProgram program_;
  GlBuffer vertices_, indices_;
  GlVertexArray layout_;
  std::int64_t index_count_ = 0;
};

}  // namespace skyfit
