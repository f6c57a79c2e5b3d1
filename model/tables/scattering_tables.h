// SPDX-License-Identifier: Apache-2.0
// Makes the scattering tables of model/tables/tables.h and those for an eye outside of
// model/tables/sky_rays.h.
#pragma once

#include <functional>

#include "model/tables/diffuse_source.h"
#include "model/tables/tables.h"

namespace skyfit {

// `tables` has its atmosphere and sizes, `options` are those of options_for(); progress in 0..1 per
// part of this work, may be empty.
void make_scattering_tables(const Shells& shells, const NodeOptics& optics,
                            AtmosphereTables& tables, const ReferenceOptions& options,
                            const TableLight& light, const std::function<void(double)>& progress);

}  // namespace skyfit
