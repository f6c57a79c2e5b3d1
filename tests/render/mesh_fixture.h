// SPDX-License-Identifier: Apache-2.0
// Meshes for tests: placed at the coast, where a camera without a site stands.
#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <vector>

#include "render/gl/terrain/relief.h"
#include "tests/render/frame_fixture.h"

namespace skyfit {

inline const SiteAxes& coast() {
  static const SiteAxes axes =
      Relief(earth_clear().atmosphere.bottom_radius_m, {0.1, 0.1, 0.1, 0.1}, true).coast();
  return axes;
}

// A mesh whose origin lies above the coast; its y axis points up, -z toward the sun's azimuth, x to
// the right of it.
inline PlacedMesh at_the_coast(const std::filesystem::path& file, double altitude_m) {
  const SiteAxes& axes = coast();
  PlacedMesh mesh;
  mesh.file = file;
  mesh.altitude_m = altitude_m;
  mesh.latitude = std::asin(axes.z.z);
  mesh.longitude = std::atan2(axes.z.y, axes.z.x);
  const glm::dvec3 east(-std::sin(mesh.longitude), std::cos(mesh.longitude), 0);
  mesh.heading = std::atan2(glm::dot(axes.x, east), glm::dot(axes.x, glm::cross(axes.z, east)));
  return mesh;
}

// Corners of a mesh in the axes of the site: toward the sun's azimuth, to the left of it, up.
class ObjWriter {
 public:
  explicit ObjWriter(const std::filesystem::path& file) : out_(file) { out_.precision(17); }

  void quad(const std::array<glm::dvec3, 4>& corners) {
    for (const glm::dvec3& c : corners) out_ << "v " << -c.y << ' ' << c.z << ' ' << -c.x << '\n';
    out_ << "f";
    for (int i = 1; i <= 4; ++i) out_ << ' ' << count_ + i;
    out_ << '\n';
    count_ += 4;
  }
  void box(const glm::dvec3& low, const glm::dvec3& high) {
    const auto corner = [&](int i) {
      return glm::dvec3((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                        (i & 4) != 0 ? high.z : low.z);
    };
    for (const auto& f : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                          std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}})
      quad({corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3])});
  }

 private:
  std::ofstream out_;
  int count_ = 0;
};

}  // namespace skyfit
