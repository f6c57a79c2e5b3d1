// SPDX-License-Identifier: Apache-2.0
// The sun as seen from the points of a view ray. Lengths in metres.
#pragma once

#include <vector>

#include "model/geometry/ray.h"
#include "model/geometry/sky_point.h"

namespace skyfit {

// What refraction does to directions (model/atmosphere/refraction.h), in heights above the radius
// in which rays are straight.
class LightTurns {
 public:
  virtual ~LightTurns() = default;
  // By how much light turns from beyond the air to a point, where it arrives from zenith angle z.
  virtual double bending(double height, double zenith) const = 0;
  // The zenith angle from which the light of a star arrives, from that without air.
  virtual double apparent_zenith(double height, double true_zenith) const = 0;
  // The solid angle in which a part of the sky is seen, over that without air.
  virtual double beam_spread(double height, double apparent_zenith) const = 0;
  virtual double refractive_index(double height) const = 0;
};

class SunAlongRay {
 public:
  SunAlongRay(double bottom_radius, const ViewRay& ray, const SkyPoint& point,
              const LightTurns* turns = nullptr);

  double nu() const { return nu_; }  // cosine of the scattering angle, at the observer
  // At a point, where the sun stands at mu_s: the same on straight rays.
  double nu(const RayPoint& p, double mu_s) const;
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
  bool is_refracted() const { return turns_ != nullptr; }
  // Of the angle by which the scattering plane is turned from the meridian plane, clockwise as the
  // observer sees it: cosine and sine of twice the angle; 1 and 0 where view and sun are one line.
  Azimuth twice_the_turn() const;
  // What refraction makes of the light that the sun's beam sends to the observer from a point,
  // docs/theory (14.7); 1 without it.
  double beam_spread(const RayPoint& p, double mu_s) const;
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

  // With refraction: the sun's true direction in the frame of the observer's vertical and view
  // azimuth, and the observer's height and zenith angle of the view.
  struct Local {
    double up, forward, right;  // of the true sun at a point
  };
  Local sun_at(const RayPoint& p) const;
  const LightTurns* turns_ = nullptr;
  double sun_up_ = 0, sun_forward_ = 0, sun_right_ = 0, height_ = 0, view_zenith_ = 0;
};

}  // namespace skyfit
