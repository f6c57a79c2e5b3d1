// SPDX-License-Identifier: Apache-2.0
// What the shaders read from the tables, in C++: the same mappings and the same linear filter.
// Lengths in metres, values at the four nodes of the colour rule, per unit solar irradiance. Points
// lie inside the atmosphere.
#pragma once

#include "model/tables.h"

namespace skyfit {

// From a point to the top along a ray that misses the ground.
NodeValues lookup_optical_depth(const AtmosphereTables& tables, double height, double mu);

// Of the sun's beam; the disc, 0.533 degrees wide, sinks behind the horizon over its diameter.
NodeValues lookup_sun_transmittance(const AtmosphereTables& tables, double height, double mu_s);

// Diffuse, on a horizontal surface that faces up.
NodeValues lookup_irradiance(const AtmosphereTables& tables, double height, double mu_s);

// Radiance of the whole ray, to the top or to the ground (1/sr); light that comes straight from the
// ground is not in it.
NodeValues lookup_radiance(const AtmosphereTables& tables, double height, double mu, double mu_s,
                           double nu, bool hits_ground);

}  // namespace skyfit
