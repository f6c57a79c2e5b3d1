// SPDX-License-Identifier: Apache-2.0
#include "render/plot/fisheye.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "model/photometry/srgb_transfer.h"
#include "render/plot/header.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr int kPixels = 96;  // of a sky's side
constexpr double kTile = 128, kPageTile = 200, kLabel = 170, kFooter = 34;
constexpr double kPi = std::numbers::pi;
using Rgb = std::array<double, 3>;

double luminance(const Rgb& rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

Rgb at_direction(const FisheyeSky& sky, double zenith, double azimuth) {
  const double z = std::clamp(zenith / (0.5 * kPi), 0.0, 1.0) * (FisheyeSky::kZeniths - 1);
  const double a = std::abs(azimuth) / kPi * (FisheyeSky::kAzimuths - 1);
  const int i = std::min(static_cast<int>(z), FisheyeSky::kZeniths - 2),
            k = std::min(static_cast<int>(a), FisheyeSky::kAzimuths - 2);
  const auto texel = [&](int di, int dk) {
    return sky.rgb[static_cast<std::size_t>((i + di) * FisheyeSky::kAzimuths + k + dk)];
  };
  Rgb mean{};
  for (int di = 0; di < 2; ++di) {
    for (int dk = 0; dk < 2; ++dk) {
      const double weight = (di ? z - i : 1 - z + i) * (dk ? a - k : 1 - a + k);
      for (std::size_t c = 0; c < 3; ++c) mean[c] += weight * texel(di, dk)[c];
    }
  }
  return mean;
}

// The inverse of the median luminance over the whole of a row: shown at 1 - exp(-0.5) = 0.4.
double exposure_of(const FisheyeRow& row) {
  std::vector<double> values;
  for (const auto& sky : row.skies) {
    if (!sky) continue;
    for (const Rgb& rgb : sky->rgb) {
      if (luminance(rgb) > 0) values.push_back(luminance(rgb));
    }
  }
  if (values.empty()) throw std::invalid_argument("figure: the first row of skies is dark");
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return 0.5 / values[values.size() / 2];
}

int byte_of(double linear) {
  return static_cast<int>(std::lround(255 * srgb_encoded(std::clamp(linear, 0.0, 1.0))));
}

// Rows `x y r g b`; the sun's side is to the right. What is beyond the horizon has the horizon's
// colour, so that the rim cuts through pixels.
void write_pixels(Script& script, const std::string& name, const FisheyeSky& sky, double exposure) {
  script.line("${} << EOD", name);
  for (int j = 0; j < kPixels; ++j) {
    for (int i = 0; i < kPixels; ++i) {
      const double x = 2 * (i + 0.5) / kPixels - 1, y = 2 * (j + 0.5) / kPixels - 1;
      const Rgb linear = at_direction(sky, 0.5 * kPi * std::hypot(x, y), std::atan2(y, x));
      int rgb[3];
      for (std::size_t c = 0; c < 3; ++c)
        rgb[c] = byte_of(-std::expm1(-exposure * std::max(linear[c], 0.0)));
      script.line("{} {} {} {} {}", i, j, rgb[0], rgb[1], rgb[2]);
    }
  }
  script.line("EOD");
}

// Rows `x y` of the rim, the horizon, and of the outline of what is beyond it: around the picture,
// then back around the rim.
void write_rim(Script& script) {
  constexpr int kCorners = 180;
  constexpr double kMiddle = 0.5 * (kPixels - 1), kRadius = 0.5 * kPixels;
  std::vector<std::string> rim;
  for (int i = kCorners; i >= 0; --i) {
    const double turn = 2 * kPi * i / kCorners;
    rim.push_back(fmt::format("{:.3f} {:.3f}", kMiddle + kRadius * std::cos(turn),
                              kMiddle + kRadius * std::sin(turn)));
  }
  script.line("$rim << EOD\n{}\nEOD", fmt::join(rim, "\n"));
  script.line("$beyond << EOD");
  for (const auto& [x, y] : {std::pair{1, 0}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 0}})
    script.line("{} {}", kMiddle + x * kPixels, kMiddle + y * kPixels);
  script.line("{}\nEOD", fmt::join(rim, "\n"));
}

std::vector<std::size_t> chosen_suns(const FisheyeFigure& figure, const Sheet& sheet) {
  std::vector<std::string> names;
  for (const double sun : figure.sun_zenith_deg)
    names.push_back(fmt::format("sun zenith {:.4g}°", sun));
  return sheet.chosen(names);
}

}  // namespace

FisheyeSky fisheye_sky(const SkyModel& model, const Atmosphere<double>& atmosphere,
                       const SpectralData& spectra, double sun_zenith) {
  constexpr double kAlmostHorizon = 89.9 / 90;
  std::vector<SkyPoint> points;
  for (int i = 0; i < FisheyeSky::kZeniths; ++i) {
    for (int k = 0; k < FisheyeSky::kAzimuths; ++k) {
      const double share = i / (FisheyeSky::kZeniths - 1.0);
      points.push_back({0, sun_zenith, 0.5 * kPi * std::min(share, kAlmostHorizon),
                        kPi * k / (FisheyeSky::kAzimuths - 1.0)});
    }
  }
  const ColorRule rule = color_rule(spectra);
  const SkyValues sky = model.radiance(atmosphere, rule.nodes, points, {});
  FisheyeSky picture;
  for (int p = 0; p < sky.points; ++p) {
    Rgb rgb{};
    for (std::size_t c = 0; c < 3; ++c) {
      double xyz = 0;
      for (std::size_t k = 0; k < 4; ++k)
        xyz += rule.xyz_from_nodes[c][k] * sky.at(p, static_cast<int>(k));
      for (std::size_t r = 0; r < 3; ++r) rgb[r] += kLinearSrgbFromXyz[r][c] * xyz;
    }
    picture.rgb.push_back(rgb);
  }
  return picture;
}

Figure fisheye_figure(const FisheyeFigure& figure, const Sheet& sheet) {
  if (figure.rows.empty())
    throw std::invalid_argument("figure: expected at least one row of skies");
  const double exposure = exposure_of(figure.rows.front());
  const std::vector<std::size_t> suns = chosen_suns(figure, sheet);
  const auto columns = static_cast<double>(suns.size()),
             rows = static_cast<double>(figure.rows.size());
  const double width = sheet.width_px(std::max(kLabel + kTile * columns + 20, 620.0));
  // On a page the names of the models stand above their rows.
  const double left = sheet.on_page() ? 4 : kLabel, above = sheet.on_page() ? sheet.line_px() : 0;
  const double tile = sheet.on_page() ? std::min((width - 2 * left) / columns, kPageTile) : kTile;
  const Header header(sheet, width, figure.title,
                      "centre zenith, rim horizon, sun's side right; one exposure for all");
  const double angles = sheet.line_px();  // the row of the suns
  const double footer = sheet.on_page() ? 4 : kFooter;
  Script script(width, header.height_px() + angles + (tile + above) * rows + footer, sheet);
  const auto bottom_of = [&](std::size_t row) {
    return footer + (tile + above) * (rows - 1 - static_cast<double>(row));
  };
  write_rim(script);
  script.line("set multiplot");
  for (std::size_t r = 0; r < figure.rows.size(); ++r) {
    for (std::size_t s = 0; s < suns.size(); ++s) {
      const std::optional<FisheyeSky>& sky = figure.rows[r].skies[suns[s]];
      if (!sky) continue;
      const std::string name = fmt::format("r{}s{}", r, s);
      write_pixels(script, name, *sky, exposure);
      script.begin_axes(
          {left + tile * static_cast<double>(s) + 4, bottom_of(r) + 4, tile - 8, tile - 8});
      script.line("unset border; set xrange [-1:{0}]; set yrange [-1:{0}]", kPixels);
      script.line(
          "plot ${} using 1:2:3:4:5 with rgbimage notitle, $beyond using 1:2 with filledcurves "
          "closed fillcolor rgb 'white' fillstyle solid 1 noborder notitle, $rim using 1:2 with "
          "lines linecolor rgb '#999999' linewidth 0.5 notitle",
          name);
    }
  }
  script.begin_axes({0, 0, script.width(), script.height()});
  script.line("unset border");
  header.draw(script);
  for (std::size_t s = 0; s < suns.size(); ++s) {
    script.text_label(left + tile * (static_cast<double>(s) + 0.5),
                      script.height() - header.height_px() - angles / 2 + 2,
                      fmt::format("☉ {:.4g}°", figure.sun_zenith_deg[suns[s]]),
                      "center font text_font");
  }
  for (std::size_t r = 0; r < figure.rows.size(); ++r) {
    const double middle = bottom_of(r) + tile / 2;
    script.text_label(sheet.on_page() ? left : 16,
                      middle + (sheet.on_page() ? (tile + above) / 2 : 0), figure.rows[r].label,
                      "left font text_font");
    for (std::size_t s = 0; s < suns.size(); ++s) {
      if (!figure.rows[r].skies[suns[s]])
        script.text_label(left + tile * (static_cast<double>(s) + 0.5), middle, "–",
                          "center font text_font");
    }
  }
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  script.line("unset multiplot");
  return figure_of(script);
}

}  // namespace skyfit::plot
