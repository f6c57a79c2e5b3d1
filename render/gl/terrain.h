// SPDX-License-Identifier: Apache-2.0
// The planet as one mesh around the camera's foot: rings of growing distance, sectors across the
// picture, so that triangles are about as large on screen near and far. Positions are relative to
// the camera, made in double precision; normals come from the neighbouring vertices.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/gl/relief.h"
#include "render/render.h"

namespace skyfit {

// Camera frame of render.h, z up and x toward the sun; y to the left; kilometres.
struct TerrainVertex {
  std::array<float, 3> position_km;
  std::array<float, 3> normal;
  std::array<float, 4> reflectance;
};

struct TerrainMesh {
  int rings = 0, sectors = 0;
  std::vector<TerrainVertex> vertices;  // [ring][sector]
  std::vector<std::uint32_t> indices;   // triangles
};

struct TerrainSettings {
  int rings = 1000, sectors = 900;
  int rings_all_round = 450,
      sectors_all_round = 2000;  // when the picture holds the nadir or the zenith
  double pixel_angle = 1e-3;     // rad; what is smaller than a pixel is left out
};

// Throws std::invalid_argument when the camera is below the ground.
TerrainMesh make_terrain(const Relief& relief, double bottom_radius_m, const Camera& camera,
                         double aspect, const TerrainSettings& settings = {});

}  // namespace skyfit
