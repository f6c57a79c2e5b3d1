// SPDX-License-Identifier: Apache-2.0
// The sun's disc at the horizon, and twilight below it. Lengths in metres.
#pragma once

namespace skyfit {

// The lowest sun that the tables hold, by sun_height() of model/shared/mapping.glsl: on the ground
// the cosine of 102 degrees from the zenith. Below it no light reaches the air that can be seen
// from a table's point.
inline constexpr double kTableLowestSun = -0.2079;

// Cosine of the zenith angle of the horizon.
double horizon_cosine(double bottom, double height);

// Share of the sun's disc, of that angular radius, that stands above the horizon.
double visible_sun(double bottom, double height, double mu_s, double angular_radius);

// Below the lowest sun of a table its light falls by e per degree of the sun's height or cosine.
double deep_twilight(double sun, double lowest);

}  // namespace skyfit
