// SPDX-License-Identifier: Apache-2.0
// A figure as files: .svg, .png or .pdf, all of them or none.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/plot/script.h"

namespace skyfit::plot {

struct Figure {
  double width_px = 0, height_px = 0;
  Sheet sheet;       // a page says how large the pixels are
  std::string body;  // gnuplot commands, see Script
};
inline Figure figure_of(const Script& script) {
  return {script.width(), script.height(), script.sheet(), script.text()};
}

// Throws std::invalid_argument that names the file whose extension is none of the three.
void check_figure_files(const std::vector<std::filesystem::path>& files);

// Throws as check_figure_files() does, or std::runtime_error (cannot write; gnuplot), with one
// line.
void write_figure(const Figure& figure, const std::vector<std::filesystem::path>& files);

}  // namespace skyfit::plot
