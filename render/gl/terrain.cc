// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <stdexcept>

#include "render/gl/view_basis.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHighestPeak = 9e3;  // m, a bound on Relief::height_m at the scale of the Earth

// Sectors between two azimuths; when closed, they go all the way round and the last column is the
// first.
struct Fan {
  double begin, width;
  bool closed;
};

// The azimuths that the picture sees: all of them when it holds the nadir or the zenith.
Fan visible_fan(const Camera& camera, double aspect) {
  const ViewBasis basis = view_basis(camera);
  const double tall = std::tan(0.5 * camera.vertical_fov);
  const double diagonal = std::atan(tall * std::sqrt(1 + aspect * aspect));
  constexpr double kMargin = 0.02;
  if (camera.view_zenith + diagonal > kPi - 0.1 || camera.view_zenith - diagonal < 0.1) {
    return {-kPi, 2 * kPi, true};
  }
  double half = 0;
  constexpr int kSteps = 32;
  for (int i = 0; i <= kSteps; ++i) {
    const double along = 2.0 * i / kSteps - 1;
    for (const auto& [x, y] :
         {std::pair(1.0, along), std::pair(along, 1.0), std::pair(along, -1.0)}) {
      const glm::dvec3 ray =
          basis.forward + basis.right * (x * tall * aspect) + basis.up * (y * tall);
      double turn = std::atan2(-ray.y, ray.x) - camera.azimuth;
      turn -= 2 * kPi * std::round(turn / (2 * kPi));
      half = std::max(half, std::abs(turn));
    }
  }
  half = std::min(half + kMargin, kPi);
  return {camera.azimuth - half, 2 * half, half >= kPi};
}

class MeshBuilder {
 public:
  MeshBuilder(const Relief& relief, double radius, const Camera& camera, double aspect,
              const TerrainSettings& settings)
      : relief_(relief),
        radius_(radius),
        altitude_(camera.altitude_m),
        fan_(visible_fan(camera, aspect)),
        pixel_angle_(settings.pixel_angle) {
    mesh_.rings = fan_.closed ? settings.rings_all_round : settings.rings;
    mesh_.sectors = fan_.closed ? settings.sectors_all_round : settings.sectors;
    // As far as a peak can be seen over the horizon.
    const double peak = kHighestPeak * radius / 6360e3;
    const double farthest = radius * (horizon_angle(altitude_) + horizon_angle(peak));
    farthest_ = std::min(farthest, kPi * radius);
    stretch_ = std::asinh(farthest_ / altitude_);
  }

  TerrainMesh build() {
    const auto count = static_cast<std::size_t>(mesh_.rings) * mesh_.sectors;
    mesh_.vertices.resize(count);
    heights_.resize(count);
    directions_.resize(count);
    positions_.resize(count);
    tbb::parallel_for(0, mesh_.rings, [&](int ring) { place(ring); });
    if (positions_[0].z > -0.3) {
      throw std::invalid_argument(
          fmt::format("render.camera.altitude_m = {:.9g}: must be above the ground, {:.3g} m",
                      altitude_, heights_[0]));
    }
    tbb::parallel_for(0, mesh_.rings, [&](int ring) { dress(ring); });
    connect();
    return std::move(mesh_);
  }

 private:
  double horizon_angle(double height) const { return std::acos(radius_ / (radius_ + height)); }

  // Arc length: linear below the camera, exponential far away.
  double arc(int ring) const {
    return altitude_ * std::sinh(stretch_ * ring / (mesh_.rings - 1.0));
  }

  // The finest detail that vertices and pixels can show at a ring.
  double resolution(int ring) const {
    const double along = arc(ring + 1) - arc(ring);
    const double across =
        radius_ * std::sin(std::min(arc(ring) / radius_, kPi / 2)) * fan_.width / mesh_.sectors;
    const double pixel = pixel_angle_ * std::hypot(arc(ring), altitude_);
    return 2 * std::max({0.4 * along, across, pixel});
  }

  std::size_t index(int ring, int sector) const {
    return static_cast<std::size_t>(ring) * mesh_.sectors + sector;
  }

  void place(int ring) {
    const double angle = arc(ring) / radius_;
    const double sine = std::sin(angle), half_sine = std::sin(0.5 * angle);
    const double finest = resolution(ring);
    for (int sector = 0; sector < mesh_.sectors; ++sector) {
      const double azimuth = fan_.begin + fan_.width * sector / (mesh_.sectors - 1.0);
      const double x = sine * std::cos(azimuth), y = -sine * std::sin(azimuth);
      const double drop = -2 * half_sine * half_sine;  // cos(angle) - 1
      const glm::dvec3 direction =
          x * relief_.site_x() + y * relief_.site_y() + (1 + drop) * relief_.site_z();
      const double height = relief_.height_m(direction, finest);
      const double r = radius_ + height;
      const std::size_t i = index(ring, sector);
      directions_[i] = direction;
      heights_[i] = height;
      positions_[i] = {x * r, y * r, height - altitude_ + drop * r};
    }
  }

  // Central differences; a closed fan wraps round, its first and last columns are the same points.
  glm::dvec3 normal(int ring, int sector) const {
    const int last = mesh_.sectors - 1;
    const int left = sector > 0 ? sector - 1 : (fan_.closed ? last - 1 : 0);
    const int right = sector < last ? sector + 1 : (fan_.closed ? 1 : last);
    const glm::dvec3 across = positions_[index(ring, left)] - positions_[index(ring, right)];
    const glm::dvec3 along = positions_[index(std::min(ring + 1, mesh_.rings - 1), sector)] -
                             positions_[index(std::max(ring - 1, 0), sector)];
    const glm::dvec3 upward = glm::cross(along, across);
    const double length = glm::length(upward);
    return length > 1e-12 ? upward / length : glm::dvec3(0, 0, 1);
  }

  void dress(int ring) {
    const double finest = resolution(ring);
    for (int sector = 0; sector < mesh_.sectors; ++sector) {
      const std::size_t i = index(ring, sector);
      const glm::dvec3 n = ring > 0 ? normal(ring, sector) : glm::dvec3(0, 0, 1);
      const glm::dvec3 world =
          n.x * relief_.site_x() + n.y * relief_.site_y() + n.z * relief_.site_z();
      const double steepness = 1 - std::max(glm::dot(world, directions_[i]), 0.0);
      const NodeValues color = relief_.reflectance(directions_[i], heights_[i], steepness, finest);
      TerrainVertex& vertex = mesh_.vertices[i];
      for (int k = 0; k < 3; ++k) {
        vertex.position_km[static_cast<std::size_t>(k)] =
            static_cast<float>(1e-3 * positions_[i][k]);
        vertex.normal[static_cast<std::size_t>(k)] = static_cast<float>(n[k]);
      }
      for (std::size_t k = 0; k < 4; ++k) vertex.reflectance[k] = static_cast<float>(color[k]);
    }
  }

  void connect() {
    mesh_.indices.reserve(static_cast<std::size_t>(mesh_.rings - 1) * (mesh_.sectors - 1) * 6);
    for (int ring = 0; ring + 1 < mesh_.rings; ++ring) {
      for (int sector = 0; sector + 1 < mesh_.sectors; ++sector) {
        const auto a = static_cast<std::uint32_t>(index(ring, sector));
        const auto b = a + 1, c = a + static_cast<std::uint32_t>(mesh_.sectors), d = c + 1;
        mesh_.indices.insert(mesh_.indices.end(), {a, c, b, b, c, d});
      }
    }
  }

  const Relief& relief_;
  double radius_, altitude_;
  Fan fan_;
  double pixel_angle_;
  double farthest_ = 0, stretch_ = 0;
  std::vector<double> heights_;
  std::vector<glm::dvec3> directions_, positions_;
  TerrainMesh mesh_;
};

}  // namespace

TerrainMesh make_terrain(const Relief& relief, double bottom_radius_m, const Camera& camera,
                         double aspect, const TerrainSettings& settings) {
  return MeshBuilder(relief, bottom_radius_m, camera, aspect, settings).build();
}

}  // namespace skyfit
