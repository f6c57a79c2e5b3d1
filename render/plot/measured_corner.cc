// SPDX-License-Identifier: Apache-2.0
// The covariance as a corner: on the diagonal the normal density of each unknown, below it the
// ellipses that hold 39 and 86 % (1 and 2 sigma) of each pair.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "render/plot/measured_figures.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kCell = 92, kLeft = 240, kBottom = 150, kHeader = 70, kRight = 20, kSigmas = 3;
constexpr std::size_t kMostUnknowns = 16;

struct Corner {
  std::vector<std::string> name;
  std::vector<double> mean, sigma;
  std::vector<std::vector<double>> correlation;
};

double fitted_value(const MeasuredOutcome& outcome, const std::string& name) {
  const auto found = std::ranges::find(outcome.unknowns, name, &MeasuredUnknown::name);
  if (found == outcome.unknowns.end())
    throw std::invalid_argument(fmt::format(
        "figure corner: covariance_unknowns: {}: expected one of the fit's unknowns", name));
  return found->fitted;
}

Corner corner_of(const MeasuredOutcome& outcome) {
  const std::size_t count = outcome.covariance.size();
  if (count < 2)
    throw std::invalid_argument(
        fmt::format("figure corner: a covariance of {} unknowns, expected at least 2", count));
  Corner corner;
  const std::size_t shown = std::min(count, kMostUnknowns);
  for (std::size_t i = 0; i < shown; ++i) {
    corner.name.push_back(outcome.covariance_unknowns.at(i));
    corner.mean.push_back(fitted_value(outcome, corner.name.back()));
    corner.sigma.push_back(std::sqrt(outcome.covariance[i].at(i)));
  }
  for (std::size_t i = 0; i < shown; ++i) {
    corner.correlation.emplace_back();
    for (std::size_t j = 0; j < shown; ++j)
      corner.correlation.back().push_back(outcome.covariance[i].at(j) /
                                          (corner.sigma[i] * corner.sigma[j]));
  }
  return corner;
}

Box cell_of(std::size_t row, std::size_t column, std::size_t count) {
  return {kLeft + kCell * static_cast<double>(column),
          kBottom + kCell * static_cast<double>(count - 1 - row), kCell - 5, kCell - 5};
}

// Closed ellipses of 1 and 2 sigma in units of sigma.
void draw_pair(Script& script, const Box& box, double correlation) {
  constexpr int kSteps = 48;
  script.begin_axes(box);
  script.line("set border 15 lc rgb '{}' lw 0.6; set xrange [{}:{}]; set yrange [{}:{}]",
              kFrameColor, -kSigmas, kSigmas, -kSigmas, kSigmas);
  const double across = std::sqrt(std::max(0.0, 1 - correlation * correlation));
  for (const int level : {2, 1}) {
    std::string points;
    for (int k = 0; k <= kSteps; ++k) {
      const double angle = 2 * std::numbers::pi * k / kSteps;
      const double x = level * std::cos(angle);
      const double y = level * (correlation * std::cos(angle) + across * std::sin(angle));
      points += fmt::format("{}{:.4f},{:.4f}", k == 0 ? "" : " to ", x, y);
    }
    script.line("set object polygon from {} behind fs solid noborder fc rgb '{}'", points,
                level == 2 ? "#c6dbef" : "#4292c6");
  }
  if (std::abs(correlation) >= 0.5)
    script.text_label(box.left + 4, box.bottom + 10, fmt::format("{:.2f}", correlation),
                      "left front font ',9' textcolor rgb '#303030'");
  script.line("plot NaN notitle");
}

void draw_density(Script& script, const Box& box) {
  script.begin_axes(box);
  script.line(
      "set border 15 lc rgb '{}' lw 0.6; set xrange [{}:{}]; set yrange [0:1.15]; set "
      "samples 120",
      kFrameColor, -kSigmas, kSigmas);
  script.line(
      "plot exp(-0.5*x*x) with filledcurves y1=0 fc rgb '#c6dbef' notitle, exp(-0.5*x*x) "
      "with lines lw 1.5 lc rgb '{}' notitle",
      kCurveColors[0]);
}

}  // namespace

Figure corner_figure(const MeasuredOutcome& outcome) {
  const Corner corner = corner_of(outcome);
  const std::size_t count = corner.name.size();
  const double side = kCell * static_cast<double>(count);
  Script script(kLeft + side + kRight, kBottom + side + kHeader);
  script.line("set multiplot");
  script.begin_axes({0, 0, script.width(), script.height()});
  script.text_label(16, script.height() - 24, "Covariance, " + short_name(outcome.title),
                    "left font ',18'");
  script.text_label(16, script.height() - 48,
                    "ellipses of 1 and 2 sigma over ±3 sigma of each unknown; correlations of at "
                    "least 0.5 in figures",
                    "left font ',12' textcolor rgb '#404040'");
  for (std::size_t i = 0; i < count; ++i) {
    const Box row = cell_of(i, 0, count), column = cell_of(count - 1, i, count);
    script.text_label(kLeft - 8, row.bottom + row.height / 2 + 8, corner.name[i],
                      "right font ',10'");
    script.text_label(kLeft - 8, row.bottom + row.height / 2 - 8,
                      fmt::format("{:.4g} ± {:.2g}", corner.mean[i], corner.sigma[i]),
                      "right font ',10' textcolor rgb '#404040'");
    script.text_label(column.left + column.width / 2, kBottom - 10, corner.name[i],
                      "right rotate by 40 font ',9'");
  }
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  for (std::size_t i = 0; i < count; ++i) {
    draw_density(script, cell_of(i, i, count));
    for (std::size_t j = 0; j < i; ++j)
      draw_pair(script, cell_of(i, j, count), corner.correlation[i][j]);
  }
  script.line("unset multiplot");
  return {script.width(), script.height(), script.text()};
}

}  // namespace skyfit::plot
