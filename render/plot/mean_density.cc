// SPDX-License-Identifier: Apache-2.0
#include "render/plot/mean_density.h"

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "model/shared/shared.h"
#include "render/plot/header.h"

namespace skyfit::plot {
namespace {

constexpr double kWidth = 900, kPanel = 290, kGround_m = 1500;

struct Panel {
  std::string_view what;
  double scale_height_m;
  std::string name() const {
    return fmt::format("{}: scale height {:.0f} km", what, 1e-3 * scale_height_m);
  }
};

void draw(Script& script, const Box& box, const Panel& panel) {
  script.line("$mean{:.0f} << EOD", panel.scale_height_m);
  for (int step = 4; step <= 120; ++step) {
    const double eye_km = 0.25 * step;
    const MeanDensity mean = mean_density(kGround_m, 1e3 * eye_km, panel.scale_height_m);
    script.line("{:.9g} {:.9g} {:.9g} {:.9g}", eye_km, mean.exact, mean.of_ends,
                mean.at_mean_height);
  }
  script.line("EOD");
  script.begin_axes(box);
  const double middle = box.left + box.width / 2;
  script.text_label(middle, box.top() + 14, panel.name(), "center font text_font");
  script.text_label(middle, box.bottom - (script.sheet().on_page() ? 30 : 40),
                    "height of the eye, km", "center font axis_font");
  script.line("set border 3 lc rgb '{0}'; set grid lt 1 lc rgb '{1}'", kFrameColor, kGridColor);
  script.line(
      "set xrange [1:30]; set yrange [0:1]; set xtics nomirror (1,5,10,15,20,25,30); set ytics "
      "nomirror 0.2");
  script.line(
      "plot $mean{0:.0f} using 1:2 with lines {1} notitle, '' using 1:3 with lines {2} notitle, '' "
      "using 1:4 with lines {3} notitle",
      panel.scale_height_m, mark_style(Mark::kSolidLine, kReferenceColor),
      mark_style(Mark::kSolidLine, kCurveColors[1]),
      mark_style(Mark::kDashedLine, kCurveColors[0]));
}

}  // namespace

MeanDensity mean_density(double from_m, double to_m, double scale_height_m) {
  Shared<double> shared;
  const double x = (to_m - from_m) / scale_height_m;
  const double share = std::abs(x) < 1e-9 ? 1 : -std::expm1(-x) / x;
  return {std::exp(-from_m / scale_height_m) * share,
          shared.nielsen_terrain_depth(from_m, to_m, 1, scale_height_m),
          shared.nielsen_mean_height_depth(from_m, to_m, 1, scale_height_m)};
}

Figure mean_density_figure(const Sheet& sheet) {
  Shared<double> shared;
  const std::array<Panel, 2> all = {{{"air", shared.nielsen_air_scale_height()},
                                     {"aerosol", shared.nielsen_aerosol_scale_height()}}};
  const std::vector<std::size_t> panels = sheet.chosen({all[0].name(), all[1].name()});
  const double width = sheet.width_px(kWidth);
  constexpr double kLeastBeside = 440;
  const std::size_t columns = width < kLeastBeside ? 1 : panels.size();
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  const double left = sheet.on_page() ? 52 : 80, right = 16, above = 26,
               below = sheet.on_page() ? 42 : 56, panel = sheet.on_page() ? 180 : kPanel;
  const Header header(sheet, width, "Mean density of a vertical path to ground at 1500 m",
                      "Nielsen 2003, figure 5.2",
                      {{Mark::kSolidLine, kReferenceColor, "integral"},
                       {Mark::kSolidLine, kCurveColors[1], "mean of the densities"},
                       {Mark::kDashedLine, kCurveColors[0], "density at the mean height"}});
  const double row = above + panel + below;
  Script script(width, header.height_px() + row * static_cast<double>(rows), sheet);
  script.line("set multiplot");
  script.begin_axes({0, 0, width, script.height()});
  header.draw(script);
  script.upright_lines(sheet.on_page() ? 10 : 20, (script.height() - header.height_px()) / 2,
                       script.height(), "mean density, that at height 0 = 1", "font axis_font");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  const Grid grid{columns, rows, {0, 0, width, row * static_cast<double>(rows)}};
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Box cell = grid.cell(k);
    draw(script, {cell.left + left, cell.bottom + below, cell.width - left - right, panel},
         all[panels[k]]);
  }
  script.line("unset multiplot");
  return figure_of(script);
}

}  // namespace skyfit::plot
