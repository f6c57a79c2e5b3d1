// SPDX-License-Identifier: Apache-2.0
// Runs gnuplot on a script.
#pragma once

#include <string>
#include <string_view>

namespace skyfit::plot {

// A string as gnuplot reads it: in single quotes, control characters replaced by spaces.
std::string gnuplot_quoted(std::string_view text);

// Runs the script with gnuplot's own defaults (no user start-up file) and no shell in between. The
// program is the environment variable SKYFIT_GNUPLOT, or `gnuplot` on the PATH. Throws
// std::runtime_error with one line when gnuplot is missing or fails.
void run_gnuplot(const std::string& script);

}  // namespace skyfit::plot
