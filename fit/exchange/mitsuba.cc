// SPDX-License-Identifier: Apache-2.0
// Emitters of Mitsuba 3 (documentation of the plugins envmap, directional and sunsky; src/emitters/
// envmap.cpp: bilinear, columns of pixels at their centres, the first row at the zenith and the
// last one at the nadir; local y up, -z at the left edge, x a quarter to its right;
// include/mitsuba/render/sunsky.h: the sky of Hosek & Wilkie 2012 times sky_scale, none below the
// horizon, z up).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "data_refs/sky_image.h"
#include "fit/exchange/formula_sky.h"
#include "fit/exchange/programs.h"
#include "model/base/text.h"
#include "model/literature/hosek_wilkie.h"
#include "model/numerics/angles.h"

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

// A scene, whose first comment says what it is.
pugi::xml_node add_scene(pugi::xml_document& document, const ExportRequest& request,
                         const std::string& loss, std::string_view facts) {
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "utf-8";
  document.append_child(pugi::node_comment)
      .set_value(
          fmt::format(" Sky of the preset {}, for Mitsuba 3. Loss: {}\n     x east, y north, "
                      "z up; {} ",
                      plain_line(request.preset.name), loss, facts)
              .c_str());
  pugi::xml_node scene = document.append_child("scene");
  scene.append_attribute("version") = "3.0.0";
  return scene;
}

pugi::xml_node add_emitter(pugi::xml_node scene, const char* type) {
  pugi::xml_node emitter = scene.append_child("emitter");
  emitter.append_attribute("type") = type;
  return emitter;
}

std::string toward_sun(const ExportRequest& request, double factor) {
  const double low = factor * std::sin(request.sun_zenith);
  return fmt::format("{:.9f} {:.9f} {:.9f}", low * std::sin(request.sun_azimuth),
                     low * std::cos(request.sun_azimuth), factor * std::cos(request.sun_zenith));
}

// The preset's beam, in lx over `unit_lx`.
void add_beam(pugi::xml_node scene, const ExportRequest& request, const XyzRule& rule,
              double unit_lx) {
  const SkyValues light = request.models.truth.irradiance(request.preset.atmosphere, rule.nodes, 0,
                                                          request.sun_zenith, {});
  const Rgb sun = linear_srgb(irradiance_color(
      light, kDirectNormal, rule, std::vector<double>(rule.nodes.size(), 1 / unit_lx)));
  const pugi::xml_node beam = add_emitter(scene, "directional");
  add_value(beam, "vector", "direction", toward_sun(request, -1));
  add_value(beam, "rgb", "irradiance",
            fmt::format("{:.6g} {:.6g} {:.6g}", std::max(sun[0], 0.0), std::max(sun[1], 0.0),
                        std::max(sun[2], 0.0)));
}

std::string text_of(const pugi::xml_document& document) {
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

// Luminance, cd/m^2, of a radiance of 1 W m^-2 sr^-1 nm^-1 at all wavelengths: 683 lm/W times the
// integral of y_bar over wavelength, nm, by which Mitsuba divides what it shows
// (include/mitsuba/core/spectrum.h).
constexpr double kSunskyUnit = 683 * 106.7502593994140625;

constexpr double kMostTurbidity = 10;

// Turbidity, albedo, ln sky_scale.
constexpr int kCount = 3;

struct SunskyColor {
  std::array<HosekWilkieShapes, 3> shapes;
  template <class T>
  T operator()(const std::array<T, kCount>& x, std::size_t channel, const SkyPoint& p) const {
    using std::exp;
    return exp(x[2]) * hosek_wilkie_light(hosek_wilkie_shape(shapes[channel], x[0], x[1]),
                                          std::cos(p.view_zenith), angle_from_sun(p));
  }
};

FormulaFit<kCount> sunsky_fit() {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  FormulaFit<kCount> fit{{1, 0, -kInfinite}, {kMostTurbidity, 1, kInfinite}, {}};
  for (const double turbidity : {1.5, 3.0, 6.0}) {
    for (const double albedo : {0.1, 0.6}) fit.starts.push_back({turbidity, albedo, 0});
  }
  return fit;
}

// A number of an emitter, or the plugin's default where it has none.
double plugin_number(pugi::xml_node emitter, const char* name, double if_none, double lowest,
                     double highest, std::string_view source) {
  const pugi::xml_node node = emitter.find_child_by_attribute("name", name);
  if (!node) return if_none;
  for (pugi::xml_node other = node.next_sibling(); other; other = other.next_sibling())
    if (std::string_view(other.attribute("name").value()) == name)
      throw std::invalid_argument(fmt::format("{}: sunsky: {}: expected once", source, name));
  const std::string text = node.attribute("value").value();
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= lowest && value <= highest)) {
    throw std::invalid_argument(
        fmt::format("{}: sunsky: {} = {}: expected a number from {:g} to {:g}", source, name,
                    excerpt(text), lowest, highest));
  }
  return value;
}

// What the plugin knows and the atmosphere does not hold: where its sun stands and how it is shown.
constexpr std::array<std::string_view, 14> kOfTheScene = {
    "latitude",  "longitude",    "timezone",    "year",    "month",
    "day",       "hour",         "minute",      "second",  "sun_direction",
    "sun_scale", "sun_aperture", "complex_sun", "to_world"};

// Which of them an emitter states; throws where it states what the plugin does not know.
std::vector<std::string_view> stated_of_the_scene(pugi::xml_node emitter, std::string_view source) {
  std::vector<std::string_view> stated;
  for (const pugi::xml_node child : emitter.children()) {
    if (child.type() != pugi::node_element) continue;
    const std::string_view name = child.attribute("name").value();
    if (std::ranges::count(kOfTheScene, name) > 0) {
      stated.push_back(name);
    } else if (name != "turbidity" && name != "albedo" && name != "sky_scale") {
      throw std::invalid_argument(
          fmt::format("{}: sunsky: <{} name={}>: expected turbidity, albedo, sky_scale, {}", source,
                      excerpt(child.name()), in_quotes(name), fmt::join(kOfTheScene, ", ")));
    }
  }
  return stated;
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

  pugi::xml_document document;
  const pugi::xml_node scene =
      add_scene(document, request, loss, "luminance in cd/m^2, irradiance in lx.");
  pugi::xml_node sky = add_emitter(scene, "envmap");
  add_value(sky, "string", "filename", map.filename().string());
  pugi::xml_node transform = sky.append_child("transform");
  transform.append_attribute("name") = "to_world";
  transform.append_child("matrix").append_attribute("value") = "-1 0 0 0 0 0 1 0 0 1 0 0 0 0 0 1";
  add_beam(scene, request, rule, 1);
  return {{{request.file, text_of(document)}}, {map}, loss};
}

Exported export_mitsuba_sunsky(const ExportRequest& request) {
  if (!(request.sun_zenith < 0.5 * kPi))
    throw std::invalid_argument(
        fmt::format("sun zenith = {:.9g} deg: expected below 90: Mitsuba's sunsky has no twilight",
                    request.sun_zenith * kDegreesPerRadian));
  const XyzRule rule = xyz_rule(request.spectra);
  const std::vector<SkyPoint> points = lattice_sky(request.sun_zenith);
  const std::vector<Xyz> truth =
      sky_colors(request.models.truth, rule, request.preset.atmosphere, points);
  const SunskyColor color{hosek_wilkie_shapes(request.sun_zenith)};
  const Unknowns<kCount> x = fitted(color, sunsky_fit(), points, truth, request.progress);
  std::vector<Xyz> shown;
  for (const SkyPoint& p : points)
    shown.push_back({color(x, 0, p), color(x, 1, p), color(x, 2, p)});
  const std::string loss = loss_text(color_loss(points, truth, shown), kLatticeSky);

  pugi::xml_document document;
  const pugi::xml_node scene = add_scene(
      document, request, loss,
      fmt::format(
          "radiance in W/(m^2 sr nm), irradiance in W/(m^2 nm): 1 is {:.6g}\n     cd/m^2 or "
          "lx. The sky of Hosek and Wilkie, refitted; the sun is the preset's, without its "
          "disc.\n     Below the horizon there is no light.",
          kSunskyUnit));
  const pugi::xml_node sky = add_emitter(scene, "sunsky");
  add_value(sky, "float", "turbidity", fmt::format("{:.6g}", x[0]));
  add_value(sky, "spectrum", "albedo", fmt::format("{:.6g}", x[1]));
  add_value(sky, "float", "sky_scale", fmt::format("{:.6g}", std::exp(x[2])));
  add_value(sky, "float", "sun_scale", "0");
  add_value(sky, "vector", "sun_direction", toward_sun(request, 1));
  add_beam(scene, request, rule, kSunskyUnit);
  return {{{request.file, text_of(document)}}, {}, loss};
}

std::optional<Atmosphere<double>> read_mitsuba_sunsky(std::string_view text,
                                                      std::string_view source,
                                                      std::vector<std::string>& notes) {
  pugi::xml_document document;
  if (!document.load_buffer(text.data(), text.size())) return {};
  const pugi::xpath_node_set skies = document.select_nodes("//emitter[@type='sunsky']");
  if (skies.empty()) return {};
  if (skies.size() > 1)
    throw std::invalid_argument(
        fmt::format("{}: {} emitters of type sunsky: expected one", source, skies.size()));
  const pugi::xml_node sky = skies.first().node();
  const std::vector<std::string_view> of_the_scene = stated_of_the_scene(sky, source);
  constexpr double kMostScale = 1e9;
  const double turbidity = plugin_number(sky, "turbidity", 3, 1, kMostTurbidity, source),
               scale = plugin_number(sky, "sky_scale", 1, 0, kMostScale, source);
  Atmosphere<double> atmosphere;
  atmosphere.ground_albedo = plugin_number(sky, "albedo", 0.3, 0, 1, source);
  atmosphere.at("mie").amount *= (turbidity - 1) / (literature::turbidity_of(atmosphere) - 1);
  notes.emplace_back(
      "sunsky is the formula of the model hosek-wilkie: other models show another sky");
  if (scale != 1) notes.push_back(fmt::format("sky_scale = {:g} is left out", scale));
  if (!of_the_scene.empty()) {
    notes.push_back(
        fmt::format("left out, as no part of an atmosphere: {}", fmt::join(of_the_scene, ", ")));
  }
  return atmosphere;
}

}  // namespace skyfit::fit
