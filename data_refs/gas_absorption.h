// SPDX-License-Identifier: Apache-2.0
// The absorption of gases that the model lacks (gas_absorption_spectrl2.csv, which is compiled in).
#pragma once

#include "model/photometry/broadband.h"

namespace skyfit::refs {

const GasAbsorption& standard_gas_absorption();

}  // namespace skyfit::refs
