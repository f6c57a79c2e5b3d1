// SPDX-License-Identifier: Apache-2.0
// The covariance as a corner: on the diagonal the normal density of each unknown, below it the
// ellipses that hold 39 and 86 % (1 and 2 sigma) of each pair.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "render/plot/header.h"
#include "render/plot/measured_figures.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kCell = 92, kLeft = 240, kBottom = 150, kRight = 20, kSigmas = 3;
constexpr std::size_t kMostUnknowns = 16;

struct Corner {
  std::vector<std::string> name, value;  // value: with one sigma and unit
  std::vector<double> sigma;
  std::vector<std::vector<double>> correlation;
};

const MeasuredUnknown& unknown_of(const MeasuredOutcome& outcome, const std::string& name) {
  const auto found = std::ranges::find(outcome.unknowns, name, &MeasuredUnknown::name);
  if (found == outcome.unknowns.end())
    throw std::invalid_argument(fmt::format(
        "figure corner: covariance_unknowns: {}: expected one of the fit's unknowns", name));
  return *found;
}

Corner corner_of(const MeasuredOutcome& outcome, const Sheet& sheet) {
  const std::size_t count = outcome.covariance.size();
  if (count < 2)
    throw std::invalid_argument(
        fmt::format("figure corner: a covariance of {} unknowns, expected at least 2", count));
  Corner corner;
  const std::vector<std::string> all(
      outcome.covariance_unknowns.begin(),
      outcome.covariance_unknowns.begin() +
          static_cast<std::ptrdiff_t>(std::min(count, kMostUnknowns)));
  const std::vector<std::size_t> places = sheet.chosen(all);
  for (const std::size_t i : places) {
    corner.name.push_back(outcome.covariance_unknowns.at(i));
    corner.sigma.push_back(std::sqrt(outcome.covariance[i].at(i)));
    const MeasuredUnknown& unknown = unknown_of(outcome, corner.name.back());
    corner.value.push_back(fmt::format("{:.4g} ± {:.2g}{}", unknown.fitted, corner.sigma.back(),
                                       unknown.unit == "1" ? "" : " " + unknown.unit));
  }
  for (std::size_t a = 0; a < places.size(); ++a) {
    corner.correlation.emplace_back();
    for (std::size_t b = 0; b < places.size(); ++b)
      corner.correlation.back().push_back(outcome.covariance[places[a]].at(places[b]) /
                                          (corner.sigma[a] * corner.sigma[b]));
  }
  return corner;
}

// On a page unknowns have numbers at the axes, which a list below the corner explains.
struct Frame {
  double cell, left, bottom;
  Box box(std::size_t row, std::size_t column, std::size_t count) const {
    return {left + cell * static_cast<double>(column),
            bottom + cell * static_cast<double>(count - 1 - row), cell - 5, cell - 5};
  }
};

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
  if (std::abs(correlation) >= 0.5 && box.width > 40)
    script.text_label(box.left + 4, box.bottom + 10, fmt::format("{:.2f}", correlation),
                      "left front font small_font textcolor rgb '#303030'");
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

// Number, name and value of each unknown, in lines that fit the page.
std::vector<std::string> list_of(const Corner& corner, double width, const Sheet& sheet) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < corner.name.size(); ++i)
    for (std::string& line :
         wrapped(fmt::format("{}: {} {}", i + 1, corner.name[i], corner.value[i]), width, sheet))
      lines.push_back(std::move(line));
  return lines;
}

void draw_names(Script& script, const Corner& corner, const Frame& frame) {
  const std::size_t count = corner.name.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Box row = frame.box(i, 0, count), column = frame.box(count - 1, i, count);
    const std::string& value = corner.value[i];
    const double middle = row.bottom + row.height / 2;
    if (script.sheet().on_page()) {
      const std::string number = fmt::format("{}", i + 1);
      script.text_label(frame.left - 6, middle, number, "right font text_font");
      script.text_label(column.left + column.width / 2, frame.bottom - 10, number,
                        "center font text_font");
      continue;
    }
    script.text_label(frame.left - 8, middle + 8, corner.name[i], "right font small_font");
    script.text_label(frame.left - 8, middle - 8, value,
                      "right font small_font textcolor rgb '#404040'");
    script.text_label(column.left + column.width / 2, frame.bottom - 10, corner.name[i],
                      "right rotate by 40 font small_font");
  }
}

}  // namespace

Figure corner_figure(const MeasuredOutcome& outcome, const Sheet& sheet) {
  const Corner corner = corner_of(outcome, sheet);
  const auto count = corner.name.size();
  const auto unknowns = static_cast<double>(count);
  const double width = sheet.width_px(kLeft + kCell * unknowns + kRight);
  const std::vector<std::string> list = list_of(corner, width - 16, sheet);
  const Frame frame = sheet.on_page()
                          ? Frame{std::min((width - 28) / unknowns, kCell), 24,
                                  26 + sheet.line_px() * static_cast<double>(list.size())}
                          : Frame{kCell, kLeft, kBottom};
  const Header header(sheet, width, "Covariance, " + short_name(outcome.title),
                      "ellipses of 1 and 2 sigma over ±3 sigma of each unknown; correlations of at "
                      "least 0.5 in figures");
  Script script(width, frame.bottom + frame.cell * unknowns + header.height_px(), sheet);
  script.line("set multiplot");
  script.begin_axes({0, 0, script.width(), script.height()});
  header.draw(script);
  draw_names(script, corner, frame);
  for (std::size_t i = 0; i < list.size() && sheet.on_page(); ++i)
    script.text_label(8, frame.bottom - 28 - sheet.line_px() * static_cast<double>(i), list[i],
                      "left font text_font");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  for (std::size_t i = 0; i < count; ++i) {
    draw_density(script, frame.box(i, i, count));
    for (std::size_t j = 0; j < i; ++j)
      draw_pair(script, frame.box(i, j, count), corner.correlation[i][j]);
  }
  script.line("unset multiplot");
  return figure_of(script);
}

}  // namespace skyfit::plot
