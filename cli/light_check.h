// SPDX-License-Identifier: Apache-2.0
// The last look at light before it is printed or written: none is infinite, negative or not a
// number, whatever model or device it comes from. Every function throws std::runtime_error with one
// line that says which value stands where.
#pragma once

#include <vector>

#include "fit/model_comparison.h"
#include "model/sky_model.h"
#include "render/render.h"

namespace skyfit::cli {

// Radiance per unit solar irradiance at the points.
void check_light(const SkyValues& sky, const std::vector<WavelengthNode>& nodes,
                 const std::vector<SkyPoint>& points);

// Irradiance per unit solar irradiance; angle in radians.
void check_irradiance(const SkyValues& irradiance, const std::vector<WavelengthNode>& nodes,
                      double altitude_m, double sun_zenith);

void check_light(const Frame& frame);

// Errors and scales of what could be compared.
void check_light(const std::vector<fit::ModelComparison>& rows);

}  // namespace skyfit::cli
