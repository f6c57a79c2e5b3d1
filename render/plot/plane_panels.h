// SPDX-License-Identifier: Apache-2.0
// The panels of the principal plane: luminance over view zenith, one panel per sun position.
#pragma once

#include <vector>

#include "render/plot/legend.h"
#include "render/plot/script.h"
#include "render/plot/suns.h"

namespace skyfit::plot {

std::vector<LegendEntry> plane_legend(const Comparison& comparison, const Suns& suns);

// What of a cell's height stands above its panel.
double plane_strip_px(const Sheet& sheet, double cell_width_px, const Suns& suns);

void draw_plane_panels(Script& script, const Comparison& comparison, const Suns& suns,
                       const Grid& grid);

}  // namespace skyfit::plot
