// SPDX-License-Identifier: Apache-2.0
// The polarisation of the sky in a frame.
#pragma once

#include <string>

#include "model/photometry/photometry.h"
#include "model/polarisation.h"
#include "model/sky_model.h"
#include "render/render.h"

namespace skyfit {

// Fills Frame::polarisation: luminance of the model's diffuse light under the suns of `options` by
// `rule`, in the meridian plane of each pixel's centre. Within the atmosphere it is interpolated as
// in SkyMap, outside it is that of every pixel's ray. `options` as the frame was drawn with them,
// `atmosphere` that of its tables, `altitude_m` the camera's above its bottom. Throws as
// SkyModel::stokes() does.
void add_polarisation(const SkyModel& model, const Atmosphere<double>& atmosphere,
                      const LuminanceRule& rule, double altitude_m, const FrameOptions& options,
                      PolarisationAngle angle, Frame& frame);

// In a sentence: plane, signs, what it is of.
std::string stokes_convention(PolarisationAngle angle);

}  // namespace skyfit
