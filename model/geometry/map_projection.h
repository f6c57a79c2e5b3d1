// SPDX-License-Identifier: Apache-2.0
// Pictures of all directions. World axes: x to the east, y to the north, z to the zenith; pixels
// run from the upper left corner, the centre of the first at (0.5, 0.5).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace skyfit {

using Axis = std::array<double, 3>;

class MapProjection {
 public:
  virtual ~MapProjection() = default;
  virtual int width() const = 0;
  virtual int height() const = 0;
  // Squares of a cube side by side, else 1.
  virtual int faces() const { return 1; }
  // Unit vector; nothing where the picture shows no direction.
  virtual std::optional<Axis> direction(double x, double y) const = 0;
  // The point that shows a direction; nothing outside the picture. Inverse of direction().
  virtual std::optional<std::array<double, 2>> point(const Axis& direction) const = 0;
  // Of the pixel in column x and row y, sr.
  virtual double solid_angle_sr(int x, int y) const = 0;
};

struct MapProjectionEntry {
  std::string_view name, meaning;
  double field_of_view;  // usual angle across a picture that is a disc, rad; 0: all directions
  // `size`: rows of equirectangular, the side of the others or of a face. `field_of_view` above 0
  // and at most 2 pi; of use for discs.
  std::unique_ptr<MapProjection> (*make)(int size, double field_of_view);
};
std::span<const MapProjectionEntry> map_projections();

// With the usual field of view. Throws std::invalid_argument that lists the names.
std::unique_ptr<MapProjection> make_map_projection(std::string_view name, int size);

}  // namespace skyfit
