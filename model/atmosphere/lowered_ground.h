// SPDX-License-Identifier: Apache-2.0
// The air of a basin: an atmosphere that is given from a datum (its bottom radius) upward is
// continued downward to ground that lies below the datum, as on Mars or about the Dead Sea.
#pragma once

#include "model/atmosphere/atmosphere.h"

namespace skyfit {

// The same atmosphere with its bottom radius `depth_m` (>= 0, m) lower. Above the datum nothing
// changes; below it exponential profiles go on as exp(-h / scale height), layers and tents keep
// their heights, and tables keep the density of their first height. Throws std::invalid_argument
// where the planet is not larger than the depth.
Atmosphere<double> lowered_by(double depth_m, const Atmosphere<double>& atmosphere);

}  // namespace skyfit
