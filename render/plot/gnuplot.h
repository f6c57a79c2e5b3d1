// SPDX-License-Identifier: Apache-2.0
// Runs gnuplot on a script. Text of a user gets into a script through gnuplot_quoted() only.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace skyfit::plot {

// A text as gnuplot reads it: in double quotes, every ASCII character but letters, digits and the
// plainest marks as an octal escape, so that none has a meaning of its own. Single quotes would not
// do: gnuplot 5.4 ends such a text at its second quote in a row. It stands on one line, in UTF-8
// and without control characters. Where it is drawn, `noenhanced` keeps ^, _, @, & and {} as they
// are.
std::string gnuplot_quoted(std::string_view text);

// Runs the script in a folder, with gnuplot's own defaults (no user start-up file) and no shell in
// between. The program is the environment variable SKYFIT_GNUPLOT, or `gnuplot` on the PATH. Throws
// std::runtime_error with one line when gnuplot is missing or fails.
void run_gnuplot(const std::string& script, const std::filesystem::path& folder);

}  // namespace skyfit::plot
