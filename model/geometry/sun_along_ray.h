// SPDX-License-Identifier: Apache-2.0
// The sun as seen from the points of a view ray. Lengths in metres.
#pragma once

#include <vector>

#include "model/geometry/ray.h"
#include "model/geometry/sky_point.h"

namespace skyfit {

class SunAlongRay {
 public:
  SunAlongRay(double bottom_radius, const ViewRay& ray, const SkyPoint& point);

  double nu() const { return nu_; }  // cosine of the scattering angle
  // Cosine of the local sun zenith.
  double mu_s(const RayPoint& p) const;
  // Cosine of the azimuth between the view and the sun about the local zenith; 1 where either is
  // vertical.
  double cos_azimuth(const RayPoint& p, double mu_s) const;
  // Cosine and sine of that azimuth, view less sun, counter-clockwise from above; also where the
  // view is vertical: the ray's meridian plane, that of the line of sight, is the same all along
  // it.
  struct Azimuth {
    double cosine = 1, sine = 0;
  };
  Azimuth azimuth(const RayPoint& p, double mu_s) const;
  // Of the angle by which the scattering plane is turned from the meridian plane, clockwise as the
  // observer sees it: cosine and sine of twice the angle; 1 and 0 where view and sun are one line.
  Azimuth twice_the_turn() const;
  // Whether the planet lets the sun through.
  bool lit(const RayPoint& p, double mu_s) const;
  // Where the ray crosses the edge of the planet's shadow, of 0 .. 2 places inside the ray.
  std::vector<double> shadow_edges() const;

 private:
  double bottom_radius_;
  const ViewRay& ray_;
  double nu_;
  double up_, right_;   // the sun's components in the frame of the observer's line of sight
  double radius_mu_s_;  // r mu_s at the ray's entry
};

}  // namespace skyfit
