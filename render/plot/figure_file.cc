// SPDX-License-Identifier: Apache-2.0
#include "render/plot/figure_file.h"

#include <fmt/format.h>

#include <stdexcept>

#include "render/plot/gnuplot.h"
#include "render/plot/whole_files.h"

namespace skyfit::plot {
namespace {

constexpr double kPixelsPerInch = 100;

std::string terminal(const std::string& extension, const Figure& figure) {
  if (extension == ".svg")
    return fmt::format(
        "svg size {:.0f},{:.0f} dynamic font 'DejaVu Sans,9' fontscale 1.333 background '#ffffff' "
        "name 'skyfit'",
        figure.width_px, figure.height_px);
  if (extension == ".png")
    return fmt::format("pngcairo size {:.0f},{:.0f} font 'DejaVu Sans,9' background '#ffffff'",
                       figure.width_px, figure.height_px);
  return fmt::format(
      "pdfcairo size {:.9g}in,{:.9g}in font 'DejaVu Sans,9' fontscale 0.72 linewidth 1.7 "
      "background '#ffffff'",
      figure.width_px / kPixelsPerInch, figure.height_px / kPixelsPerInch);
}

// gnuplot may end well without having drawn: what it left must be there.
void check_drawn(const std::filesystem::path& drawn, const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(drawn, error);
  if (error || size == 0)
    throw std::runtime_error(fmt::format("{}: gnuplot left no picture", file.string()));
}

}  // namespace

void check_figure_files(const std::vector<std::filesystem::path>& files) {
  for (const auto& file : files) {
    const std::string extension = file.extension().string();
    if (extension != ".svg" && extension != ".png" && extension != ".pdf")
      throw std::invalid_argument(fmt::format("{}: extension \"{}\": expected .svg, .png or .pdf",
                                              file.string(), extension));
  }
}

void write_figure(const Figure& figure, const std::vector<std::filesystem::path>& files) {
  check_figure_files(files);
  WholeFiles whole(files);
  std::string script = "set encoding utf8\nset minussign\n";
  for (std::size_t i = 0; i < files.size(); ++i)
    script += fmt::format("reset\nset terminal {}\nset output {}\n{}unset output\n",
                          terminal(files[i].extension().string(), figure),
                          gnuplot_quoted(whole.temporary(i).string()), figure.body);
  run_gnuplot(script);
  for (std::size_t i = 0; i < files.size(); ++i) check_drawn(whole.temporary(i), files[i]);
  whole.commit();
}

}  // namespace skyfit::plot
