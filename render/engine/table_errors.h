// SPDX-License-Identifier: Apache-2.0
// What fewer texels and a lower precision of tables cost, as errors of luminance.
#pragma once

#include <span>

#include "model/atmosphere/atmosphere.h"
#include "model/photometry/photometry.h"
#include "model/tables/tables.h"

namespace skyfit {

// Of |luminance / true luminance - 1| where there is light.
struct LuminanceError {
  double rms = 0, worst = 0;
  std::size_t compared = 0;  // directions with light
};

LuminanceError luminance_error(std::span<const double> values, std::span<const double> truth);

// Views 5 to 89 deg from the zenith, from the ground; the light of the air on the way to a point 2
// or 20 km from an eye 2 m above the ground, views 60 to 89.9 deg, as lookup_radiance() of both
// ends tells it.
struct TableErrors {
  LuminanceError day;         // suns 0 to 88 deg
  LuminanceError twilight;    // suns 90 to 96 deg
  LuminanceError in_scatter;  // suns 0 to 88 deg
};

TableErrors errors_against_tables(const AtmosphereTables& tables, const AtmosphereTables& truth);

// Of the sky alone, against the model `reference` without a limit on its wavelengths. `spectra` are
// under the atmosphere's star.
TableErrors errors_against_reference(const AtmosphereTables& tables, const SpectralData& spectra,
                                     int threads);

}  // namespace skyfit
