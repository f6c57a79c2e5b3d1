// SPDX-License-Identifier: Apache-2.0
// Things beside the ground in the G-buffer: meshes that stand on the planet, and the moon.
#pragma once

#include <vector>

#include "render/gl/context/objects.h"
#include "render/gl/passes/projection.h"
#include "render/gl/passes/site_axes.h"
#include "render/gl/terrain/object_mesh.h"

namespace skyfit {

// Where a thing stands in a frame: kilometres from the camera.
struct ObjectPlace {
  glm::dmat3 site_from_object;  // scales to kilometres
  glm::dvec3 offset_km;         // site axes
};

ObjectPlace place_of(const PlacedMesh& mesh, const SiteAxes& axes, double radius_m,
                     double altitude_m);
ObjectPlace place_of(const Moon& moon);

// A sphere of radius 1 with darker plains; the reflectance's mean is that of `moon`.
ObjectMesh moon_mesh(const Moon& moon);

class ObjectPass {
 public:
  ObjectPass();

  // A mesh in the device's memory.
  struct Model {
    GlBuffer vertices, indices;
    int index_count = 0;
    GLenum primitive = GL_TRIANGLES;
    std::int64_t triangles() const { return index_count / 3; }
  };
  static Model upload_mesh(const ObjectMesh& mesh);

  void draw(const Model& model, const ObjectPlace& place, const Projection& projection,
            const SiteAxes& axes) const;

  // `clip_from_site`: of positions relative to the camera, km.
  void draw_depth(const Model& model, const ObjectPlace& place,
                  const glm::dmat4& clip_from_site) const;

 private:
  void submit(const Model& model) const;

  GlProgram program_, depth_program_;
  GlVertexArray layout_;
};

}  // namespace skyfit
