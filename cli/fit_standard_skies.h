// SPDX-License-Identifier: Apache-2.0
// The figure of `skyfit fit --reference cie:all`, which the notebook of the standard skies draws
// too.
#pragma once

#include <span>

#include "fit/standard_sky_table.h"
#include "render/plot/figure_file.h"

namespace skyfit::cli {

// RMS of log ratio in percent, a row for each fit and a column for each sun of the first one.
plot::Figure standard_skies_figure(std::span<const fit::StandardSkyFit> fits);

}  // namespace skyfit::cli
