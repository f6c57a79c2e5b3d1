// SPDX-License-Identifier: Apache-2.0
#include "render/plot/polarisation_maps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "model/numerics/angles.h"
#include "render/plot/color_scale.h"
#include "render/plot/header.h"
#include "render/plot/hemisphere_maps.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMap = 440, kGap = 40, kMargin = 24;
constexpr double kScaleStrip = 142;  // below a map
constexpr int kPixels = 220;         // of a map's side
constexpr double kAlmostHorizon_deg = 89.9;

LinearPolarisation linear_polarisation_of(const PolarisedSky& sky, double zenith, double azimuth) {
  const auto [q, u] = polarisation_of(sky, zenith, azimuth);
  return linear_polarisation(std::isnan(q) ? 0 : 1, q, u);
}

using ColorOf = std::function<std::string(const LinearPolarisation&)>;

// Rows `x y r g b` of a map's pixels.
void write_pixels(Script& script, const std::string& name, const PolarisedSky& sky,
                  const ColorOf& color_of) {
  script.line("${} << EOD", name);
  for (int j = 0; j < kPixels; ++j) {
    for (int i = 0; i < kPixels; ++i) {
      const double x = 2 * (i + 0.5) / kPixels - 1, y = 2 * (j + 0.5) / kPixels - 1;
      const double radius = std::hypot(x, y);
      std::string color = "#ffffff";
      if (radius <= 1)
        color = color_of(linear_polarisation_of(sky, 0.5 * kPi * radius, std::atan2(-y, x)));
      const int rgb = std::stoi(color.substr(1), nullptr, 16);
      script.line("{:.6f} {:.6f} {} {} {}", x, y, rgb >> 16, rgb >> 8 & 255, rgb & 255);
    }
  }
  script.line("EOD");
}

// The circles are named where no lines are in the way.
void draw_frame(Script& script, bool named) {
  for (const double zenith : {30.0, 60.0}) {
    script.line(
        "set object circle at 0,0 size {:.9g} front fs empty border lc rgb '#b0b0b0' lw 0.5",
        zenith / 90);
  }
  script.line("set object circle at 0,0 size 1 front fs empty border lc rgb '{}' lw 1.5",
              kFrameColor);
  script.line("set style textbox 1 opaque margins 0.6,0.4 fc rgb '#ffffff' noborder");
  if (!named) return;
  for (const double zenith : {30.0, 60.0}) {
    script.line("set label '{:.0f}°' at {} center front boxed bs 1 font small_font", zenith,
                polar_point(zenith, 90));
  }
}

void draw_sun(Script& script, double sun_zenith_deg) {
  if (sun_zenith_deg > 90) return;
  script.line(
      "set object circle at {} size 0.03 front fs solid border lc rgb '#000000' lw 1 fc rgb "
      "'#ffd94d'",
      polar_point(sun_zenith_deg, 0));
}

// Names stand above and below the line of the points in turn, because Babinet's and Brewster's are
// close to each other.
void draw_neutral_points(Script& script, const std::vector<NeutralPoint>& points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const NeutralPoint& point = points[k];
    const std::string at = polar_point(point.view_zenith * kDegreesPerRadian,
                                       point.relative_azimuth * kDegreesPerRadian);
    script.line("set object circle at {} size 0.022 front fs empty border lc rgb '#000000' lw 3.5",
                at);
    script.line("set object circle at {} size 0.022 front fs empty border lc rgb '#ffffff' lw 1.8",
                at);
    script.line("set label '{}' at {} center front boxed bs 1 font small_font offset 0,{}",
                neutral_point_name(point.kind), at, k % 2 == 0 ? 1.1 : -1.1);
  }
}

// Whether a place of the map lies under the name of a neutral point; `map_px` is the map's side.
bool is_under_name(const std::vector<NeutralPoint>& points, double x, double y, double map_px,
                   const Sheet& sheet) {
  const double unit_px = map_px / 2.02, line_px = sheet.line_px();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double radius = points[k].view_zenith / (0.5 * kPi);
    const double across = radius * std::cos(points[k].relative_azimuth) - x,
                 above = radius * std::sin(points[k].relative_azimuth) - y +
                         (k % 2 == 0 ? line_px : -line_px) / unit_px;
    const double half_width = text_width_px(neutral_point_name(points[k].kind), sheet) / 2 + 12;
    if (std::abs(across) * unit_px < half_width && std::abs(above) * unit_px < line_px) return true;
  }
  return false;
}

// Short lines along the electric field, about equally far from each other.
void draw_directions(Script& script, const PolarisedSky& sky, double map_px) {
  constexpr double kHalfLength = 0.035, kLeastDegree = 0.01;
  for (int ring = 1; ring <= 8; ++ring) {
    const int count = 6 * ring;
    for (int k = 0; k < count; ++k) {
      const double radius = ring / 9.0, azimuth = 2 * kPi * (k + 0.5) / count;
      const LinearPolarisation light = linear_polarisation_of(sky, 0.5 * kPi * radius, azimuth);
      if (!(light.degree > kLeastDegree)) continue;
      const double x = radius * std::cos(azimuth), y = -radius * std::sin(azimuth);
      if (is_under_name(sky.neutral_points, x, y, map_px, script.sheet())) continue;
      // Up is toward the centre; the angle counts clockwise from there.
      const double along = std::atan2(-y, -x) - light.angle_deg * kRadiansPerDegree;
      const double dx = kHalfLength * std::cos(along), dy = kHalfLength * std::sin(along);
      for (const auto& [width, color] : {std::pair{3.4, "#ffffff"}, std::pair{1.4, "#000000"}}) {
        script.line("set arrow from {:.5f},{:.5f} to {:.5f},{:.5f} nohead front lw {} lc rgb '{}'",
                    x - dx, y - dy, x + dx, y + dy, width, color);
      }
    }
  }
}

void draw_map(Script& script, const Box& box, const std::string& name, const PolarisedSky& sky,
              const ColorOf& color_of) {
  write_pixels(script, name, sky, color_of);
  script.begin_axes(box);
  script.line("set xrange [-1.01:1.01]; set yrange [-1.01:1.01]");
  const bool with_directions = name == "angle";
  if (with_directions) draw_directions(script, sky, box.width);
  draw_frame(script, !with_directions);
  draw_sun(script, sky.sun_zenith * kDegreesPerRadian);
  draw_neutral_points(script, sky.neutral_points);
  script.line("plot ${} using 1:2:3:4:5 with rgbimage notitle", name);
}

std::string places_of(const std::vector<NeutralPoint>& points) {
  std::string text;
  for (const NeutralPoint& point : points) {
    const double deg = point.distance * kDegreesPerRadian;
    const std::string_view name = neutral_point_name(point.kind);
    if (!text.empty()) text += ",  ";
    switch (point.kind) {
      case NeutralPointKind::kBabinet:
        text += fmt::format("{} {:.1f}° above the sun", name, deg);
        break;
      case NeutralPointKind::kBrewster:
        text += fmt::format("{} {:.1f}° below the sun", name, deg);
        break;
      case NeutralPointKind::kArago:
        text += fmt::format("{} {:.1f}° above the antisolar point", name, deg);
        break;
      case NeutralPointKind::kOther:
        text += fmt::format("another at {:.1f}° from the zenith",
                            point.view_zenith * kDegreesPerRadian);
        break;
    }
  }
  return text.empty() ? "No neutral point in the sun's vertical circle" : "Neutral points: " + text;
}

double largest_percent(const PolarisedSky& sky) {
  double largest = 0;
  for (const auto& [q, u] : sky.q_u) largest = std::max(largest, 100 * std::hypot(q, u));
  return largest > 0 ? std::min(round_up(largest), 100.0) : 100;
}

// A map, its name above it and its colours below.
void draw_degree(Script& script, const Box& box, const Box& scale, const PolarisedSky& sky) {
  const double limit = largest_percent(sky);
  draw_map(script, box, "degree", sky, [&](const LinearPolarisation& light) {
    return std::isnan(light.degree) ? std::string(kLeftOutColor)
                                    : sequential_color(100 * light.degree / limit);
  });
  std::vector<Tick> ticks;
  for (const double at : {0.0, 0.25, 0.5, 0.75, 1.0})
    ticks.push_back({at, fmt::format("{:.3g}", limit * at)});
  draw_color_scale(script, scale, ticks, "degree of linear polarisation, %", sequential_color);
}

void draw_angle(Script& script, const Box& box, const Box& scale, const PolarisedSky& sky,
                PolarisationAngle angle) {
  const double sign = sign_of_u(angle);
  draw_map(script, box, "angle", sky, [&](const LinearPolarisation& light) {
    return std::isnan(light.angle_deg) ? std::string(kLeftOutColor)
                                       : half_turn_color(sign * light.angle_deg);
  });
  std::vector<Tick> ticks;
  for (const double at : {0.0, 0.25, 0.5, 0.75, 1.0})
    ticks.push_back({at, fmt::format("{:.0f}", 180 * at - 90)});
  const std::string_view sense =
      angle == PolarisationAngle::kIau ? "counter-clockwise" : "clockwise";
  draw_color_scale(script, scale, ticks,
                   fmt::format("angle from the vertical, deg, {} as seen", sense),
                   [](double at) { return half_turn_color(180 * at - 90); });
}

}  // namespace

PolarisedSky polarised_sky(const SkyModel& model, const Atmosphere<double>& atmosphere,
                           const WavelengthNode& wavelength, double altitude_m, double sun_zenith) {
  std::vector<SkyPoint> points;
  for (int i = 0; i < PolarisedSky::kZeniths; ++i) {
    const double zenith =
        std::min(i * 90.0 / (PolarisedSky::kZeniths - 1), kAlmostHorizon_deg) * kRadiansPerDegree;
    for (int k = 0; k < PolarisedSky::kAzimuths; ++k)
      points.push_back({altitude_m, sun_zenith, zenith, kPi * k / (PolarisedSky::kAzimuths - 1)});
  }
  const StokesValues light = model.stokes(atmosphere, {&wavelength, 1}, points, {});
  PolarisedSky sky;
  sky.sun_zenith = sun_zenith;
  sky.wavelength_nm = wavelength.wavelength_nm;
  for (int p = 0; p < light.i.points; ++p) {
    const double i = light.i.at(p, 0);
    const double inverse = i > 0 ? 1 / i : std::numeric_limits<double>::quiet_NaN();
    sky.q_u.push_back({light.q.at(p, 0) * inverse, light.u.at(p, 0) * inverse});
  }
  sky.neutral_points = neutral_points(model, atmosphere, wavelength, altitude_m, sun_zenith);
  return sky;
}

std::array<double, 2> polarisation_of(const PolarisedSky& sky, double view_zenith,
                                      double relative_azimuth) {
  const double azimuth = std::remainder(relative_azimuth, 2 * kPi);
  const double z = std::clamp(view_zenith / (0.5 * kPi), 0.0, 1.0) * (PolarisedSky::kZeniths - 1);
  const double a = std::abs(azimuth) / kPi * (PolarisedSky::kAzimuths - 1);
  const int i = std::min(static_cast<int>(z), PolarisedSky::kZeniths - 2),
            k = std::min(static_cast<int>(a), PolarisedSky::kAzimuths - 2);
  std::array<double, 2> mean{};
  for (int di = 0; di < 2; ++di) {
    for (int dk = 0; dk < 2; ++dk) {
      const double weight = (di ? z - i : 1 - z + i) * (dk ? a - k : 1 - a + k);
      const auto& [q, u] =
          sky.q_u[static_cast<std::size_t>((i + di) * PolarisedSky::kAzimuths + k + dk)];
      mean[0] += weight * q;
      mean[1] += weight * u;
    }
  }
  if (azimuth < 0) mean[1] = -mean[1];
  return mean;
}

Figure polarisation_figure(const std::string& title, const PolarisedSky& sky,
                           PolarisationAngle angle, const Sheet& sheet) {
  const std::vector<std::string> names = {"Degree of polarisation",
                                          "Angle of polarisation, lines along the electric field"};
  const std::vector<std::size_t> panels = sheet.chosen(names);
  // On a page that is narrow the maps stand below each other.
  constexpr double kLeastBeside = 560;
  const double width = sheet.width_px(2 * (kMargin + kMap) + kGap);
  const std::size_t columns = sheet.on_page() && width < kLeastBeside ? 1 : panels.size();
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  const double gap = sheet.on_page() ? 44 : kGap, margin = sheet.on_page() ? 22 : kMargin;
  const auto across = static_cast<double>(columns);
  const double map =
      sheet.on_page() ? std::min((width - 2 * margin - gap * (across - 1)) / across, kMap) : kMap;
  const double line = sheet.line_px();
  // Names, scales and the list of points may take two lines where the map is narrow.
  const double name_px = line * static_cast<double>(wrapped(names[1], map, sheet).size()) + 8;
  const double scale_px = sheet.on_page() ? 2 * line + 46 : kScaleStrip - 46;
  const std::string points = places_of(sky.neutral_points);
  const double footer =
      (sheet.on_page() ? line * static_cast<double>(wrapped(points, width - 8, sheet).size())
                       : 36) +
      4;
  const Header header(
      sheet, width, title,
      fmt::format("☉ {:.4g}° from the zenith, {:.5g} nm; seen from below: centre zenith, rim "
                  "horizon, sun's side right",
                  sky.sun_zenith * kDegreesPerRadian, sky.wavelength_nm));
  const double row = name_px + map + scale_px;
  Script script(width, header.height_px() + row * static_cast<double>(rows) + footer, sheet);
  script.line("set multiplot");
  const auto box_of = [&](std::size_t k) {
    const auto column = static_cast<double>(k % columns),
               below = static_cast<double>(rows - 1 - k / columns);
    // Centred where maps are at their largest and the page is wider.
    const double left = (width - across * map - gap * (across - 1)) / 2;
    return Box{left + column * (map + gap), footer + row * below + scale_px, map, map};
  };
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Box box = box_of(k);
    const double inset = sheet.on_page() ? 12 : 40;
    const Box scale{box.left + inset, box.bottom - (sheet.on_page() ? 18 : 58),
                    box.width - 2 * inset, sheet.on_page() ? 10.0 : 14.0};
    panels[k] == 0 ? draw_degree(script, box, scale, sky)
                   : draw_angle(script, box, scale, sky, angle);
  }
  script.begin_axes({0, 0, script.width(), script.height()});
  header.draw(script);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Box box = box_of(k);
    script.text_lines(box.left + box.width / 2, box.top() + name_px - line / 2, box.width,
                      names[panels[k]], "center font heading_font");
  }
  script.text_lines(sheet.on_page() ? 4 : 16, footer - (sheet.on_page() ? line / 2 : 20), width - 8,
                    points, "left font text_font textcolor rgb '#404040'");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  script.line("unset multiplot");
  return figure_of(script);
}

}  // namespace skyfit::plot
