// SPDX-License-Identifier: Apache-2.0
#include "render/plot/hemisphere_maps.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/base/misfit.h"
#include "model/numerics/angles.h"
#include "render/plot/color_scale.h"

namespace skyfit::plot {
namespace {

constexpr double kTitleStrip = 26;  // as in the panels, so that both grids' titles line up
constexpr double kMargin = 8;       // around a map

// Samples of one view zenith, by azimuth in 0..360.
using Ring = std::map<double, const Sample*>;

std::map<double, Ring> rings_of(const std::vector<Sample>& samples) {
  std::map<double, Ring> rings;
  for (const auto& sample : samples) {
    const double zenith = std::round(sample.view_zenith_deg * 1000) / 1000;
    const double azimuth = std::fmod(std::fmod(sample.relative_azimuth_deg, 360.0) + 360.0, 360.0);
    rings[zenith][std::round(azimuth * 1000) / 1000] = &sample;
  }
  return rings;
}

bool equally_spaced(const Ring& ring) {
  const double step = 360.0 / static_cast<double>(ring.size());
  double expected = ring.begin()->first;
  for (const auto& [azimuth, sample] : ring) {
    if (std::abs(azimuth - expected) > 0.1) return false;
    expected += step;
  }
  return true;
}

std::string color_of(const Sample& sample, double limit_percent) {
  return sample.weight > 0 ? diverging_color(100 * sample.residual(), limit_percent)
                           : std::string(kLeftOutColor);
}

void draw_sky(Script& script, const std::vector<Sample>& samples, double limit_percent) {
  const auto patches = patches_of(samples);
  for (const auto& patch : patches)
    script.line(
        "set object polygon from {} behind fs solid border lc rgb '#ffffff' lw 0.4 fc rgb '{}'",
        patch_outline(patch), color_of(*patch.sample, limit_percent));
  if (!patches.empty()) return;
  for (const auto& sample : samples)
    script.line(
        "set object circle at {} size 0.03 behind fs solid border lc rgb '{}' lw 0.3 fc rgb '{}'",
        polar_point(sample.view_zenith_deg, sample.relative_azimuth_deg), kFrameColor,
        color_of(sample, limit_percent));
}

void draw_frame(Script& script, double sun_zenith_deg, bool named) {
  for (const double zenith : {30.0, 60.0})
    script.line(
        "set object circle at 0,0 size {:.9g} front fs empty border lc rgb '#606060' lw 0.5",
        zenith / 90);
  script.line("set object circle at 0,0 size 1 front fs empty border lc rgb '{}' lw 1",
              kFrameColor);
  script.line("set label '☉' at {} center front font sun_font textcolor rgb '#000000'",
              polar_point(sun_zenith_deg, 0));
  if (!named) return;
  for (const double zenith : {30.0, 60.0, 90.0})
    script.line("set label '{:.0f}°' at {} center front font small_font textcolor rgb '#303030'",
                zenith, polar_point(zenith - 7, 90));
}

void draw_map(Script& script, const SunSamples& sun, std::size_t curve, const Box& cell,
              double limit_percent, bool named) {
  const double side = std::min(cell.width, cell.height - kTitleStrip) - kMargin;
  const double centre = cell.left + cell.width / 2;
  const Box box{centre - side / 2, cell.top() - kTitleStrip - side, side, side};
  script.begin_axes(box);
  script.line("set xrange [-1.01:1.01]; set yrange [-1.01:1.01]");
  draw_sky(script, sun.hemisphere[curve], limit_percent);
  draw_frame(script, sun.sun_zenith_deg, named && side > 150);
  const double rms = rms_log_percent(sun.hemisphere[curve]);
  const bool wide = cell.width > 170;
  const std::string error =
      std::isnan(rms) ? "no samples"
                      : fmt::format("{}{}", wide ? "RMS " : "", log_misfit_with_unit(rms, 1));
  script.text_label(centre, box.top() + kTitleStrip / 2 - 1,
                    fmt::format("☉ {:.4g}°   {}", sun.sun_zenith_deg, error),
                    wide ? "center font text_font" : "center font small_font");
  script.line("plot NaN notitle");
}

void draw_scale(Script& script, const Box& box, double limit_percent) {
  std::vector<Tick> ticks;
  for (const double at : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const double percent = limit_percent * (2 * at - 1);
    ticks.push_back({at, is_factor(limit_percent) ? fmt::format("×{:.2g}", std::exp(percent / 100))
                                                  : fmt::format("{:g}", percent)});
  }
  draw_color_scale(script, box, ticks, residual_scale_title(limit_percent),
                   [](double at) { return diverging_color(2 * at - 1, 1); });
}

Grid grid_of(std::size_t columns, std::size_t count, const Box& area) {
  return {columns, (count + columns - 1) / columns, area};
}

double map_side(const Box& cell) { return std::min(cell.width, cell.height - kTitleStrip); }

Box below_label(Box block) {
  block.height -= kTitleStrip;
  return block;
}

// The grid of `count` cells that leaves the largest maps in the area.
Grid best_grid(std::size_t count, const Box& area) {
  Grid best = grid_of(1, count, area);
  for (std::size_t columns = 2; columns <= count; ++columns) {
    const Grid grid = grid_of(columns, count, area);
    if (map_side(grid.cell(0)) > map_side(best.cell(0))) best = grid;
  }
  return best;
}

// The grid of one block per curve that leaves the largest maps of `suns` suns in each.
Grid best_blocks(std::size_t curves, std::size_t suns, const Box& area) {
  const auto side = [suns](const Grid& blocks) {
    return map_side(best_grid(suns, below_label(blocks.cell(0))).cell(0));
  };
  Grid best = grid_of(1, curves, area);
  for (std::size_t columns = 2; columns <= curves; ++columns) {
    const Grid blocks = grid_of(columns, curves, area);
    if (side(blocks) > side(best)) best = blocks;
  }
  return best;
}

void draw_block_label(Script& script, const Box& block, const std::string& label,
                      std::size_t curve) {
  script.begin_axes(block);
  script.text_label(block.left, block.top() - kTitleStrip / 2, label,
                    fmt::format("left font text_font textcolor rgb '{}'", kCurveColors[curve]));
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
}

}  // namespace

std::string polar_point(double zenith_deg, double azimuth_deg) {
  const double azimuth = azimuth_deg * kRadiansPerDegree;
  return fmt::format("{:.5f},{:.5f}", zenith_deg / 90 * std::cos(azimuth),
                     zenith_deg / 90 * std::sin(azimuth));
}

std::string patch_outline(const Patch& patch) {
  const int steps = std::max(1, static_cast<int>(std::ceil(patch.width_deg / 3)));
  const double first = patch.azimuth_deg - patch.width_deg / 2, step = patch.width_deg / steps;
  std::string points;
  for (int i = 0; i <= steps; ++i)
    points += polar_point(patch.outer_zenith_deg, first + i * step) + " to ";
  if (patch.inner_zenith_deg > 0)
    for (int i = steps; i >= 0; --i)
      points += polar_point(patch.inner_zenith_deg, first + i * step) + " to ";
  return points + polar_point(patch.outer_zenith_deg, first);
}

std::vector<Patch> patches_of(const std::vector<Sample>& samples) {
  const auto rings = rings_of(samples);
  if (rings.size() < 3) return {};
  std::vector<Patch> patches;
  double inner = 0;
  for (auto ring = rings.begin(); ring != rings.end(); ++ring) {
    const auto next = std::next(ring);
    const double zenith = ring->first;
    const double outer =
        next != rings.end() ? (zenith + next->first) / 2 : std::min(2 * zenith - inner, 90.0);
    const auto count = static_cast<double>(ring->second.size());
    const bool is_ring = zenith == 0 ? count == 1 : count >= 6 && equally_spaced(ring->second);
    if (!is_ring || zenith < 0 || outer > 90) return {};
    for (const auto& [azimuth, sample] : ring->second)
      patches.push_back({sample, inner, outer, azimuth, 360 / count});
    inner = outer;
  }
  return patches;
}

double residual_limit_percent(const Suns& suns) {
  std::vector<double> sizes;
  for (const auto& sun : suns.shown)
    for (const auto& sky : sun.hemisphere)
      for (const auto& sample : sky)
        if (sample.weight > 0) sizes.push_back(100 * std::abs(sample.residual()));
  if (sizes.empty()) return 1;
  const auto rank = static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, sizes.begin() + rank);
  return round_up(std::max(sizes[static_cast<std::size_t>(rank)], 0.01));
}

std::string residual_scale_title(double limit_percent) {
  return fmt::format(
      "{}   blue: too dark, red: too bright, grey: left out",
      is_factor(limit_percent) ? "model / reference" : "100 ln(model / reference), %");
}

void draw_hemisphere_maps(Script& script, const Comparison& comparison, const Suns& suns,
                          const Box& area, const Box& scale) {
  const std::size_t curves = comparison.curves.size(), count = suns.shown.size();
  const double limit = residual_limit_percent(suns);
  const Grid blocks = best_blocks(curves, count, area);
  for (std::size_t curve = 0; curve < curves; ++curve) {
    const Box block = blocks.cell(curve);
    if (curves > 1) draw_block_label(script, block, comparison.curves[curve].label, curve);
    // On a screen one curve's maps stand beside the panels of their suns.
    const bool aligned = curves == 1 && !script.sheet().on_page();
    const Grid grid = aligned ? grid_of(panel_columns(count), count, area)
                              : best_grid(count, curves > 1 ? below_label(block) : block);
    for (std::size_t i = 0; i < count; ++i)
      draw_map(script, suns.shown[i], curve, grid.cell(i), limit, curve == 0 && i == 0);
  }
  draw_scale(script, scale, limit);
}

}  // namespace skyfit::plot
