// SPDX-License-Identifier: Apache-2.0
// Radiance's scene description (LBNL, reference manual of Radiance: light, glow, source, colordata;
// src/rt/data.c: files of data, linear between positions, the last dimension fastest; rayinit.cal:
// red(), green(), blue(), Acos(), Atan2()). Its channels are W/(m^2 sr) of equal-energy white with
// 179 lm/W and the primaries of src/common/color.h; x points east, y north, z up.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "fit/exchange/programs.h"
#include "model/atmosphere/ground_spectrum.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

constexpr double kPi = std::numbers::pi, kLumensPerWatt = 179;

Eigen::Matrix3d xyz_from_radiance() {
  Eigen::Matrix3d primaries;
  primaries << 0.640, 0.290, 0.150,  // x
      0.330, 0.600, 0.060,           // y
      0.030, 0.110, 0.790;           // 1 - x - y
  const Eigen::Vector3d share = primaries.inverse() * Eigen::Vector3d::Ones();
  return primaries * share.asDiagonal() * kLumensPerWatt;
}

// Not negative: what the primaries cannot hold is cut off, and counts in the loss.
std::array<double, 3> radiance_rgb(const Xyz& xyz) {
  static const Eigen::Matrix3d matrix = xyz_from_radiance().inverse();
  const Eigen::Vector3d rgb = (matrix * Eigen::Vector3d(xyz[0], xyz[1], xyz[2])).cwiseMax(0.0);
  return {rgb[0], rgb[1], rgb[2]};
}

Xyz xyz_of(const std::array<double, 3>& rgb) {
  static const Eigen::Matrix3d matrix = xyz_from_radiance();
  const Eigen::Vector3d xyz = matrix * Eigen::Vector3d(rgb[0], rgb[1], rgb[2]);
  return {xyz[0], xyz[1], xyz[2]};
}

// From 0 to `to` in steps that are fine about `center` and above `fine_above`, degrees.
std::vector<double> positions(double to, double center, double fine_above, double coarse) {
  std::vector<double> list{0};
  while (list.back() < to) {
    const double at = list.back(), from_center = std::abs(at - center);
    const double step = from_center < 5 || at >= fine_above ? 0.25
                        : from_center < 15                  ? 0.5
                                                            : coarse;
    list.push_back(std::min(to, (std::floor(at / step + 1e-9) + 1) * step));
  }
  return list;
}

// Rows of zenith angles, columns of azimuths from the sun's, degrees.
struct Table {
  std::vector<double> zenith_deg, azimuth_deg;
  std::vector<std::array<double, 3>> rgb;  // [zenith][azimuth]
};

Table table_of(const ExportRequest& request, const XyzRule& rule) {
  Table table{
      positions(90, request.sun_zenith * kDegreesPerRadian, 88, 1), positions(180, 0, 180, 2), {}};
  std::vector<SkyPoint> points;
  for (const double zenith : table.zenith_deg) {
    for (const double azimuth : table.azimuth_deg)
      points.push_back(
          {0, request.sun_zenith, zenith * kRadiansPerDegree, azimuth * kRadiansPerDegree});
  }
  for (const Xyz& xyz : sky_colors(request.models.truth, rule, request.preset.atmosphere, points))
    table.rgb.push_back(radiance_rgb(xyz));
  return table;
}

// As Radiance interpolates.
std::array<double, 3> looked_up(const Table& table, double zenith_deg, double azimuth_deg) {
  const auto place = [](const std::vector<double>& p, double at) {
    const auto above = std::upper_bound(p.begin() + 1, p.end() - 1, at);
    const auto i = static_cast<std::size_t>(above - p.begin()) - 1;
    return std::pair{i, (at - p[i]) / (p[i + 1] - p[i])};
  };
  const auto [row, down] = place(table.zenith_deg, zenith_deg);
  const auto [column, across] = place(table.azimuth_deg, azimuth_deg);
  const std::size_t width = table.azimuth_deg.size(), at = row * width + column;
  std::array<double, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto value = [&](std::size_t i) { return table.rgb[i][c]; };
    rgb[c] = (1 - down) * ((1 - across) * value(at) + across * value(at + 1)) +
             down * ((1 - across) * value(at + width) + across * value(at + width + 1));
  }
  return rgb;
}

std::string data_text(const Table& table, std::size_t channel) {
  std::string text = "2\n";
  for (const auto* p : {&table.zenith_deg, &table.azimuth_deg}) {
    text += fmt::format("0 0 {}", p->size());
    for (const double value : *p) text += fmt::format(" {:g}", value);
    text += '\n';
  }
  for (std::size_t i = 0; i < table.rgb.size(); ++i) {
    text += fmt::format("{:.6g}{}", table.rgb[i][channel],
                        (i + 1) % table.azimuth_deg.size() == 0 ? '\n' : ' ');
  }
  return text;
}

}  // namespace

Exported export_radiance(const ExportRequest& request) {
  const XyzRule rule = xyz_rule(request.spectra);
  const Atmosphere<double>& atmosphere = request.preset.atmosphere;
  const Table table = table_of(request, rule);

  const std::vector<SkyPoint> checked = lattice_sky(request.sun_zenith);
  std::vector<Xyz> shown;
  for (const SkyPoint& p : checked)
    shown.push_back(xyz_of(looked_up(table, p.view_zenith * kDegreesPerRadian,
                                     std::abs(p.relative_azimuth) * kDegreesPerRadian)));
  const std::string loss = loss_text(
      color_loss(checked, sky_colors(request.models.truth, rule, atmosphere, checked), shown),
      kLatticeSky);

  const SkyValues light =
      request.models.truth.irradiance(atmosphere, rule.nodes, 0, request.sun_zenith, {});
  const double radius = atmosphere.star.angular_radius_rad();
  const double solid_angle = 2 * kPi * (1 - std::cos(radius));
  std::vector<double> per_disc, reflected;
  for (const WavelengthNode& node : rule.nodes) {
    per_disc.push_back(1 / solid_angle);
    reflected.push_back(ground_albedo_at(atmosphere, node.wavelength_nm) / kPi);
  }
  const auto disc = radiance_rgb(irradiance_color(light, kDirectNormal, rule, per_disc)),
             ground = radiance_rgb(irradiance_color(light, kGlobalHorizontal, rule, reflected));

  // Digits of a text; 0 where the sine is 1e-16.
  const auto rounded = [](double value) { return std::round(value * 1e9) * 1e-9 + 0.0; };
  const double east = rounded(std::sin(request.sun_azimuth)),
               north = rounded(std::cos(request.sun_azimuth)), low = std::sin(request.sun_zenith);
  // Blanks part the words of a scene.
  std::string stem = request.file.stem().string();
  std::ranges::replace_if(
      stem, [](unsigned char c) { return std::isspace(c) != 0; }, '_');
  const auto data_file = [&](std::string_view channel) {
    return request.file.parent_path() / fmt::format("{}_{}.dat", stem, channel);
  };
  const auto data_name = [&](std::string_view channel) {
    return data_file(channel).filename().string();
  };
  const std::string scene = fmt::format(
      R"(# Sky of the preset {}, for Radiance. Loss: {}
# x east, y north, z up; W/(m2 sr), 179 lm/W. The sun's disc is even, without limb darkening.
void light solar
0
0
3 {:.6g} {:.6g} {:.6g}

solar source sun
0
0
4 {:.9g} {:.9g} {:.9g} {:.6g}

# Its data stand in three files: angle from the zenith, azimuth from the sun's.
void colordata sky_light
9 red green blue {} {} {} . Acos(Dz)/DEGREE Atan2(abs(Dx*{:.9g}-Dy*{:.9g}),Dx*{:.9g}+Dy*{:.9g})/DEGREE
0
0

sky_light glow sky_glow
0
0
4 1 1 1 0

sky_glow source sky
0
0
4 0 0 1 180

# Ground in sun and sky, as the preset's albedo reflects both.
void glow ground_glow
0
0
4 {:.6g} {:.6g} {:.6g} 0

ground_glow source ground
0
0
4 0 0 -1 180
)",
      plain_line(request.preset.name), loss, disc[0], disc[1], disc[2], low * east, low * north,
      std::cos(request.sun_zenith), 2 * radius * kDegreesPerRadian, data_name("red"),
      data_name("green"), data_name("blue"), north, east, east, north, ground[0], ground[1],
      ground[2]);
  return {{{request.file, scene},
           {data_file("red"), data_text(table, 0)},
           {data_file("green"), data_text(table, 1)},
           {data_file("blue"), data_text(table, 2)}},
          {},
          loss};
}

}  // namespace skyfit::fit
