// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/map_layout.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace skyfit {
namespace {

struct Face {
  glm::dvec3 out, right, down;
};

// Seen from outside; the last two adjoin the first.
const std::array<Face, 6> kCube = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                                    {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                                    {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}},
                                    {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                    {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
                                    {{0, 0, -1}, {0, 1, 0}, {-1, 0, 0}}}};

// `out`: the length of the direction along the face's axis.
MapPlace on_face(int face, const glm::dvec3& direction, double out, int rows) {
  const Face& axes = kCube[static_cast<std::size_t>(face)];
  const double half = 0.5 * rows;
  return {face, half * (glm::dot(direction, axes.right) / out + 1),
          half * (glm::dot(direction, axes.down) / out + 1), 1};
}

// 0 from one texel outside of the face, 1 from one texel inside.
double presence(double u, int rows) {
  const double inside = std::min(u, rows - u);
  const double t = std::clamp(0.5 * (inside + 1), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

MapPlaces EquirectangularLayout::places(const glm::dvec3& direction, int rows) {
  const double longitude = std::atan2(direction.y, direction.x);
  const double from_north = std::atan2(std::hypot(direction.x, direction.y), direction.z);
  MapPlaces places;
  places.place[0] = {0, (longitude / std::numbers::pi + 1) * rows,
                     from_north / std::numbers::pi * rows, 1};
  places.count = 1;
  return places;
}

MapPlaces CubeLayout::places(const glm::dvec3& direction, int rows) {
  MapPlaces places;
  double sum = 0;
  for (int face = 0; face < 6; ++face) {
    const double out = glm::dot(direction, kCube[static_cast<std::size_t>(face)].out);
    if (out < 0.3) continue;  // one texel beyond the corner of the smallest picture: 0.43
    MapPlace place = on_face(face, direction, out, rows);
    place.weight = presence(place.u, rows) * presence(place.v, rows);
    if (place.weight <= 0) continue;
    sum += place.weight;
    places.place[static_cast<std::size_t>(places.count++)] = place;
  }
  for (MapPlace& place : places.place) place.weight /= sum;
  return places;
}

MapPlace CubeLayout::place_of(const glm::dvec3& direction, int rows) {
  int best = 0;
  double most = 0;
  for (int face = 0; face < 6; ++face) {
    const double out = glm::dot(direction, kCube[static_cast<std::size_t>(face)].out);
    if (out <= most) continue;
    best = face;
    most = out;
  }
  return on_face(best, direction, most, rows);
}

glm::dvec3 CubeLayout::direction_of(int face, double u, double v, int rows) {
  const Face& axes = kCube[static_cast<std::size_t>(face)];
  return glm::normalize(axes.out + (2 * u / rows - 1) * axes.right +
                        (2 * v / rows - 1) * axes.down);
}

CubeLayout::Pair::Pair(double u, int rows) {
  const double place = std::clamp(u - 0.5, 0.0, rows - 1.0);
  low = std::min(static_cast<int>(place), rows - 2);
  part = place - low;
}

}  // namespace skyfit
