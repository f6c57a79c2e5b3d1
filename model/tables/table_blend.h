// SPDX-License-Identifier: Apache-2.0
// Atmospheres and their tables between two others: an atmosphere that changes from frame to frame
// without tables of its own for every frame.
#pragma once

#include "model/tables/tables.h"

namespace skyfit {

// Every parameter of the table (model/atmosphere/parameters.h), depolarisation and site pressure
// linear in `share`, 0 for a and 1 for b. Throws std::invalid_argument, one line that names the
// field, when the two differ in what has nothing in between: radii, kinds of phase function,
// tabulated functions.
Atmosphere<double> interpolated_atmosphere(const Atmosphere<double>& a, const Atmosphere<double>& b,
                                           double share);

// The values of the tables, linear in `share`: of the scattering tables that is the logarithm of
// the light, which goes with the linear optical depth. Throws as interpolated_atmosphere(), and
// when sizes, heights or wavelengths differ.
AtmosphereTables interpolated_tables(const AtmosphereTables& a, const AtmosphereTables& b,
                                     double share);

}  // namespace skyfit
