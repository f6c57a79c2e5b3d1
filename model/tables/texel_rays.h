// SPDX-License-Identifier: Apache-2.0
// The view rays of the scattering tables of model/tables/tables.h.
#pragma once

#include "model/atmosphere/shells.h"
#include "model/tables/tables.h"

namespace skyfit {

// A texel's ray. The ends of the table's halves, where rays have no length, stand for rays of a
// decimetre's height.
struct TexelRay {
  ViewRay ray;
  RayPoint sun_point;  // where the sun's height and azimuth are those of the table
};

// Which half of the table `row` is in says whether its ray ends on the ground; `height` is that of
// the table's rays, `deck` that of HeightAxis::deck(), m.
TexelRay texel_ray(const Shells& shells, const RayTexels& texels, int row, double height,
                   double deck);

// Cosine of the sun's zenith angle at the sun point, and sine of that angle times the cosine of the
// azimuth, of the cells of a row whose sun point has this height: [azimuth][sun].
struct TexelSun {
  double mu_s, across;
};
std::vector<TexelSun> texel_suns(const RayTexels& texels, double bottom_radius, double height);

}  // namespace skyfit
