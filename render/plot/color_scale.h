// SPDX-License-Identifier: Apache-2.0
// A bar of colours with ticks and a title below it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "render/plot/script.h"

namespace skyfit::plot {

// `color_at` is that of a place 0 .. 1 from the left; so are the positions of the ticks.
void draw_color_scale(Script& script, const Box& box, const std::vector<Tick>& ticks,
                      std::string_view title, const std::function<std::string(double)>& color_at);

}  // namespace skyfit::plot
