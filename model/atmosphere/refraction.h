// SPDX-License-Identifier: Apache-2.0
// Refraction by air, docs/theory (14). Light of one wavelength in shells of refractive index n(r)
// keeps n r sin z along its way, z the local zenith angle. With the refractive radius x = n r in
// the place of r and densities rho / (dx / dr) in the place of rho its columns are those of
// straight rays; what remains is the angle by which it turns, the bending, and that the beam of the
// sun spreads. Lengths in metres, angles in radians.
#pragma once

#include <vector>

#include "model/atmosphere/linear_profile.h"
#include "model/atmosphere/shells.h"
#include "model/geometry/sun_along_ray.h"

namespace skyfit {

class Refraction final : public LightTurns {
 public:
  // n - 1 is that of dry air of 288.15 K at the ground (Bodhaine et al. 1999, equations 18 and 19),
  // with the pressure of the air, where it is stated, and the profile of the first constituent that
  // scatters as molecules do; without one n is 1. Throws std::invalid_argument where the air turns
  // rays more than the planet is curved.
  Refraction(const Atmosphere<double>& atmosphere, double wavelength_nm);

  // The same profiles over the refractive height, n r less that of the ground.
  Shells refracted(const Shells& shells) const;
  double refractive_height(double height) const;

  // The angle by which light turns that comes from beyond the air to a refractive height and
  // arrives from zenith angle z, also from below the horizon of a point in the air.
  double bending(double refractive_height, double zenith) const override;
  // The zenith angle from which the light of a star arrives that stands at `true_zenith` without
  // air.
  double apparent_zenith(double refractive_height, double true_zenith) const override;
  // The solid angle in which a part of the sky is seen, over that without air: with the square of
  // the refractive index what refraction makes of the irradiance on a surface that faces the sun.
  double beam_spread(double refractive_height, double apparent_zenith) const override;
  double refractive_index(double refractive_height) const override;

  // n - 1 at the ground, and the height over which it falls by e there; 0 and 1 without air.
  struct NearGround {
    double refractivity, scale_height;
  };
  NearGround near_ground() const;

 private:
  struct Air {
    double density, slope;  // of n - 1, and by height
  };
  Air air_at(double height) const;
  double stretch(double height) const;  // dx / dr
  LinearProfile refracted(const LinearProfile& profile) const;
  void tabulate();

  double bottom_radius_, top_, refractive_radius_;  // of the ground, in x
  double refractivity_ = 0;                         // n - 1 where the density is 1
  std::vector<Profile> air_;                        // none or one
  // Heights on which profiles are made tables, their refractive heights and indices.
  std::vector<double> heights_, refractive_heights_, indices_;
  // bending() over sin z, by refractive heights and cosines of z >= 0.
  std::vector<double> table_heights_, table_cosines_, table_;
};

}  // namespace skyfit
