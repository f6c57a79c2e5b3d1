// SPDX-License-Identifier: Apache-2.0
// A thing to stand on the planet, from a Wavefront OBJ file. What is read: vertices, faces
// (polygons become triangles), normals, smoothing groups and the diffuse colour Kd of materials, a
// linear reflectance. Textures are not.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "model/tables/tables.h"
#include "render/render.h"

namespace skyfit {

struct ObjectVertex {
  glm::vec3 position;  // in the unit of the file, from its origin
  glm::vec3 normal;    // of length 1
  std::array<float, 4> reflectance;
};

struct ObjectMaterial {
  std::string name;
  NodeValues reflectance;
};

struct ObjectMesh {
  std::vector<ObjectVertex> vertices;
  // Three for each triangle, counterclockwise from outside; or, in a mesh of lines, two for each.
  std::vector<std::uint32_t> indices;
  std::vector<ObjectMaterial> materials;  // the last one, without a name, is that of faces without
  std::string warning;  // of materials that are in no file; empty: none is missing
};

// `reflectance`: where the file names no material, or one that is in no file. Normals are the
// file's; where it has none, those of the faces, smoothed within a smoothing group. Triangles
// without an area are left out. Throws std::runtime_error in one line as check_obj() does, and for
// a file of materials that the mesh may not name.
ObjectMesh read_object_mesh(const std::filesystem::path& file, double reflectance,
                            const ColorRule& rule, NamedFiles named = NamedFiles::kInItsFolder);

// From a mesh's axes and unit to the planet's axes (Ground) and metres.
glm::dmat3 planet_from_mesh(const PlacedMesh& mesh);

// In planet coordinates, m.
glm::dvec3 origin_of(const PlacedMesh& mesh, double bottom_radius_m);

}  // namespace skyfit
