// SPDX-License-Identifier: Apache-2.0
// What a figure is drawn on, as the options of `skyfit plot` and `skyfit compare` say it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "render/plot/sheet.h"

namespace skyfit::cli {

struct FigureOptions {
  std::string style, width_mm, font_size, panels;
};

void add_figure_options(CLI::App& command, FigureOptions& options);

// The styles with what they stand for, for help texts.
std::string style_lines();

// A sheet for the screen where no option is given. Throws UsageError.
plot::Sheet parse_sheet(const FigureOptions& options);

}  // namespace skyfit::cli
