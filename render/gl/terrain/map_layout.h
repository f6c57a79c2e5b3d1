// SPDX-License-Identifier: Apache-2.0
// Where a direction lies in a picture of a planet (map_file.h), and which texel lies beyond an
// edge.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace skyfit {

// In texels from the upper left corner of a face; the centre of the first is at (0.5, 0.5).
struct MapPlace {
  int face;
  double u, v;
  double weight;  // those of all the places of a direction add up to 1
};

struct MapPlaces {
  std::array<MapPlace, 3> place;
  int count = 0;
};

struct EquirectangularLayout {
  static constexpr int kFaces = 1;
  static constexpr int kColumnsPerRow = 2;
  static constexpr double kAngle = 3.14159265358979323846;  // of the rows

  static MapPlaces places(const glm::dvec3& direction, int rows);

  // Calls sum(face, column, row, weight) for the texels that stand for one at most two beyond an
  // edge: once around the planet, or across the pole.
  template <class F>
  static void texels(int face, int column, int row, int rows, F&& sum) {
    if (row < 0 || row >= rows) {
      row = row < 0 ? -1 - row : 2 * rows - 1 - row;
      column += rows;
    }
    const int columns = 2 * rows;
    sum(face, column < 0 ? column + columns : column % columns, row, 1.0);
  }
};

struct CubeLayout {
  static constexpr int kFaces = 6;
  static constexpr int kColumnsPerRow = 1;
  static constexpr double kAngle = 0.5 * 3.14159265358979323846;

  // Up to three: near an edge, the faces on its sides fade into each other.
  static MapPlaces places(const glm::dvec3& direction, int rows);

  // A neighbour of an edge lies between the texels of the next face.
  template <class F>
  static void texels(int face, int column, int row, int rows, F&& sum) {
    if (column >= 0 && column < rows && row >= 0 && row < rows) return sum(face, column, row, 1.0);
    const MapPlace p = place_of(direction_of(face, column + 0.5, row + 0.5, rows), rows);
    const Pair x(p.u, rows), y(p.v, rows);
    sum(p.face, x.low, y.low, (1 - x.part) * (1 - y.part));
    sum(p.face, x.low + 1, y.low, x.part * (1 - y.part));
    sum(p.face, x.low, y.low + 1, (1 - x.part) * y.part);
    sum(p.face, x.low + 1, y.low + 1, x.part * y.part);
  }

  // On the face that it pierces, with weight 1.
  static MapPlace place_of(const glm::dvec3& direction, int rows);
  static glm::dvec3 direction_of(int face, double u, double v, int rows);

 private:
  // Neighbouring texels that lie within the face.
  struct Pair {
    Pair(double u, int rows);
    int low;
    double part;
  };
};

}  // namespace skyfit
