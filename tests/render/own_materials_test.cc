// SPDX-License-Identifier: Apache-2.0
// A user's own pictures of the ground's materials: colours come out as they are, a relief turns the
// light as its slope says, no lattice shows, and what is no such picture is refused in one line.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "model/photometry/srgb_transfer.h"
#include "render/gl/terrain/color_reflectance.h"
#include "render/gl/terrain/own_textures.h"
#include "render/scene/material_file.h"
#include "tests/render/frame_fixture.h"
#include "tests/render/map_fixture.h"

namespace skyfit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kDegrees = std::numbers::pi / 180;
constexpr double kEightBits = 0.5 / 127.5;  // of a component of a normal

class OwnMaterialFiles : public MapFiles {
 protected:
  using Color = std::array<float, 3>;

  std::filesystem::path picture(const std::string& name, int side,
                                const std::function<Color(int x, int y)>& color) const {
    std::vector<float> values;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        for (const float part : color(x, y)) values.push_back(part);
      }
    }
    return write(name, side, side, 3, OIIO::TypeDesc::UINT8, values);
  }

  std::filesystem::path plain(const std::string& name, const Color& color) const {
    return picture(name, 16, [&](int, int) { return color; });
  }

  // Whose surface leans down toward the east and the north by these angles.
  std::filesystem::path leaning(const std::string& name, double east, double north) const {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(std::tan(east), std::tan(north), 1));
    const auto coded = [](double x) { return static_cast<float>(0.5 + 0.5 * x); };
    return plain(name, {coded(normal.x), coded(normal.y), coded(normal.z)});
  }

  // A level planet of soil, a little above the water everywhere.
  Scene level() const {
    Scene scene;
    scene.height_map =
        write("level.png", 16, 8, 1, OIIO::TypeDesc::UINT8, std::vector<float>(16 * 8, 0.5f));
    scene.lowest_m = 100;
    scene.highest_m = 5000;
    scene.water_level_m = 50;
    return scene;
  }

  void write_json(const std::string& text) const {
    std::ofstream(directory_ / kMaterialFile) << text;
  }

  std::string refusal(const std::filesystem::path& color_map = {}) const {
    try {
      read_materials(directory_, NamedFiles::kInItsFolder, color_map);
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  }
};

// Level ground is rough at waves of 9 m, but not where a quad is longer than them.
constexpr double kAboveRoughness = 5e3;  // m

// Of the planet's radius and one map: its blocks are the same for all.
Renderer with_ground(const Scene& scene) {
  static const TemporaryDirectory directory;
  static const auto cache = std::make_shared<ContentCache>(directory.path() / "cache");
  return make_renderer(scene, GraphicsDevice::kSoftware, cache);
}

// Straight down in the middle of a field of the globe, the sun in the east.
FrameOptions downward(const Renderer& drawn, double above_m, double fov_deg = 20) {
  FrameOptions options =
      options_at({above_m, std::numbers::pi, 0, fov_deg * kDegrees}, 50 * kDegrees, 48, 48);
  options.site = Site{45 * kDegrees, 5 * kDegrees, 90 * kDegrees};
  options.camera.altitude_m += drawn.ground_height_m(options.site);
  return options;
}

TEST_F(OwnMaterialFiles, ColorIsTheGroundsReflectance) {
  const ColorReflectance colors(small_tables().color);
  for (const Color& color : {Color{0.4f, 0.6f, 0.2f}, Color{0.6f, 0.6f, 0.6f}}) {
    Scene scene = level();
    scene.soil.color = plain("soil.png", color);
    Renderer drawn = with_ground(scene);
    const Frame frame = draw_layers(downward(drawn, kAboveRoughness), drawn);
    for (std::size_t i = 0; i < frame.luminance.size(); i += 7) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double expected = srgb_decoded(std::round(255.0 * color[k]) / 255);
        EXPECT_NEAR(frame.layers->albedo[3 * i + k], expected, 2e-3) << "pixel " << i;
      }
    }
  }
}

// Lambert's law: a surface that leans by 20 degrees toward the sun has cos(50 - 20) / cos(50) of
// the direct light.
TEST_F(OwnMaterialFiles, ReliefTurnsTheDirectLightByItsSlope) {
  constexpr double kSun = 50 * kDegrees, kLean = 20 * kDegrees;
  const auto direct = [&](double east, double north) {
    Scene scene = level();
    scene.soil.color = plain("soil.png", {0.5f, 0.5f, 0.5f});
    scene.soil.normal = leaning("normal.png", east, north);
    Renderer drawn = with_ground(scene);
    const Frame frame = draw_layers(downward(drawn, kAboveRoughness), drawn);
    const std::size_t middle = 24 * 48 + 24;
    const glm::dvec3 normal = color_of(frame.layers->normal, middle);
    // x toward the sun, which stands in the east, y to the left of it, in the north.
    EXPECT_NEAR(normal.x,
                std::sin(std::atan(std::tan(east) * std::cos(std::atan(std::tan(north))))),
                2 * kEightBits);
    EXPECT_NEAR(std::atan2(normal.y, normal.z), std::atan(std::tan(north)), 2 * kEightBits);
    return luminance_of(frame.layers->direct, middle);
  };
  const double flat = direct(0, 0), to_sun = direct(kLean, 0), away = direct(-kLean, 0),
               aside = direct(0, kLean);
  std::printf("[ relief ] direct light of slopes of 20 deg over level ground: %.4f, %.4f, %.4f\n",
              to_sun / flat, away / flat, aside / flat);
  constexpr double kStep = 2 * kEightBits * 1.2 / 0.64;  // of tan(50 deg), over cos(50 deg)
  EXPECT_NEAR(to_sun / flat, std::cos(kSun - kLean) / std::cos(kSun), kStep);
  EXPECT_NEAR(away / flat, std::cos(kSun + kLean) / std::cos(kSun), kStep);
  EXPECT_NEAR(aside / flat, std::cos(kLean), kStep);
}

// A normal along the ground, as close to it as 8 bits come: blue is 128 of 255.
TEST_F(OwnMaterialFiles, SteepestNormalsHaveSlopesAndLight) {
  constexpr float kSteepest = 8, kLowest = 128 / 255.0f;
  const auto slopes = [&](const Color& color) {
    const OwnPicture picture = read_own_slopes(plain("steep.png", color));
    return std::array{picture.texels[0], picture.texels[1]};
  };
  EXPECT_EQ(slopes({1, 0.5f, kLowest}), (std::array{-kSteepest, 0.0f}));
  EXPECT_EQ(slopes({0.5f, 0, kLowest}), (std::array{0.0f, kSteepest}));
  EXPECT_EQ(slopes({0.5f, 0.5f, kLowest}), (std::array{0.0f, 0.0f}));
  Scene scene = level();
  scene.soil.color = plain("soil.png", {0.5f, 0.5f, 0.5f});
  scene.soil.normal = plain("steep.png", {1, 0.5f, kLowest});
  Renderer drawn = with_ground(scene);
  const Frame frame = draw_layers(downward(drawn, kAboveRoughness), drawn);
  const std::size_t middle = 24 * 48 + 24;
  EXPECT_NEAR(color_of(frame.layers->normal, middle).x, std::sin(std::atan(kSteepest)),
              2 * kEightBits);
  for (const float luminance : frame.luminance)
    EXPECT_TRUE(std::isfinite(luminance) && luminance >= 0) << luminance << " cd/m^2";
}

TEST_F(OwnMaterialFiles, WhatIsMissingIsTheProgramsOwn) {
  Scene scene = level();
  Renderer plain_ground = with_ground(scene);
  const Frame without = draw_layers(downward(plain_ground, 20), plain_ground);
  scene.rock.color = plain("rock.png", {0.9f, 0.1f, 0.1f});  // there is none to be seen
  Renderer with_rock = with_ground(scene);
  EXPECT_EQ(draw_layers(downward(with_rock, 20), with_rock).rgb, without.rgb);
  // A colour alone leaves the relief.
  scene.soil.color = plain("soil.png", {0.5f, 0.5f, 0.5f});
  Renderer with_soil = with_ground(scene);
  const Frame colored = draw_layers(downward(with_soil, 20), with_soil);
  EXPECT_EQ(colored.layers->normal, without.layers->normal);
  EXPECT_NE(colored.layers->albedo, without.layers->albedo);
}

// The same pattern at each repeat would be a correlation of 1.
TEST_F(OwnMaterialFiles, NoLatticeShows) {
  Scene scene = level();
  const std::vector<float> values = noise(16 * 16);
  scene.soil.color = picture("soil.png", 16, [&](int x, int y) {
    const float value = values[static_cast<std::size_t>(16 * y + x)];
    return Color{value, value, value};
  });
  scene.soil.normal = leaning("normal.png", 0, 0);
  scene.soil.near_m = 2;
  scene.soil.far_m = 20;
  double mean_of_picture = 0;
  for (const float value : values)
    mean_of_picture += srgb_decoded(std::round(255.0 * value) / 255) / 256;
  Renderer drawn = with_ground(scene);
  // A repeat is 64 pixels of the near scale, and of the far one.
  for (const auto& [repeat, above] : {std::pair{2.0, 4.0}, {20.0, 40.0}}) {
    constexpr int kSide = 256, kRepeat = 64;
    const double fov = 2 * std::atan(0.5 * kSide / kRepeat * repeat / above);
    FrameOptions options = downward(drawn, above, fov / kDegrees);
    options.width = options.height = kSide;
    const Frame frame = draw_layers(options, drawn);
    double mean = 0, square = 0, product = 0;
    int pairs = 0;
    for (int i = 0; i < kSide * kSide; ++i)
      mean += luminance_of(frame.layers->albedo, static_cast<std::size_t>(i)) / (kSide * kSide);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x + kRepeat < kSide; ++x, ++pairs) {
        const auto i = static_cast<std::size_t>(y * kSide + x);
        const double a = luminance_of(frame.layers->albedo, i) - mean,
                     b = luminance_of(frame.layers->albedo, i + kRepeat) - mean;
        square += a * a;
        product += a * b;
      }
    }
    std::printf("[lattice ] repeats of %g m: correlation %.3f, deviation %.3f, mean %.3f of %.3f\n",
                repeat, product / square, std::sqrt(square / pairs), mean, mean_of_picture);
    EXPECT_LT(std::abs(product / square), 0.3);
    EXPECT_GT(std::sqrt(square / pairs), 0.1);  // the pattern is seen
    EXPECT_NEAR(mean, mean_of_picture, 0.04);
  }
}

TEST_F(OwnMaterialFiles, AreNamedByAFileOfTheirFolder) {
  EXPECT_TRUE(read_materials(directory_, NamedFiles::kInItsFolder).soil.color.empty());
  plain("grass.png", {0.2f, 0.4f, 0.1f});
  leaning("bumps.png", 0, 0);
  write_json(
      R"({"skyfit_materials": 1, "soil": {"color": "grass.png", "normal": "bumps.png", "near_m": 2}})");
  const OwnMaterials own = read_materials(directory_, NamedFiles::kInItsFolder);
  EXPECT_EQ(own.soil.color, directory_ / "grass.png");
  EXPECT_EQ(own.soil.normal, directory_ / "bumps.png");
  EXPECT_EQ(own.soil.near_m, 2);
  EXPECT_EQ(own.soil.far_m, 30);
  EXPECT_EQ(own.rock, OwnMaterial());
}

TEST_F(OwnMaterialFiles, FileIsRefusedInOneLineThatNamesTheField) {
  const std::string file = (directory_ / kMaterialFile).string();
  plain("grass.png", {0.2f, 0.4f, 0.1f});
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {R"({"skyfit_materials": 2})", "skyfit_materials = 2"},
           {R"({"skyfit_materials": 1, "sand": {}})", "sand"},
           {R"({"skyfit_materials": 1, "soil": {"colour": "grass.png"}})", "soil.colour"},
           {R"({"skyfit_materials": 1, "soil": {"color": "../grass.png"}})", "soil.color"},
           {R"({"skyfit_materials": 1, "soil": {"color": ""}})", R"(soil.color = "": expected)"},
           {R"({"skyfit_materials": 1, "soil": {"color": "grass.png\u0000x"}})",
            R"(soil.color = "grass.png\u0000x": expected)"},
           {R"({"skyfit_materials": 1, "soil": {"near_m": 0}})", "soil.near_m = 0"},
           {"{\"skyfit_materials\": 1, \"soil\":\n {\"near_m\": 66667}}",
            ":2: soil.near_m = 66667: expected metres, 0.01 to 66666 without far_m"},
           {R"({"skyfit_materials": 1, "soil": {"near_m": 3, "far_m": 2e6}})",
            "soil.far_m = 2000000.0: expected metres, 0.01 to 1000000"},
           {R"({"skyfit_materials": 1, "soil": {"near_m": 9, "far_m": 3}})", "soil.far_m = 3"}}) {
    write_json(text);
    EXPECT_THAT(refusal(), HasSubstr(file + ":")) << text;
    EXPECT_THAT(refusal(), HasSubstr(expected));
    EXPECT_THAT(refusal(), Not(HasSubstr("\n")));
  }
  write_json(R"({"skyfit_materials": 1, "soil": {"color": "gras.png"}})");
  EXPECT_EQ(refusal(), (directory_ / "gras.png").string() +
                           ": cannot be read (No such file or directory), expected a picture for " +
                           file + ":1: soil.color");
  write_json(R"({"skyfit_materials": 1, "soil": {"color": "grass.png"}})");
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(refusal("map.png"), file + R"(:1: soil.color = "grass.png": expected none with )"
                                       "--color-map, which has the ground's colours");
  // The longest of all.
  write_json(R"({"skyfit_materials": 1, "soil": {"near_m": 66666}, "rock": )"
             R"({"near_m": 1e6, "far_m": 1e6}})");
  EXPECT_EQ(refusal(), "");
}

TEST_F(OwnMaterialFiles, PicturesOfAnotherKindAreRefusedInOneLine) {
  const ColorReflectance colors(small_tables().color);
  const auto message = [](const auto& read) -> std::string {
    try {
      read();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  };
  const auto oblong = write("oblong.png", 16, 8, 3, OIIO::TypeDesc::UINT8, noise(16 * 8 * 3));
  EXPECT_EQ(message([&] { read_own_color(oblong, colors); }),
            oblong.string() + ": 16 x 8 pixels: expected a square of 4 to 4096 on a side");
  const auto grey = write("grey.png", 8, 8, 1, OIIO::TypeDesc::UINT8, noise(8 * 8));
  EXPECT_EQ(message([&] { read_own_color(grey, colors); }),
            grey.string() + ": 1 channel: expected red, green and blue");
  const auto floats = write("light.exr", 8, 8, 3, OIIO::TypeDesc::FLOAT, noise(8 * 8 * 3));
  EXPECT_EQ(message([&] { read_own_color(floats, colors); }),
            floats.string() + ": values of type float: expected 8 or 16 bits a channel");
  const auto photograph = plain("photograph.png", {0.5f, 0.4f, 0.2f});
  EXPECT_EQ(
      message([&] { read_own_slopes(photograph); }),
      photograph.string() +
          ": blue is 0.2 of 1 in column 0 of row 0: expected normals, whose blue is above 0.5");
  Scene with_grey = level();
  with_grey.rock.normal = grey;
  EXPECT_EQ(message([&] { with_ground(with_grey).draw(FrameOptions()); }),
            grey.string() + ": 1 channel: expected red, green and blue (rock.normal)");
  Scene scene;
  scene.height_map = level().height_map;
  scene.color_map = oblong;
  scene.soil.color = photograph;
  EXPECT_THAT(([&] {
                try {
                  validate(scene);
                } catch (const std::invalid_argument& error) {
                  return std::string(error.what());
                }
                return std::string();
              })(),
              HasSubstr("must be none with a color_map"));
}

}  // namespace
}  // namespace skyfit
