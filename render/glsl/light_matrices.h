// SPDX-License-Identifier: Apache-2.0
// Matrices of the shaders from light at the four nodes of a colour rule, by columns.
#pragma once

#include <array>

#include "model/photometry/photometry.h"
#include "render/color_space.h"

namespace skyfit {

// To a frame's primaries and to luminance, cd/m^2.
std::array<double, 16> light_from_nodes(const ColorRule& color, const ColorSpace& space);

// From light of another spectrum to light of the first star that has the same colour and luminance,
// the one of the least squares at the nodes; both rules have the same nodes.
std::array<double, 16> alike_nodes(const ColorRule& first, const ColorRule& other);

}  // namespace skyfit
