// SPDX-License-Identifier: Apache-2.0
// Two suns of different colours draw the sum of the pictures that each draws as the only star of
// its preset; a moon carries its illuminance to the ground and in its disc.
#include "render/scene/second_light.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "model/tables/table_lookup.h"
#include "tests/render/mesh_fixture.h"

namespace skyfit {
namespace {

constexpr double kMatrixInFloat = 1e-5;  // relative to the brightest channel
constexpr double kTurned = 1e-4;         // the same, of shadows under suns at turned azimuths
constexpr double kIlluminance = 0.01;

double illuminance_of(const ColorRule& rule) {
  double sum = 0;
  for (const double weight : rule.xyz_from_nodes[1]) sum += weight;
  return sum;
}

Star red_star() {
  Star star;
  star.spectrum = StarSpectrum::kBlackBody;
  star.temperature_k = 3500;
  return star;
}

double brightest(const Frame& frame, std::size_t pixel) {
  return std::max({frame.rgb[3 * pixel], frame.rgb[3 * pixel + 1], frame.rgb[3 * pixel + 2]});
}

constexpr double kPlane = 600;  // m, height of a level square above the coast
constexpr double kReflectance = 0.5;

Renderer with_plane() {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "plane.obj";
  constexpr double kSide = 500;  // m
  ObjWriter(file).quad({glm::dvec3(-kSide, -kSide, 0), glm::dvec3(kSide, -kSide, 0),
                        glm::dvec3(kSide, kSide, 0), glm::dvec3(-kSide, kSide, 0)});
  Scene scene;
  scene.meshes = {at_the_coast(file, kPlane)};
  scene.meshes[0].reflectance = kReflectance;
  return make_renderer(scene);
}

Renderer& drawer() {
  static Renderer made = with_plane();
  return made;
}

// `sun`, at 75 deg from the first, lights the picture of `first` as the sum of both pictures.
void expect_sum(const FrameOptions& first) {
  const SpectralData spectra = under(refs::standard_spectral_data(), red_star());
  const SecondSun sun{50 * kDegree, 75 * kDegree, 0.3,
                      std::make_shared<const SpectralData>(spectra)};
  FrameOptions both = first, second = first;
  both.second_sun = sun;
  second.sun_zenith = sun.zenith;
  second.camera.azimuth -= sun.azimuth;
  second.site->sun_azimuth += sun.azimuth;
  const Frame sum = drawer().draw(both), a = drawer().draw(first);
  Preset red = earth_clear();
  red.atmosphere.star = red_star();
  drawer().set_atmosphere(red,
                          compute_tables(red.atmosphere, color_rule(spectra), kSmallTables, 2, {}));
  const Frame b = drawer().draw(second);
  drawer().set_atmosphere(earth_clear(), small_tables());
  const double share =
      sun.irradiance * illuminance_of(small_tables().color) / illuminance_of(color_rule(spectra));
  WorstPixel worst;
  double least_share = 1;
  for (std::size_t i = 0; i < sum.luminance.size(); ++i) {
    const double scale = brightest(sum, i);
    if (scale <= 0) continue;  // space
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
      worst.add(sum, i, (sum.rgb[k] - a.rgb[k] - share * b.rgb[k]) / scale);
    least_share = std::min(least_share, 1 - double{a.luminance[i]} / sum.luminance[i]);
  }
  worst.print("both suns against their sum");
  EXPECT_GT(least_share, 0.02);
  EXPECT_LT(worst.error(), kTurned);
}

// A camera at a place, so that it can be turned about; in the picture's XYZ, which hold all light.
FrameOptions at_a_place(int width, int height) {
  FrameOptions options = options_of("limb", width, height);
  options.site = Site{-0.02, -0.02, 1};
  options.aerial = AerialPerspective::kPerPixel;
  options.primaries = Primaries::kXyz;
  return options;
}

TEST(SecondSun, OfAnotherStarAddsThePictureUnderThatStar) { expect_sum(at_a_place(48, 32)); }

TEST(SlowSecondSun, OfAnotherStarAddsShadowsAndCloudsToo) {
  FrameOptions options = options_of("valley", 48, 32);
  options.shadows = true;
  options.aerial = AerialPerspective::kPerPixel;
  options.primaries = Primaries::kXyz;
  options.clouds = {CloudLayer{}};
  expect_sum(options);
}

TEST(SlowSecondSun, OfTheSameSpectrumIsOneWithoutASpectrumOfItsOwn) {
  FrameOptions options = options_of("ground", 48, 32);
  options.camera.azimuth = 75 * kDegree;
  options.second_sun = SecondSun{65 * kDegree, 75 * kDegree, 0.3};
  const Frame plain = drawer().draw(options);
  options.second_sun->spectra =
      std::make_shared<const SpectralData>(refs::standard_spectral_data());
  const Frame own = drawer().draw(options);
  ASSERT_FALSE(own.discs.empty());
  WorstPixel worst;
  for (std::size_t i = 0; i < plain.luminance.size(); ++i) {
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
      worst.add(plain, i, (own.rgb[k] - plain.rgb[k]) / brightest(plain, i));
  }
  worst.print("with and without the spectrum");
  EXPECT_LT(worst.error(), kMatrixInFloat);
}

// A night with the moon at a phase angle, 50 deg from the zenith.
FrameOptions moonlit(double phase_deg, const Camera& camera, int side) {
  FrameOptions options = options_at(camera, 0, side, side);
  options.moon = Moon{.zenith = 50 * kDegree, .azimuth = 180 * kDegree, .lights = true};
  options.sun_zenith = (130 + phase_deg) * kDegree;
  if (phase_deg > 50) {  // below the horizon on the moon's side
    options.moon->azimuth = 0;
    options.sun_zenith = (230 - phase_deg) * kDegree;
  }
  return options;
}

double moon_illuminance(double phase_deg) {
  return illuminance_of(small_tables().color) * moon_illuminance_share(phase_deg * kDegree);
}

double transmitted(double zenith) {
  const ColorRule rule = moonlight_color_rule(small_tables().color);
  const NodeValues tau = lookup_optical_depth(small_tables(), 2, std::cos(zenith));
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += rule.xyz_from_nodes[1][k] * std::exp(-tau[k]);
  return sum / illuminance_of(rule);
}

TEST(Moonlight, DiscCarriesTheMoonsIlluminance) {
  for (const double phase : {0.0, 40.0, 90.0, 120.0}) {
    const double azimuth = phase > 50 ? 0 : 180 * kDegree;
    const FrameOptions options = moonlit(phase, {2, 50 * kDegree, azimuth, 1 * kDegree}, 80);
    const Frame frame = drawer().draw(options);
    const double half = std::tan(0.5 * options.camera.vertical_fov), side = 2 * half / 80;
    double sum = 0, cover = 0;
    for (const DiscPixel& disc : frame.discs) {
      sum += side * side * disc.luminance;
      cover += disc.cover;
    }
    const double radius = std::asin(kMoonRadius_m / kMoonDistance_m) / side;
    const double shining = cover / (std::numbers::pi * radius * radius);
    const double expected = moon_illuminance(phase) * transmitted(50 * kDegree);
    std::printf("[ moon   ] phase %g deg: %.4g lx, %.3f %% off, %.3f of the disc shines\n", phase,
                sum, 100 * (sum / expected - 1), shining);
    EXPECT_NEAR(sum / expected, 1, kIlluminance) << phase;
    EXPECT_NEAR(shining, 0.5 + 0.5 * std::cos(phase * kDegree), 0.02);
  }
}

TEST(Moonlight, ReachesLevelGroundByItsPhaseThroughTheAir) {
  for (const double phase : {0.0, 40.0, 90.0}) {
    const Frame frame =
        draw_layers(moonlit(phase, {kPlane + 50, std::numbers::pi, 0, 0.5}, 8), drawer());
    const std::size_t middle = 4 * 8 + 4;
    ASSERT_NEAR(frame.depth_m[middle], 50, 1);
    const ColorRule rule = moonlight_color_rule(small_tables().color);
    const NodeValues tau = lookup_optical_depth(small_tables(), kPlane, std::cos(50 * kDegree));
    double expected = 0;
    for (std::size_t k = 0; k < 4; ++k) expected += rule.xyz_from_nodes[1][k] * std::exp(-tau[k]);
    expected *= moon_illuminance_share(phase * kDegree) * std::cos(50 * kDegree);
    const double found =
        std::numbers::pi / kReflectance * luminance_of(frame.layers->direct, middle);
    std::printf("[ moon   ] phase %g deg: %.4g lx on the ground, %.3f %% off\n", phase, found,
                100 * (found / expected - 1));
    EXPECT_NEAR(found / expected, 1, kIlluminance) << phase;
  }
}

TEST(Moonlight, GoesWithoutASecondSunAndWithoutADiscTooWide) {
  FrameOptions options = moonlit(0, {}, 8);
  options.moon->radius_m = 0.2 * options.moon->distance_m;
  EXPECT_THAT([&] { validate(options); }, ::testing::ThrowsMessage<std::invalid_argument>(
                                              ::testing::HasSubstr("moon.radius_m")));
  options = moonlit(0, {}, 8);
  options.second_sun = SecondSun{};
  EXPECT_THAT([&] { validate(options); },
              ::testing::ThrowsMessage<std::invalid_argument>(::testing::HasSubstr("moon.lights")));
}

}  // namespace
}  // namespace skyfit
