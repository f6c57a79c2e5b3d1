// SPDX-License-Identifier: Apache-2.0
// Presets of version 1, which had one each of air, aerosol and ozone: they stay readable for ever.
#pragma once

#include "model/atmosphere/atmosphere.h"
#include "model/atmosphere/preset_tables.h"
#include "model/base/preset_reader.h"

namespace skyfit {

// The constituents "rayleigh", "mie" and "ozone" of the document's objects of these names.
std::vector<Constituent<double>> read_constituents_v1(const PresetReader& root,
                                                      const PresetTables& tables);

}  // namespace skyfit
