// SPDX-License-Identifier: Apache-2.0
// How far the luminances of a page's tables are from those of the model `reference`.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/geometry/sky_point.h"
#include "model/photometry/photometry.h"
#include "model/tables/table_lookup.h"
#include "render/page/sky_page.h"

namespace skyfit {

inline constexpr std::array kDaySuns_deg = {0.0, 15.0, 30.0, 60.0, 75.0, 84.0, 88.0};

// Suns and views 5 to 89 deg from the zenith, from one height; closest about the sun and the
// horizon, where light changes fastest, and between texels.
std::vector<SkyPoint> compared_points(double altitude_m,
                                      std::span<const double> suns_deg = kDaySuns_deg);

// [point], cd/m^2, by luminance_rule().
std::vector<double> reference_luminances(const Atmosphere<double>& atmosphere,
                                         const SpectralData& spectra,
                                         std::span<const SkyPoint> points, int threads);

// [point], cd/m^2, as lookup_changed_radiance() has them.
std::vector<double> table_luminances(const AtmosphereTables& tables,
                                     std::span<const WeightedTables> changes,
                                     const PhaseClasses& phases, std::span<const SkyPoint> points);

// The largest |a / b - 1|, and at which of the points.
WorstError largest_error(std::span<const SkyPoint> points, std::span<const double> a,
                         std::span<const double> b);

}  // namespace skyfit
