// SPDX-License-Identifier: Apache-2.0
#include "render/plot/mean_density.h"

#include <cmath>
#include <string_view>
#include <utility>

#include "model/shared/shared.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kWidth = 900, kHeight = 420, kGround_m = 1500;
constexpr Box kLeft{80, 70, 350, 290}, kRight{510, 70, 350, 290};

void draw(Script& script, const Box& box, std::string_view what, double scale_height_m,
          std::string_view heading) {
  script.line("$mean{:.0f} << EOD", scale_height_m);
  for (int step = 4; step <= 120; ++step) {
    const double eye_km = 0.25 * step;
    const MeanDensity mean = mean_density(kGround_m, 1e3 * eye_km, scale_height_m);
    script.line("{:.9g} {:.9g} {:.9g} {:.9g}", eye_km, mean.exact, mean.of_ends,
                mean.at_mean_height);
  }
  script.line("EOD");
  script.begin_axes(box);
  script.text_label(kLeft.left, kHeight - 22, heading, "left font ',13'");
  script.line("set border 3 lc rgb '{0}'; set grid lt 1 lc rgb '{1}'", kFrameColor, kGridColor);
  script.line(
      "set xrange [1:30]; set yrange [0:1]; set xtics nomirror (1,5,10,15,20,25,30); set ytics "
      "nomirror 0.2");
  script.line(
      "set xlabel 'height of the eye, km'; set ylabel 'mean density, that at height 0 = 1'");
  script.line("set title '{}: scale height {:.0f} km' noenhanced", what, 1e-3 * scale_height_m);
  script.line("set key top right samplen 2");
  script.line(
      "plot $mean{0:.0f} using 1:2 with lines lw 2 lc rgb '{1}' title 'integral', "
      "'' using 1:3 with lines lw 2 lc rgb '{2}' title 'mean of the densities', "
      "'' using 1:4 with lines lw 2 dt 2 lc rgb '{3}' title 'density at the mean height'",
      scale_height_m, kReferenceColor, kCurveColors[1], kCurveColors[0]);
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

Figure mean_density_figure() {
  Script script(kWidth, kHeight);
  Shared<double> shared;
  script.line("set multiplot");
  draw(script, kLeft, "air", shared.nielsen_air_scale_height(),
       "Mean density of a vertical path to ground at 1500 m (Nielsen 2003, figure 5.2)");
  draw(script, kRight, "aerosol", shared.nielsen_aerosol_scale_height(), "");
  script.line("unset multiplot");
  return {kWidth, kHeight, script.text()};
}

}  // namespace skyfit::plot
