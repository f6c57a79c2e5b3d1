// SPDX-License-Identifier: Apache-2.0
// Emitters of Mitsuba 3 (documentation of the plugins envmap and directional; src/emitters/
// envmap.cpp: bilinear, columns of pixels at their centres, the first row at the zenith and the
// last one at the nadir; local y up, -z at the left edge, x a quarter to its right).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <pugixml.hpp>
#include <sstream>

#include "data_refs/sky_image.h"
#include "fit/exchange/programs.h"
#include "fit/exchange/srgb.h"

namespace skyfit::fit {
namespace {

constexpr double kPi = std::numbers::pi;

// As envmap interpolates; azimuth clockwise from north, which is in the middle of the picture.
Rgb looked_up(const refs::Image& image, double zenith, double azimuth) {
  const double turns = azimuth / (2 * kPi) + 0.5 - 0.5 / image.width;
  const double x = (turns - std::floor(turns)) * image.width, y = zenith / kPi * (image.height - 1);
  const int column = std::min(static_cast<int>(x), image.width - 1),
            row = std::min(static_cast<int>(y), image.height - 2);
  const double across = x - column, down = y - row;
  Rgb rgb{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto value = [&](int dx, int dy) {
      return static_cast<double>(image.pixel((column + dx) % image.width, row + dy)[c]);
    };
    rgb[c] = (1 - down) * ((1 - across) * value(0, 0) + across * value(1, 0)) +
             down * ((1 - across) * value(0, 1) + across * value(1, 1));
  }
  return rgb;
}

void add_value(pugi::xml_node to, const char* type, const char* name, const std::string& value) {
  pugi::xml_node node = to.append_child(type);
  node.append_attribute("name") = name;
  node.append_attribute("value") = value.c_str();
}

}  // namespace

Exported export_mitsuba(const ExportRequest& request) {
  const XyzRule rule = xyz_rule(request.spectra);
  const Atmosphere<double>& atmosphere = request.preset.atmosphere;
  std::filesystem::path map = request.file;
  map.replace_extension(".exr");
  request.write_sky_map(map);

  // The loss is that of the file as it is read back.
  const refs::Image image = refs::pixels_of(map);
  const std::vector<SkyPoint> points = lattice_sky(request.sun_zenith);
  std::vector<Xyz> shown;
  for (const SkyPoint& p : points)
    shown.push_back(
        xyz_of_srgb(looked_up(image, p.view_zenith, request.sun_azimuth + p.relative_azimuth)));
  const std::string loss = loss_text(
      color_loss(points, sky_colors(request.models.truth, rule, atmosphere, points), shown),
      kLatticeSky);

  const SkyValues light =
      request.models.truth.irradiance(atmosphere, rule.nodes, 0, request.sun_zenith, {});
  const Rgb sun = linear_srgb(
      irradiance_color(light, kDirectNormal, rule, std::vector<double>(rule.nodes.size(), 1)));
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "utf-8";
  document.append_child(pugi::node_comment)
      .set_value(
          fmt::format(" Sky of the preset {}, for Mitsuba 3. Loss: {}\n     x east, y north, z "
                      "up; luminance in cd/m^2, irradiance in lx. ",
                      plain_line(request.preset.name), loss)
              .c_str());
  pugi::xml_node scene = document.append_child("scene");
  scene.append_attribute("version") = "3.0.0";
  pugi::xml_node sky = scene.append_child("emitter");
  sky.append_attribute("type") = "envmap";
  add_value(sky, "string", "filename", map.filename().string());
  pugi::xml_node transform = sky.append_child("transform");
  transform.append_attribute("name") = "to_world";
  transform.append_child("matrix").append_attribute("value") = "-1 0 0 0 0 0 1 0 0 1 0 0 0 0 0 1";
  pugi::xml_node beam = scene.append_child("emitter");
  beam.append_attribute("type") = "directional";
  const double low = std::sin(request.sun_zenith);
  add_value(beam, "vector", "direction",
            fmt::format("{:.9f} {:.9f} {:.9f}", -low * std::sin(request.sun_azimuth),
                        -low * std::cos(request.sun_azimuth), -std::cos(request.sun_zenith)));
  add_value(beam, "rgb", "irradiance",
            fmt::format("{:.6g} {:.6g} {:.6g}", std::max(sun[0], 0.0), std::max(sun[1], 0.0),
                        std::max(sun[2], 0.0)));
  std::ostringstream text;
  document.save(text, "  ");
  return {{{request.file, text.str()}}, {map}, loss};
}

}  // namespace skyfit::fit
