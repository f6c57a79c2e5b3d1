// SPDX-License-Identifier: Apache-2.0
// The misfit of every standard sky by sun: a row per type, a cell per sun, colour and number by the
// RMS of the log ratio.
#pragma once

#include <string>
#include <vector>

#include "render/plot/figure_file.h"

namespace skyfit::plot {

struct StandardSkyRow {
  int type = 0;
  std::string description, fitted_with;
  double rms_percent = 0;                  // of all suns together
  std::vector<double> rms_percent_of_sun;  // of each
};

// One cell per sun of `sun_zenith_deg`; rows have as many. Throws std::invalid_argument otherwise.
Figure standard_skies_figure(const std::vector<double>& sun_zenith_deg,
                             const std::vector<StandardSkyRow>& rows);

}  // namespace skyfit::plot
