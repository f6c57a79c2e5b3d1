// SPDX-License-Identifier: Apache-2.0
// Single scattering along one view ray, exact in spherical geometry, by Gauss's rule between fixed
// shells, the edges of the planet's shadow and the ray's lowest point.
#pragma once

#include <vector>

#include "model/sky_geometry.h"

namespace skyfit {

struct SingleScatteringSample {
  double height, weight;
  PathColumns columns;  // from the ray's entry to the point and on to the sun
};

std::vector<SingleScatteringSample> single_scattering_samples(const Shells& shells,
                                                              const ViewRay& ray,
                                                              const SunAlongRay& sun);

// Radiance per unit solar irradiance without the phase functions (sr^0): multiply by P_i(nu) and
// add.
template <int N>
struct SingleScattering {
  Dual<N> air, aerosol;
};

template <int N>
SingleScattering<N> single_scattering(const Optics<N>& optics,
                                      const std::vector<SingleScatteringSample>& samples);

}  // namespace skyfit
