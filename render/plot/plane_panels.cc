// SPDX-License-Identifier: Apache-2.0
#include "render/plot/plane_panels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/base/misfit.h"
#include "render/plot/legend.h"

namespace skyfit::plot {
namespace {

constexpr double kTitleStrip = 26;  // above a panel: sun zenith and RMS
constexpr double kGap = 14;         // right of a panel
constexpr double kNarrow = 230;     // of a panel: less room for words

std::string sun_label(const SunSamples& sun, bool short_one) {
  return fmt::format("{} {:.4g}°", short_one ? "☉" : "sun zenith", sun.sun_zenith_deg);
}

// The RMS of each curve above a panel: beside the sun's angle where all find a place, else in rows
// below it.
struct RmsPlaces {
  RmsPlaces(const Sheet& sheet, double panel_width, const Suns& suns) {
    const std::size_t curves = suns.shown.front().plane.size();
    many = curves > kMapCurves && !sheet.on_page();
    number_px = sheet.on_page() ? 38 : many ? 34 : 42;
    percent_px = sheet.on_page() ? 14 : 20;
    // One unit behind the numbers of a panel, unless some are factors, which have none.
    each_its_unit = std::ranges::any_of(suns.shown, [](const SunSamples& sun) {
      return std::ranges::any_of(
          sun.plane, [](const auto& curve) { return is_factor(rms_log_percent(curve)); });
    });
    if (each_its_unit) {
      number_px += percent_px;
      percent_px = 0;
    }
    if (!sheet.on_page()) return;
    double beside = panel_width;
    for (const SunSamples& sun : suns.shown)
      beside = std::min(beside, panel_width - text_width_px(sun_label(sun, true), sheet));
    const double needed = static_cast<double>(curves) * number_px + percent_px;
    named = needed + text_width_px("RMS ", sheet) <= beside;
    one_row = needed <= beside;
    if (one_row) return;
    in_row = static_cast<std::size_t>(std::max(1.0, (panel_width - percent_px) / number_px));
    rows = (curves + in_row - 1) / in_row;
  }
  bool many = false;
  double number_px = 0, percent_px = 0;
  bool each_its_unit = false;
  bool one_row = true, named = true;
  std::size_t in_row = kMaxCurves, rows = 0;  // below the angle
};

double strip_height(const Sheet& sheet, const RmsPlaces& places) {
  return kTitleStrip + sheet.line_px() * static_cast<double>(places.rows);
}

struct Range {
  double lower = std::numeric_limits<double>::infinity(), upper = 0;
  void include(double value) {
    if (!(value > 0)) return;
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
};

// One range for all panels, so that heights compare; 8 % of air below, and above it room for the
// sun.
Range luminance_range(const Suns& suns) {
  Range range;
  for (const auto& sun : suns.shown)
    for (const auto& curve : sun.plane)
      for (const auto& sample : curve) {
        range.include(sample.reference);
        range.include(sample.model);
        if (suns.shown.front().plane.size() == 1) range.include(sample.start_model);
      }
  if (range.upper == 0) return {0.1, 10};
  const double air = std::pow(std::max(range.upper / range.lower, 1.5), 0.08);
  return {range.lower / air, range.upper * air * air};
}

// Rows `signed_zenith value` of the chosen column, as a named block. A blank row breaks the line at
// the cone around the sun, where neither the reference nor a chord between its sides means
// anything.
void write_line(Script& script, const std::string& name, const std::vector<Sample>& samples,
                double Sample::*column, double sun_zenith_deg, double cone_deg) {
  script.line("${} << EOD", name);
  bool before_sun = true;
  for (const auto& sample : samples) {
    const double zenith = signed_view_zenith_deg(sample);
    if (std::abs(zenith - sun_zenith_deg) < cone_deg) continue;
    if (before_sun && zenith >= sun_zenith_deg && cone_deg > 0) script.line("");
    before_sun = zenith < sun_zenith_deg;
    script.line("{:.9g} {:.9g}", zenith, sample.*column);
  }
  script.line("NaN NaN\nEOD");
}

void write_points(Script& script, const std::string& name, const std::vector<Sample>& samples,
                  bool counted) {
  script.line("${} << EOD", name);
  for (const auto& sample : samples)
    if ((sample.weight > 0) == counted)
      script.line("{:.9g} {:.9g}", signed_view_zenith_deg(sample), sample.reference);
  script.line("NaN NaN\nEOD");
}

bool one_reference(const Suns& suns) {
  const auto same = [](const Sample& a, const Sample& b) {
    return a.view_zenith_deg == b.view_zenith_deg && a.reference == b.reference;
  };
  for (const auto& sun : suns.shown)
    for (const auto& curve : sun.plane)
      if (!std::ranges::equal(sun.plane[0], curve, same)) return false;
  return true;
}

// Whether any sample in the panels of the first `curves` curves fulfils the condition.
template <class Condition>
bool any_sample(const Suns& suns, std::size_t curves, Condition condition) {
  for (const auto& sun : suns.shown)
    for (std::size_t i = 0; i < curves; ++i)
      if (std::ranges::any_of(sun.plane[i], condition)) return true;
  return false;
}

class Panels {
 public:
  Panels(Script& script, const Comparison& comparison, const Suns& suns, const Grid& grid)
      : script_(script),
        comparison_(comparison),
        suns_(suns),
        grid_(grid),
        range_(luminance_range(suns)) {}

  void draw(std::size_t index) {
    const Box cell = grid_.cell(index);
    const RmsPlaces places(script_.sheet(), cell.width - kGap, suns_);
    const Box box{cell.left, cell.bottom, cell.width - kGap,
                  cell.height - strip_height(script_.sheet(), places)};
    script_.begin_axes(box);
    draw_axes(index);
    draw_sun(suns_.shown[index]);
    draw_titles(suns_.shown[index], box, places);
    draw_curves(suns_.shown[index], fmt::format("s{}", index));
  }

 private:
  void draw_axes(std::size_t index) {
    const bool leftmost = index % grid_.columns == 0;
    const bool lowest = index + grid_.columns >= suns_.shown.size();
    script_.line("set border 15 lc rgb '{}' lw 0.8", kFrameColor);
    script_.line("set xrange [-90:90]; set logscale y; set yrange [{:.9g}:{:.9g}]", range_.lower,
                 range_.upper);
    script_.line("set grid xtics ytics lt 1 lw 0.6 lc rgb '{}' back", kGridColor);
    script_.line(
        "set xtics -60,{},60 scale 0.5 nomirror format '{}' textcolor rgb '#202020' offset 0,0.3",
        grid_.cell(index).width < kNarrow ? 60 : 30, lowest ? "%g°" : "");
    std::string ticks;
    for (const auto& tick : log_ticks(range_.lower, range_.upper))
      ticks += fmt::format("{}'{}' {:.9g} {}", ticks.empty() ? "" : ", ",
                           leftmost ? tick.label : "", tick.position, tick.label.empty() ? 1 : 0);
    script_.line("set ytics scale 0.5,0.3 nomirror textcolor rgb '#202020' ({})", ticks);
  }

  void draw_sun(const SunSamples& sun) {
    const double zenith = sun.sun_zenith_deg, cone = comparison_.exclude_sun_deg;
    if (cone > 0)
      script_.line(
          "set object rectangle from {:.9g}, graph 0 to {:.9g}, graph 1 behind fs solid noborder "
          "fc rgb '{}'",
          std::max(zenith - cone, -90.0), std::min(zenith + cone, 90.0), kSunShade);
    script_.line(
        "set arrow from {:.9g}, graph 0 to {:.9g}, graph 0.9 nohead back lw 1 dt 3 lc rgb '{}'",
        zenith, zenith, kSunColor);
    script_.line(
        "set label '☉' at {:.9g}, graph 0.945 center front font sun_font textcolor rgb '{}'",
        zenith, kSunColor);
  }

  void draw_titles(const SunSamples& sun, const Box& box, const RmsPlaces& places) {
    const double line = script_.sheet().line_px();
    const double y = box.top() + line * static_cast<double>(places.rows) + kTitleStrip / 2 - 1;
    const bool several = sun.plane.size() > 1;
    script_.text_label(box.left, y, sun_label(sun, several || box.width < kNarrow),
                       "left font text_font");
    bool any = false;
    const auto number_at = [&](std::size_t curve, double right, double at_y) {
      const double rms = rms_log_percent(sun.plane[curve]);
      any |= !std::isnan(rms);
      const auto text = places.each_its_unit ? log_misfit_with_unit : log_misfit;
      script_.text_label(
          right, at_y, std::isnan(rms) ? "–" : text(rms, 1),
          fmt::format("right font {} textcolor rgb '{}'", places.many ? "small_font" : "text_font",
                      several ? kCurveColors[curve] : "#000000"));
    };
    double right = box.right() - places.percent_px;
    for (std::size_t i = sun.plane.size(); i-- > 0;) {
      const std::size_t behind = places.in_row - 1 - i % places.in_row;
      const auto row = static_cast<double>(i / places.in_row);
      if (places.one_row) {
        number_at(i, right, y);
        right -= places.number_px;
      } else {
        number_at(i,
                  box.right() - places.percent_px - places.number_px * static_cast<double>(behind),
                  y - line * (row + 1));
      }
    }
    if (any && !places.each_its_unit)
      script_.text_label(box.right(), places.one_row ? y : y - line, "%", "right font text_font");
    if (places.named) script_.text_label(right + 4, y, "RMS", "right font text_font");
  }

  void draw_curves(const SunSamples& sun, const std::string& name) {
    const double zenith = sun.sun_zenith_deg, cone = comparison_.exclude_sun_deg;
    std::string plots;
    const auto add = [&](const std::string& block, std::string_view with, Mark mark,
                         std::string_view color) {
      plots +=
          fmt::format("{}${} using 1:2 with {} {} notitle", plots.empty() ? "plot " : ", \\\n  ",
                      block, with, mark_style(mark, color));
    };
    if (sun.plane.size() == 1) {
      write_line(script_, name + "start", sun.plane[0], &Sample::start_model, zenith, cone);
      add(name + "start", "lines", Mark::kDashedLine, kStartColor);
    }
    for (std::size_t i = 0; i < sun.plane.size(); ++i) {
      const std::string curve = fmt::format("{}c{}", name, i);
      write_line(script_, curve, sun.plane[i], &Sample::model, zenith, cone);
      add(curve, "linespoints", Mark::kSolidLine, kCurveColors[i]);
    }
    const bool one = one_reference(suns_);
    for (std::size_t i = 0; i < (one ? 1 : sun.plane.size()); ++i) {
      const std::string points = fmt::format("{}r{}", name, i);
      write_points(script_, points, sun.plane[i], true);
      write_points(script_, points + "x", sun.plane[i], false);
      add(points, "points", Mark::kPoint, one ? kReferenceColor : kCurveColors[i]);
      add(points + "x", "points", Mark::kHollowPoint, kLeftOutColor);
    }
    script_.line("{}", plots);
  }

  Script& script_;
  const Comparison& comparison_;
  const Suns& suns_;
  const Grid& grid_;
  Range range_;
};

}  // namespace

std::vector<LegendEntry> plane_legend(const Comparison& comparison, const Suns& suns) {
  const std::size_t count = comparison.curves.size();
  std::vector<LegendEntry> legend;
  const bool one = one_reference(suns);
  if (one) legend.push_back({Mark::kPoint, kReferenceColor, comparison.reference_label});
  for (std::size_t i = 0; i < count; ++i) {
    const std::string& label = comparison.curves[i].label;
    if (!one) legend.push_back({Mark::kPoint, kCurveColors[i], "reference of " + label});
    legend.push_back({Mark::kSolidLine, kCurveColors[i], label});
  }
  const auto has_start = [](const Sample& s) { return !std::isnan(s.start_model); };
  if (count == 1 && any_sample(suns, 1, has_start))
    legend.push_back({Mark::kDashedLine, kStartColor, "start values"});
  if (any_sample(suns, one ? 1 : count, [](const Sample& s) { return s.weight == 0; }))
    legend.push_back({Mark::kHollowPoint, kLeftOutColor, "left out of the fit"});
  return legend;
}

double plane_strip_px(const Sheet& sheet, double cell_width_px, const Suns& suns) {
  return strip_height(sheet, RmsPlaces(sheet, cell_width_px - kGap, suns));
}

void draw_plane_panels(Script& script, const Comparison& comparison, const Suns& suns,
                       const Grid& grid) {
  Panels panels(script, comparison, suns, grid);
  for (std::size_t i = 0; i < suns.shown.size(); ++i) panels.draw(i);
}

}  // namespace skyfit::plot
