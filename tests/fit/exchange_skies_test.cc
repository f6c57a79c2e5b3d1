// SPDX-License-Identifier: Apache-2.0
// Skies of one hour for Radiance and Mitsuba: their directions see the light of the model.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <pugixml.hpp>
#include <sstream>

#include "data_refs/sky_image.h"
#include "fit/exchange/srgb.h"
#include "model/atmosphere/parameter_field.h"
#include "model/base/temporary_directory.h"
#include "model/numerics/angles.h"
#include "render/sky_map/sky_map.h"
#include "tests/fit/exchange.h"

namespace skyfit::fit {
namespace {

using ::testing::HasSubstr;

// A file of data of Radiance: two dimensions with irregular positions, the second one fastest.
struct RadianceData {
  std::vector<double> first, second, values;

  explicit RadianceData(const std::string& text) {
    std::istringstream in(text);
    int dimensions = 0;
    in >> dimensions;
    EXPECT_EQ(dimensions, 2);
    for (std::vector<double>* positions : {&first, &second}) {
      double begin = -1, end = -1;
      std::size_t count = 0;
      in >> begin >> end >> count;
      EXPECT_EQ(begin, 0);
      EXPECT_EQ(end, 0);
      positions->resize(count);
      for (double& p : *positions) in >> p;
      EXPECT_TRUE(std::ranges::is_sorted(*positions, std::less_equal()));
    }
    values.resize(first.size() * second.size());
    for (double& v : values) in >> v;
    EXPECT_TRUE(in);
    std::string rest;
    EXPECT_FALSE(in >> rest);
  }

  double at(double x, double y) const {
    const auto below = [](const std::vector<double>& p, double at) {
      std::size_t i = 0;
      while (i + 2 < p.size() && p[i + 1] <= at) ++i;
      return i;
    };
    const std::size_t i = below(first, x), k = below(second, y);
    const double u = (x - first[i]) / (first[i + 1] - first[i]),
                 v = (y - second[k]) / (second[k + 1] - second[k]);
    const auto value = [&](std::size_t a, std::size_t b) { return values[a * second.size() + b]; };
    return (1 - u) * ((1 - v) * value(i, k) + v * value(i, k + 1)) +
           u * ((1 - v) * value(i + 1, k) + v * value(i + 1, k + 1));
  }
};

TEST(Radiance, ReadsTheSkyThatIsWritten) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  const double zenith = 50 * kRadiansPerDegree, azimuth = 110 * kRadiansPerDegree;
  const Exported sky = exported(preset, "radiance", zenith, azimuth);
  ASSERT_EQ(sky.files.size(), 4U);
  const std::string& scene = sky.files[0].text;
  // What Radiance would evaluate for a direction: Atan2(abs(Dx*a-Dy*b),Dx*c+Dy*d).
  double a, b, c, d;
  const std::size_t at = scene.find("Atan2(");
  ASSERT_NE(at, scene.npos);
  ASSERT_EQ(
      std::sscanf(scene.c_str() + at, "Atan2(abs(Dx*%lf-Dy*%lf),Dx*%lf+Dy*%lf)", &a, &b, &c, &d),
      4);
  std::vector<RadianceData> channels;
  for (std::size_t k = 1; k < 4; ++k) {
    channels.emplace_back(sky.files[k].text);
    EXPECT_THAT(scene, HasSubstr(" " + sky.files[k].path.filename().string() + " "));
  }
  const XyzRule rule = xyz_rule(spectra());
  for (const auto& [view_deg, north_deg] :
       {std::pair{20.4, 33.0}, {61.3, 250.0}, {47.1, 117.0}, {88.7, 10.0}}) {
    const double view = view_deg * kRadiansPerDegree, north = north_deg * kRadiansPerDegree;
    const double x = std::sin(view) * std::sin(north), y = std::sin(view) * std::cos(north);
    const double column = std::atan2(std::abs(x * a - y * b), x * c + y * d) * kDegreesPerRadian;
    double luminance = 0;
    constexpr std::array kShare = {0.265, 0.670, 0.065};  // of Radiance's reference manual
    for (std::size_t k = 0; k < 3; ++k)
      luminance += 179 * kShare[k] * channels[k].at(view_deg, column);
    const double expected =
        sky_colors(scalar(), rule, preset.atmosphere, {{0, zenith, view, north - azimuth}})[0][1];
    EXPECT_NEAR(luminance, expected, 0.005 * expected) << view_deg << " " << north_deg;
  }
}

// Blanks part the words of a scene, of which the names of data are some.
TEST(Radiance, NamesOfDataHaveNoBlanks) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  const Exported sky = exported(preset, "radiance", 1, 0, "a folder/my sky.rad");
  ASSERT_EQ(sky.files.size(), 4U);
  EXPECT_EQ(sky.files[1].path, "a folder/my_sky_red.dat");
  EXPECT_THAT(sky.files[0].text,
              HasSubstr("\n9 red green blue my_sky_red.dat my_sky_green.dat my_sky_blue.dat . "));
}

TEST(Radiance, SunGivesTheBeam) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  const double zenith = 50 * kRadiansPerDegree;
  const std::string scene =
      exported(preset, "radiance", zenith, 0.5 * std::numbers::pi).files[0].text;
  double red, green, blue, x, y, z, diameter;
  ASSERT_EQ(std::sscanf(scene.c_str() + scene.find("light solar") + 11, "%*f%*f%*f%lf%lf%lf", &red,
                        &green, &blue),
            3);
  ASSERT_EQ(std::sscanf(scene.c_str() + scene.find("source sun") + 10, "%*f%*f%*f%lf%lf%lf%lf", &x,
                        &y, &z, &diameter),
            4);
  EXPECT_NEAR(x, std::sin(zenith), 1e-8);  // the sun is in the east
  EXPECT_NEAR(y, 0, 1e-8);
  EXPECT_NEAR(z, std::cos(zenith), 1e-8);
  EXPECT_NEAR(diameter, preset.atmosphere.star.angular_diameter_deg, 1e-4);
  const XyzRule rule = xyz_rule(spectra());
  const SkyValues light = scalar().irradiance(preset.atmosphere, rule.nodes, 0, zenith, {});
  double lux = 0;
  for (std::size_t k = 0; k < rule.nodes.size(); ++k)
    lux += rule.weight[1][k] * light.at(kDirectNormal, static_cast<int>(k));
  const double radius = 0.5 * diameter * kRadiansPerDegree;
  EXPECT_NEAR(
      179 * (0.265 * red + 0.670 * green + 0.065 * blue) * std::numbers::pi * radius * radius, lux,
      0.002 * lux);
}

// What Mitsuba would look up in the picture for directions of the world.
TEST(Mitsuba, MapShowsTheSkyWhereItIs) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  const double zenith = 50 * kRadiansPerDegree, azimuth = 110 * kRadiansPerDegree;
  const TemporaryDirectory folder;
  const std::filesystem::path file = folder.path() / "sky.xml";
  const auto write_map = [&](const std::filesystem::path& to) {
    SkyMapOptions options;
    options.sun_zenith = zenith;
    options.sun_azimuth = azimuth;
    options.sun_disc = false;
    write_sky_map(sky_map(scalar(), preset.atmosphere, xyz_channels(spectra()),
                          *make_map_projection("equirectangular", 90), options),
                  Primaries::kRec709, to);
  };
  const Exported written = program_named("mitsuba").write({.preset = preset,
                                                           .spectra = spectra(),
                                                           .models = kScalarTruth,
                                                           .sun_zenith = zenith,
                                                           .sun_azimuth = azimuth,
                                                           .file = file,
                                                           .write_sky_map = write_map});
  ASSERT_EQ(written.pictures.size(), 1U);
  const refs::Image image = refs::pixels_of(written.pictures[0]);
  pugi::xml_document scene;
  ASSERT_TRUE(scene.load_string(written.files.at(0).text.c_str()));
  const auto emitter = [&](const char* type) {
    return scene.child("scene").find_child_by_attribute("emitter", "type", type);
  };
  EXPECT_EQ(
      emitter("envmap").find_child_by_attribute("name", "filename").attribute("value").value(),
      written.pictures[0].filename().string());
  std::istringstream numbers(
      emitter("envmap").child("transform").child("matrix").attribute("value").value());
  double to_world[4][4];
  for (auto& row : to_world) {
    for (double& v : row) numbers >> v;
  }
  ASSERT_TRUE(numbers);
  const XyzRule rule = xyz_rule(spectra());
  for (const auto& [view_deg, north_deg] :
       {std::pair{21.0, 33.0}, {61.0, 251.0}, {47.0, 131.0}, {81.0, 11.0}}) {
    const double view = view_deg * kRadiansPerDegree, north = north_deg * kRadiansPerDegree;
    const double d[] = {std::sin(view) * std::sin(north), std::sin(view) * std::cos(north),
                        std::cos(view)};
    double local[3] = {};
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) local[i] += to_world[k][i] * d[k];  // the inverse of a rotation
    }
    const double u = std::atan2(local[0], -local[2]) / (2 * std::numbers::pi),
                 v = std::acos(local[1]) / std::numbers::pi;
    const int x = static_cast<int>((u - std::floor(u)) * image.width),
              y = static_cast<int>(std::lround(v * (image.height - 1)));
    const float* pixel = image.pixel(x, y);
    const double expected =
        sky_colors(scalar(), rule, preset.atmosphere, {{0, zenith, view, north - azimuth}})[0][1];
    EXPECT_NEAR(xyz_of_srgb({pixel[0], pixel[1], pixel[2]})[1], expected, 0.04 * expected)
        << view_deg << " " << north_deg;
  }
  std::istringstream direction(emitter("directional").child("vector").attribute("value").value()),
      irradiance(emitter("directional").child("rgb").attribute("value").value());
  double x, y, z;
  Rgb rgb;
  direction >> x >> y >> z;
  irradiance >> rgb[0] >> rgb[1] >> rgb[2];
  EXPECT_NEAR(x, -std::sin(zenith) * std::sin(azimuth), 1e-8);
  EXPECT_NEAR(y, -std::sin(zenith) * std::cos(azimuth), 1e-8);
  EXPECT_NEAR(z, -std::cos(zenith), 1e-8);
  const double lux =
      irradiance_color(scalar().irradiance(preset.atmosphere, rule.nodes, 0, zenith, {}),
                       kDirectNormal, rule, std::vector<double>(rule.nodes.size(), 1))[1];
  EXPECT_NEAR(xyz_of_srgb(rgb)[1], lux, 1e-5 * lux);
}

}  // namespace
}  // namespace skyfit::fit
