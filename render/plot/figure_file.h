// SPDX-License-Identifier: Apache-2.0
// One figure as files of several formats.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace skyfit::plot {

struct Figure {
  double width = 0, height = 0;  // pixels
  std::string body;              // gnuplot, between `set multiplot` and `unset multiplot`
};

// Throws std::invalid_argument unless every extension is .svg, .png or .pdf.
void check_figure_extensions(const std::vector<std::filesystem::path>& files);

// All files appear whole, or none does. Throws std::invalid_argument (extension) or
// std::runtime_error (cannot write; gnuplot) with one line.
void write_figure(const Figure& figure, const std::vector<std::filesystem::path>& files);

}  // namespace skyfit::plot
