// SPDX-License-Identifier: Apache-2.0
// What another value of a parameter does to an atmosphere's tables: the difference of the
// logarithms, in far fewer texels than the tables have. A page adds them up over its sliders.
#pragma once

#include "model/tables/tables.h"

namespace skyfit {

// Texels of the differences; and of the tables that are subtracted: light is traced from height to
// height, so they need more of these than the differences keep, every third.
inline constexpr TableSizes kChangeSizes = {.optical_depth_mu = 32,
                                            .optical_depth_r = 24,
                                            .irradiance_mu_s = 24,
                                            .irradiance_r = 6,
                                            .scattering_r = 10,
                                            .scattering_ground = 6,
                                            .scattering_sky = 20,
                                            .scattering_mu_s = 24,
                                            .scattering_azimuth = 8,
                                            .outside_sky = 4,
                                            .outside_mu_s = 8,
                                            .outside_azimuth = 4};

inline constexpr int kEveryHeight = 3;
inline constexpr TableSizes kComparedSizes = [] {
  TableSizes sizes = kChangeSizes;
  sizes.scattering_r = (kChangeSizes.scattering_r - 1) * kEveryHeight + 1;
  return sizes;
}();

// Tables of the atmosphere `after`, of kChangeSizes, whose texels are the differences of the
// natural logarithms from those of `before`; both have kComparedSizes. Of phase functions 274
// angles are kept.
AtmosphereTables table_change(const AtmosphereTables& before, const AtmosphereTables& after);

// Throws std::invalid_argument when the two differ in which constituents share a phase function:
// their tables have nothing in common.
void require_same_classes(const Atmosphere<double>& before, const Atmosphere<double>& after);

// The atmosphere with another value of one of its parameters.
Atmosphere<double> changed(const Atmosphere<double>& atmosphere, const Parameter& parameter,
                           double value);

}  // namespace skyfit
