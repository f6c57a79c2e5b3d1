// SPDX-License-Identifier: Apache-2.0
// Maps of the residual over the hemisphere, seen from below the sky: distance from the centre is
// the view zenith, the sun's azimuth points right, so that the horizontal diameter is the axis of
// the principal plane's panels.
#pragma once

#include <string>
#include <vector>

#include "render/plot/script.h"
#include "render/plot/suns.h"

namespace skyfit::plot {

// The part of the sky that a sample stands for, in polar coordinates of the map, degrees.
struct Patch {
  const Sample* sample = nullptr;
  double inner_zenith_deg = 0, outer_zenith_deg = 0;
  double azimuth_deg = 0, width_deg = 0;
};

// "x,y" on a map whose rim has radius 1.
std::string polar_point(double zenith_deg, double azimuth_deg);
// Corners of a polygon, "x,y to x,y ..": out along the inner arc, back along the outer one; every
// arc by steps of at most 3 degrees.
std::string patch_outline(const Patch& patch);

// Cuts the hemisphere into one patch per sample when the samples form rings of equally spaced
// azimuths (as Tregenza's 145 do): borders lie midway between the rings. Empty when they do not;
// such samples are drawn as points.
std::vector<Patch> patches_of(const std::vector<Sample>& samples);

// Half the width of the colour scale, percent: 98 % of the counted residuals lie within.
double residual_limit_percent(const Suns& suns);

// What stands below the colour scale.
std::string residual_scale_title(double limit_percent);

// One map per sun position and curve, one block of the area per curve, and the colour scale.
void draw_hemisphere_maps(Script& script, const Comparison& comparison, const Suns& suns,
                          const Box& area, const Box& scale);

}  // namespace skyfit::plot
