// SPDX-License-Identifier: Apache-2.0
// What the shaders read from the tables, in C++: the same mappings and the same linear filter.
// Lengths in metres, values at the four nodes of the colour rule, per unit solar irradiance. Points
// lie inside the atmosphere.
#pragma once

#include <span>
#include <vector>

#include "model/geometry/sun_disc.h"
#include "model/tables/tables.h"

namespace skyfit {

// A point on a view ray, as the tables see it: cosines of the zenith angles of view and sun there.
struct TablePlace {
  double height, mu, mu_s;
};
TablePlace place_along(const AtmosphereTables& tables, const TablePlace& from, double nu,
                       double distance);

// Between two places on a ray. `downward` when the ray ends on the ground: both ends are then taken
// as upward rays, so that neither look-up meets the ground.
NodeValues lookup_transmittance(const AtmosphereTables& tables, const TablePlace& from,
                                const TablePlace& to, bool downward);

// From a point to the top along a ray that misses the ground.
NodeValues lookup_optical_depth(const AtmosphereTables& tables, double height, double mu);

// Of the sun's beam; the disc sinks behind the horizon over its diameter.
NodeValues lookup_sun_transmittance(const AtmosphereTables& tables, double height, double mu_s);

// Diffuse, on a horizontal surface that faces up.
NodeValues lookup_irradiance(const AtmosphereTables& tables, double height, double mu_s);

// Radiance of the whole ray, to the top or to the ground (1/sr); light that comes straight from the
// ground is not in it.
NodeValues lookup_radiance(const AtmosphereTables& tables, double height, double mu, double mu_s,
                           double nu, bool hits_ground);

// Its parts before phase functions, sr^0: of what scatters as air, then of each of phases.others.
std::vector<NodeValues> lookup_amplitudes(const AtmosphereTables& tables, const TablePlace& from,
                                          double nu, bool hits_ground);

// lookup_radiance() where tables of other sizes, by the same mappings, add their logarithms to
// those of `tables`, each with its weight. `phases` are those of the atmosphere that results.
struct WeightedTables {
  const AtmosphereTables& tables;
  double weight;
};
NodeValues lookup_changed_radiance(const AtmosphereTables& tables,
                                   std::span<const WeightedTables> changes,
                                   const PhaseClasses& phases, const TablePlace& from, double nu,
                                   bool hits_ground);

// The same of a ray that enters at the top and misses the ground, from the tables of
// SkyRayMapping::kFromOutside; cosines where it enters.
NodeValues lookup_radiance_from_outside(const AtmosphereTables& tables, double mu, double mu_s,
                                        double nu);

}  // namespace skyfit
