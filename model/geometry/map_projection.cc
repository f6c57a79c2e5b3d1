// SPDX-License-Identifier: Apache-2.0
#include "model/geometry/map_projection.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;
using Point = std::array<double, 2>;

Axis from_angles(double zenith, double azimuth) {
  return {std::sin(zenith) * std::sin(azimuth), std::sin(zenith) * std::cos(azimuth),
          std::cos(zenith)};
}

class Equirectangular final : public MapProjection {
 public:
  explicit Equirectangular(int rows) : rows_(rows) {}
  int width() const override { return 2 * rows_; }
  int height() const override { return rows_; }
  std::optional<Axis> direction(double x, double y) const override {
    return from_angles(y * kPi / rows_, x * kPi / rows_ - kPi);
  }
  std::optional<Point> point(const Axis& d) const override {
    const double x = (std::atan2(d[0], d[1]) + kPi) * rows_ / kPi;
    return Point{std::min(x, std::nextafter(2.0 * rows_, 0)),
                 std::acos(std::clamp(d[2], -1.0, 1.0)) * rows_ / kPi};
  }
  double solid_angle_sr(int, int y) const override {
    return kPi / rows_ * (std::cos(y * kPi / rows_) - std::cos((y + 1) * kPi / rows_));
  }

 private:
  int rows_;
};

// A square picture whose pixels have solid angles without a simple form.
class Square : public MapProjection {
 public:
  explicit Square(int side) : side_(side) {}
  int width() const override { return side_; }
  int height() const override { return side_; }
  // Of a pixel as 4 x 4 parts.
  double solid_angle_sr(int x, int y) const override {
    constexpr int kParts = 4;
    double sum = 0;
    for (int j = 0; j < kParts; ++j) {
      for (int i = 0; i < kParts; ++i)
        sum += sr_per_pixel(x + (i + 0.5) / kParts, y + (j + 0.5) / kParts);
    }
    return sum / (kParts * kParts);
  }

 protected:
  double side() const { return side_; }
  // At a point, by the parallelogram that two steps from it span; 0 where no direction is shown.
  virtual double sr_per_pixel(double x, double y) const {
    constexpr double kStep = 1e-4;  // of a pixel
    const auto middle = direction(x, y), right = direction(x + kStep, y),
               down = direction(x, y + kStep);
    if (!middle || !right || !down) return 0;
    Axis a, b;
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = (*right)[k] - (*middle)[k];
      b[k] = (*down)[k] - (*middle)[k];
    }
    return std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                      a[0] * b[1] - a[1] * b[0]) /
           (kStep * kStep);
  }

 private:
  int side_;
};

// Angles from an axis are radii.
class Disc : public Square {
 public:
  Disc(int side, double largest) : Square(side), largest_(largest) {}

 protected:
  // The angle from the axis and the direction in the picture, clockwise from up.
  std::optional<Point> polar(double x, double y) const {
    const double right = 2 * x / side() - 1, up = 1 - 2 * y / side();
    const double radius = std::hypot(right, up);
    if (radius > 1) return {};
    return Point{radius * largest_, std::atan2(right, up)};
  }
  std::optional<Point> place(double angle, double turn) const {
    if (angle > largest_) return {};
    const double radius = angle / largest_;
    return Point{0.5 * side() * (1 + radius * std::sin(turn)),
                 0.5 * side() * (1 - radius * std::cos(turn))};
  }
  // Rings of the angle t: sin t dt dphi on the sphere, r dr dphi in the picture.
  double sr_per_pixel(double x, double y) const override {
    const auto p = polar(x, y);
    if (!p) return 0;
    const double angle = (*p)[0], radians_per_pixel = 2 * largest_ / side();
    constexpr double kInTheMiddle = 1e-6;
    return radians_per_pixel * radians_per_pixel *
           (angle < kInTheMiddle ? 1 : std::sin(angle) / angle);
  }

 private:
  double largest_;
};

class FisheyeMap final : public Disc {
 public:
  using Disc::Disc;
  std::optional<Axis> direction(double x, double y) const override {
    const auto p = polar(x, y);
    if (!p) return {};
    return from_angles((*p)[0], -(*p)[1]);  // one looks up: east is left
  }
  std::optional<Point> point(const Axis& d) const override {
    return place(std::atan2(std::hypot(d[0], d[1]), d[2]), -std::atan2(d[0], d[1]));
  }
};

class AngularMap final : public Disc {
 public:
  using Disc::Disc;
  std::optional<Axis> direction(double x, double y) const override {
    const auto p = polar(x, y);
    if (!p) return {};
    const auto& [angle, turn] = *p;
    return Axis{std::sin(angle) * std::sin(turn), std::cos(angle),
                std::sin(angle) * std::cos(turn)};
  }
  std::optional<Point> point(const Axis& d) const override {
    return place(std::atan2(std::hypot(d[0], d[2]), d[1]), std::atan2(d[0], d[2]));
  }
};

class Octahedral final : public Square {
 public:
  using Square::Square;
  std::optional<Axis> direction(double x, double y) const override {
    double east = 2 * x / side() - 1, north = 1 - 2 * y / side();
    const double up = 1 - std::abs(east) - std::abs(north);
    if (up < 0) {
      const double folded = (1 - std::abs(north)) * (east < 0 ? -1 : 1);
      north = (1 - std::abs(east)) * (north < 0 ? -1 : 1);
      east = folded;
    }
    const double length = std::hypot(east, north, up);
    return Axis{east / length, north / length, up / length};
  }
  std::optional<Point> point(const Axis& d) const override {
    const double sum = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
    double east = d[0] / sum, north = d[1] / sum;
    if (d[2] < 0) {
      const double folded = (1 - std::abs(north)) * (east < 0 ? -1 : 1);
      north = (1 - std::abs(east)) * (north < 0 ? -1 : 1);
      east = folded;
    }
    return Point{0.5 * side() * (1 + east), 0.5 * side() * (1 - north)};
  }
};

// A face by its middle, its right and its lower edge; in world axes.
struct CubeFace {
  Axis middle, right, down;
};

// OpenGL's order and orientation with its axes x east, y up, z south.
constexpr std::array<CubeFace, 6> kFaces = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
                                             {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                                             {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                             {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
                                             {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                             {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}}}};

class Cube final : public MapProjection {
 public:
  explicit Cube(int side) : side_(side) {}
  int width() const override { return faces() * side_; }
  int height() const override { return side_; }
  int faces() const override { return static_cast<int>(kFaces.size()); }
  std::optional<Axis> direction(double x, double y) const override {
    const auto face = static_cast<std::size_t>(std::clamp(x / side_, 0.0, 5.0));
    const CubeFace& f = kFaces[face];
    const double u = 2 * (x / side_ - static_cast<double>(face)) - 1, v = 2 * y / side_ - 1;
    const double length = std::hypot(1, u, v);
    Axis d;
    for (std::size_t k = 0; k < 3; ++k)
      d[k] = (f.middle[k] + u * f.right[k] + v * f.down[k]) / length;
    return d;
  }
  std::optional<Point> point(const Axis& d) const override {
    const auto along = [&](const Axis& axis) {
      return d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2];
    };
    const auto best = std::ranges::max_element(
        kFaces, {}, [&](const CubeFace& face) { return along(face.middle); });
    const double depth = along(best->middle);
    const double u = along(best->right) / depth, v = along(best->down) / depth;
    const auto face = static_cast<double>(best - kFaces.begin());
    return Point{side_ * (face + std::min(0.5 * (1 + u), std::nextafter(1.0, 0))),
                 side_ * 0.5 * (1 + v)};
  }
  // Van Oosterom & Strackee's of the corners in closed form.
  double solid_angle_sr(int x, int y) const override {
    const auto corner = [&](int i, int j) {
      const double u = 2.0 * i / side_ - 1, v = 2.0 * j / side_ - 1;
      return std::atan2(u * v, std::hypot(1, u, v));
    };
    const int i = x % side_;
    return corner(i, y) - corner(i + 1, y) - corner(i, y + 1) + corner(i + 1, y + 1);
  }

 private:
  int side_;
};

template <class Projection>
std::unique_ptr<MapProjection> make(int size, double /*field_of_view*/) {
  return std::make_unique<Projection>(size);
}

template <class Projection>
std::unique_ptr<MapProjection> make_disc(int size, double field_of_view) {
  return std::make_unique<Projection>(size, field_of_view / 2);
}

constexpr std::array<MapProjectionEntry, 5> kProjections = {{
    {"equirectangular", "2N x N: latitude-longitude, north in the middle, east to the right", 0,
     make<Equirectangular>},
    {"fisheye", "N x N: the sky alone, equidistant, north up, east left as one looks up", kPi,
     make_disc<FisheyeMap>},
    {"cube", "6N x N: faces side by side in OpenGL's order; its x is east, y up, z south", 0,
     make<Cube>},
    {"octahedral", "N x N: the zenith in the middle, north up, east to the right", 0,
     make<Octahedral>},
    {"angular", "N x N: a light probe that looks north; radius = angle from it over 180 deg",
     2 * kPi, make_disc<AngularMap>},
}};

}  // namespace

std::span<const MapProjectionEntry> map_projections() { return kProjections; }

std::unique_ptr<MapProjection> make_map_projection(std::string_view name, int size) {
  std::vector<std::string_view> names;
  for (const MapProjectionEntry& entry : kProjections) {
    if (entry.name == name) return entry.make(size, entry.field_of_view);
    names.push_back(entry.name);
  }
  throw std::invalid_argument(
      fmt::format("projection \"{}\": expected one of {}", name, fmt::join(names, ", ")));
}

}  // namespace skyfit
