// SPDX-License-Identifier: Apache-2.0
// The shape and colour of a made-up planet: seas, plains, hills and mountain ranges from 3D noise.
// Features scale with the planet; lengths named below are those on a planet of 6360 km. The relief
// fades into a plain at the site where the camera stands, so that a camera 1 m above the bottom
// radius is above the ground on every planet.
#pragma once

#include <glm/vec3.hpp>

#include "model/tables.h"

namespace skyfit {

class Relief {
 public:
  Relief(double bottom_radius_m, double ground_albedo);

  // Orthonormal, in planet coordinates: z at the site's zenith, x toward the sun's azimuth, y to
  // the left of it.
  const glm::dvec3& site_x() const { return x_; }
  const glm::dvec3& site_y() const { return y_; }
  const glm::dvec3& site_z() const { return z_; }

  // Height above the bottom radius in metres, >= 0. `direction`: unit vector in planet coordinates;
  // details smaller than `resolution_m` are left out.
  double height_m(const glm::dvec3& direction, double resolution_m) const;

  // Lambert reflectance, in 0..1; its mean over the planet is the ground albedo at every node.
  // `steepness` = 1 - cos of the slope's angle.
  NodeValues reflectance(const glm::dvec3& direction, double height_m, double steepness,
                         double resolution_m) const;

 private:
  void settle_on_a_coast();
  NodeValues material(const glm::dvec3& direction, double height_m, double steepness,
                      double resolution_m) const;
  void balance_materials();

  double radius_m_, albedo_;
  double scale_;  // this planet's radius / 6360 km
  glm::dvec3 x_, y_, z_;
  NodeValues mean_{1, 1, 1, 1};  // of material() over the planet
  double contrast_ = 1;          // 0: one colour, 1: the materials as they are
};

}  // namespace skyfit
