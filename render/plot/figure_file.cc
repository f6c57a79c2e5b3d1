// SPDX-License-Identifier: Apache-2.0
#include "render/plot/figure_file.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "model/base/input_file.h"
#include "model/base/text.h"
#include "model/base/whole_file.h"
#include "render/plot/gnuplot.h"

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

// gnuplot may end well on a full disk: the picture must end as its format does.
bool is_complete(std::string_view picture, const std::string& extension) {
  using namespace std::string_view_literals;
  if (extension == ".png") return picture.ends_with("\0\0\0\0IEND\xae\x42\x60\x82"sv);
  return trim(picture).ends_with(extension == ".svg" ? "</svg>" : "%%EOF");
}

// Draws where the file lies and under its name there, which are our own: a name that starts with |
// would be a command to gnuplot, and ~ a user's home.
void draw(const Figure& figure, const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  run_gnuplot(fmt::format("set encoding utf8\nset minussign\nset terminal {}\nset output '{}'\n{}"
                          "unset output\n",
                          terminal(extension, figure), file.filename().string(), figure.body),
              file.parent_path());
  if (!std::filesystem::exists(file)) throw std::runtime_error("gnuplot left no picture");
  if (!is_complete(read_file(file, "a picture", kMostImageBytes), extension))
    throw std::runtime_error("gnuplot left half a picture, as on a full disk");
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
  for (std::size_t i = 0; i < files.size(); ++i) {
    try {
      draw(figure, whole.temporary(i));
    } catch (const std::runtime_error& error) {
      whole.fail(i, error.what());
    }
  }
  whole.publish();
}

}  // namespace skyfit::plot
