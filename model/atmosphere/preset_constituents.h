// SPDX-License-Identifier: Apache-2.0
// Constituents in a preset of version 2, see docs/preset.md.
#pragma once

#include <nlohmann/json.hpp>

#include "model/atmosphere/atmosphere.h"
#include "model/atmosphere/preset_tables.h"
#include "model/base/preset_reader.h"

namespace skyfit {

PhaseFunction<double> read_phase(const PresetReader& object, const PresetTables& tables);
Constituent<double> read_constituent(const PresetReader& object, const PresetTables& tables);

nlohmann::ordered_json constituent_to_json(const Constituent<double>& constituent);

}  // namespace skyfit
