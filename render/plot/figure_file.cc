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

constexpr double kScreenPixelsPerInch = 100;  // of a PDF
constexpr double kPagePixelsPerInch = 300;    // of a PNG
constexpr double kMillimetresPerInch = 25.4;

// gnuplot draws text of 9 points 12 pixels high in all three at fontscale 1.333, 1 and 0.72.
std::string terminal(const std::string& extension, const Figure& figure) {
  const Sheet& sheet = figure.sheet;
  const double per_inch =
      sheet.on_page() ? sheet.pixels_per_mm() * kMillimetresPerInch : kScreenPixelsPerInch;
  if (extension == ".svg")
    return fmt::format(
        "svg size {:.0f},{:.0f} dynamic font 'DejaVu Sans,9' fontscale 1.333 linewidth {:g} "
        "background '#ffffff' name 'skyfit'",
        figure.width_px, figure.height_px, sheet.line_scale);
  if (extension == ".png") {
    const double scale = sheet.on_page() ? kPagePixelsPerInch / per_inch : 1;
    return fmt::format(
        "pngcairo size {:.0f},{:.0f} font 'DejaVu Sans,9' fontscale {:.6g} linewidth {:.6g} "
        "pointscale {:.6g} background '#ffffff'",
        scale * figure.width_px, scale * figure.height_px, scale, scale * sheet.line_scale, scale);
  }
  const double points = 72 / per_inch;  // a pixel's
  return fmt::format(
      "pdfcairo size {:.9g}in,{:.9g}in font 'DejaVu Sans,9' fontscale {:.6g} linewidth {:.6g} "
      "pointscale {:.6g} background '#ffffff'",
      figure.width_px / per_inch, figure.height_px / per_inch, points,
      1.7 * points / 0.72 * sheet.line_scale, points / 0.72);
}

// gnuplot knows sizes of an SVG in pixels only.
void state_size_of_svg(const std::filesystem::path& file, const Figure& figure) {
  const double per_mm = figure.sheet.pixels_per_mm();
  std::string svg = read_file(file, "a picture", kMostImageBytes);
  const std::size_t place = svg.find(" viewBox=");
  if (place == svg.npos) throw std::runtime_error("gnuplot's SVG has no viewBox");
  svg.insert(place, fmt::format(" width=\"{:.6g}mm\" height=\"{:.6g}mm\"\n",
                                figure.width_px / per_mm, figure.height_px / per_mm));
  write_file(file, svg);
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
  run_gnuplot(fmt::format("set encoding utf8\nset minussign\n{}set terminal {}\nset output "
                          "'{}'\n{}unset output\n",
                          font_names(figure.sheet), terminal(extension, figure),
                          file.filename().string(), figure.body),
              file.parent_path());
  if (!std::filesystem::exists(file)) throw std::runtime_error("gnuplot left no picture");
  if (!is_complete(read_file(file, "a picture", kMostImageBytes), extension))
    throw std::runtime_error("gnuplot left half a picture, as on a full disk");
  if (extension == ".svg" && figure.sheet.on_page()) state_size_of_svg(file, figure);
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
