// SPDX-License-Identifier: Apache-2.0
// Every projection shows each direction once; a map's pixels are the model's light, its integral
// the model's irradiance, and the sun's disc in it has the irradiance of the beam.
#include "render/sky_map/sky_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/preset.h"
#include "model/numerics/angles.h"
#include "model/registry.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kRadiansPerDegree;

double dot(const Axis& a, const Axis& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

class Projections : public ::testing::TestWithParam<std::string_view> {
 protected:
  std::unique_ptr<MapProjection> projection_ = make_map_projection(GetParam(), 64);
};

TEST_P(Projections, PointAndDirectionAreInverse) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    Axis d = {normal(random), normal(random), normal(random)};
    const double length = std::sqrt(dot(d, d));
    for (double& x : d) x /= length;
    const auto at = projection_->point(d);
    if (!at) {
      EXPECT_TRUE(GetParam() == "fisheye" && d[2] <= 0);
      continue;
    }
    ASSERT_GE((*at)[0], 0);
    ASSERT_LE((*at)[0], projection_->width());
    const auto back = projection_->direction((*at)[0], (*at)[1]);
    ASSERT_TRUE(back);
    EXPECT_GT(dot(*back, d), 1 - 1e-12);
  }
}

TEST_P(Projections, PixelsTogetherAreTheSphere) {
  double sum = 0;
  for (int y = 0; y < projection_->height(); ++y) {
    for (int x = 0; x < projection_->width(); ++x) sum += projection_->solid_angle_sr(x, y);
  }
  EXPECT_NEAR(sum / (GetParam() == "fisheye" ? 2 * kPi : 4 * kPi), 1, 0.01);
}

INSTANTIATE_TEST_SUITE_P(All, Projections,
                         ::testing::Values("equirectangular", "fisheye", "cube", "octahedral",
                                           "angular"));

// Where the axes lie: the middle of an equirectangular map looks north, right of it lies east; a
// fisheye has east on its left; OpenGL's +x face is east.
TEST(SkyMapAxes, LieWhereTheirMeaningSays) {
  const auto expect = [](std::string_view name, double x, double y, const Axis& axis) {
    const auto d = make_map_projection(name, 64)->direction(x, y);
    ASSERT_TRUE(d);
    EXPECT_GT(dot(*d, axis), 1 - 1e-3) << name;
  };
  expect("equirectangular", 64, 32, {0, 1, 0});
  expect("equirectangular", 96, 32, {1, 0, 0});
  expect("fisheye", 32, 32, {0, 0, 1});
  expect("fisheye", 0.2, 32, {1, 0, 0});
  expect("cube", 32, 32, {1, 0, 0});
  expect("cube", 2.5 * 64, 32, {0, 0, 1});
  expect("cube", 5.5 * 64, 32, {0, 1, 0});
  expect("octahedral", 32, 32, {0, 0, 1});
  expect("angular", 32, 32, {0, 1, 0});
}

const SpectralData& spectra() { return refs::standard_spectral_data(); }
const SkyModel& model() {
  static const auto made = make_sky_model("reference", spectra(), 2);
  return *made;
}

SkyMap map_of(std::string_view projection, int size, const SkyMapOptions& options) {
  return sky_map(model(), Atmosphere<double>{}, xyz_channels(spectra()),
                 *make_map_projection(projection, size), options);
}

SkyMapOptions sun_at(double zenith_deg) {
  SkyMapOptions options;
  options.sun_zenith = zenith_deg * kDegree;
  options.sun_azimuth = 200 * kDegree;
  options.sun_disc = false;
  return options;
}

TEST(SkyMap, PixelsAreTheModelsLight) {
  const SkyMapOptions options = sun_at(50);
  const auto projection = make_map_projection("octahedral", 256);
  const MapChannels channels = xyz_channels(spectra());
  const SkyMap map = sky_map(model(), Atmosphere<double>{}, channels, *projection, options);
  std::mt19937 random(1);
  std::uniform_int_distribution<int> any(0, 255);
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    const int x = any(random), y = any(random);
    const Axis d = *projection->direction(x + 0.5, y + 0.5);
    const double zenith = std::acos(d[2]);
    if (std::abs(zenith - kPi / 2) < 2 * kDegree) continue;  // a mean over the pixel
    const SkyPoint point{0, options.sun_zenith, zenith,
                         std::atan2(d[0], d[1]) - options.sun_azimuth};
    const SkyValues sky = model().radiance(Atmosphere<double>{}, channels.nodes, {&point, 1}, {});
    double luminance = 0;
    for (std::size_t k = 0; k < channels.nodes.size(); ++k)
      luminance += channels.weight[1][k] * sky.at(0, static_cast<int>(k));
    const double error =
        static_cast<double>(map.pixels[3 * (static_cast<std::size_t>(y) * 256 + x) + 1]) /
            luminance -
        1;
    worst = std::max(worst, std::abs(error));
  }
  std::printf("[  worst ] %.2e\n", worst);
  EXPECT_LT(worst, 2e-3);
}

void expect_the_models_irradiance(std::string_view projection, double sun_zenith_deg) {
  const SkyMap map = map_of(projection, 128, sun_at(sun_zenith_deg));
  EXPECT_NEAR(map.map_horizontal[1] / map.diffuse_horizontal[1], 1, 0.003)
      << projection << " " << sun_zenith_deg;
}

TEST(SkyMap, ItsIntegralIsTheIrradiance) {
  for (const MapProjectionEntry& projection : map_projections())
    expect_the_models_irradiance(projection.name, 60);
  for (const double zenith : {15.0, 87.0}) expect_the_models_irradiance("equirectangular", zenith);
}

TEST(SkyMap, TheDiscHasTheBeamsIrradiance) {
  const auto projection = make_map_projection("cube", 64);
  SkyMapOptions options = sun_at(30);
  const SkyMap without = map_of("cube", 64, options);
  options.sun_disc = true;
  const SkyMap with = map_of("cube", 64, options);
  double sum = 0;
  for (std::size_t i = 0; i < with.pixels.size() / 3; ++i) {
    const int x = static_cast<int>(i % static_cast<std::size_t>(with.width)),
              y = static_cast<int>(i / static_cast<std::size_t>(with.width));
    sum += (static_cast<double>(with.pixels[3 * i + 1]) -
            static_cast<double>(without.pixels[3 * i + 1])) *
           projection->solid_angle_sr(x, y);
  }
  EXPECT_NEAR(sum / with.direct_normal[1], 1, 1e-4);
}

TEST(SkyMap, GroundAndSpaceCanBeBlack) {
  SkyMapOptions options = sun_at(30);
  options.ground = false;
  const SkyMap map = map_of("equirectangular", 64, options);
  EXPECT_EQ(map.pixels[static_cast<std::size_t>(3 * 128 * 48) + 1], 0);
  EXPECT_GT(map.pixels[static_cast<std::size_t>(3 * 128 * 16) + 1], 100);
  options.altitude_m = 4e5;
  const SkyMap space = map_of("equirectangular", 64, options);
  EXPECT_EQ(space.pixels[static_cast<std::size_t>(3 * 128 * 10) + 1], 0);
}

// A model that has the sky alone fills the upper half from every altitude that it knows.
TEST(SkyMap, HasALevelHorizonByAModelOfTheSkyAlone) {
  for (const char* name : {"preetham", "hosek-wilkie"}) {
    ASSERT_FALSE(sky_model_entry(name).sees_ground);
    SkyMapOptions options = sun_at(30);
    options.altitude_m = 2e3;
    options.ground = false;
    options.level_horizon = true;
    const SkyMap map =
        sky_map(*make_sky_model(name, spectra(), 2),
                parse_preset(refs::shipped_preset_json("earth-hazy"), "earth-hazy").atmosphere,
                xyz_channels(spectra()), *make_map_projection("equirectangular", 16), options);
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x)
        EXPECT_EQ(map.pixels[static_cast<std::size_t>(3 * (y * map.width + x)) + 1] > 0,
                  y < map.height / 2)
            << name << ", row " << y;
    }
  }
}

TEST(SkyMap, WavelengthsAreSpectralRadiances) {
  const std::vector<double> nm = {450, 650};
  const auto projection = make_map_projection("equirectangular", 90);
  const SkyMapOptions options = sun_at(40);
  const SkyMap map = sky_map(model(), Atmosphere<double>{}, spectral_channels(spectra(), nm),
                             *projection, options);
  EXPECT_EQ(map.channels, (std::vector<std::string>{"450nm", "650nm"}));
  const SkyPoint zenith{0, options.sun_zenith, 1 * kDegree,
                        kPi + 1 * kDegree - options.sun_azimuth};
  const SkyValues sky =
      model().radiance(Atmosphere<double>{}, spectral_nodes(spectra(), nm), {&zenith, 1}, {});
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(static_cast<double>(map.pixels[static_cast<std::size_t>(k)]) /
                    (sky.at(0, k) * spectra().solar_irradiance.at(nm[static_cast<std::size_t>(k)])),
                1, 2e-3);
  }
}

// Also in the half of the sky where U changes its sign; the degree and the angle belong to Q and U.
TEST(SkyMap, LayersOfPolarisationAreTheModels) {
  SkyMapOptions options = sun_at(60);
  options.stokes = true;
  const std::vector<double> nm = {450, 650};
  const int size = 128;
  const auto projection = make_map_projection("octahedral", size);
  const MapChannels channels = spectral_channels(spectra(), nm);
  const SkyMap map = sky_map(model(), Atmosphere<double>{}, channels, *projection, options);
  EXPECT_EQ(map.layers, (std::vector<std::string>{"stokes.Q.450nm", "stokes.U.450nm", "dolp.450nm",
                                                  "aolp.450nm", "stokes.Q.650nm", "stokes.U.650nm",
                                                  "dolp.650nm", "aolp.650nm"}));
  for (const auto& [x, y] : {std::pair{40, 50}, {90, 50}, {70, 95}, {50, 80}}) {
    const Axis d = *projection->direction(x + 0.5, y + 0.5);
    const SkyPoint point{0, options.sun_zenith, std::acos(d[2]),
                         options.sun_azimuth - std::atan2(d[0], d[1])};
    const StokesValues light =
        model().stokes(Atmosphere<double>{}, channels.nodes, {&point, 1}, {});
    for (std::size_t k = 0; k < 2; ++k) {
      const auto node = static_cast<int>(k);
      const std::size_t pixel = static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x);
      const float* const layer = &map.layer_values[pixel * 8 + 4 * k];
      const double i = light.i.at(0, node), sun = channels.weight[k][k];
      const LinearPolarisation linear =
          linear_polarisation(i, light.q.at(0, node), light.u.at(0, node));
      constexpr double kBetweenDirections = 1e-3, kAngle_deg = 0.5;
      EXPECT_NEAR(static_cast<double>(layer[0]) / (sun * i), light.q.at(0, node) / i,
                  kBetweenDirections);
      EXPECT_NEAR(static_cast<double>(layer[1]) / (sun * i), light.u.at(0, node) / i,
                  kBetweenDirections);
      EXPECT_NEAR(static_cast<double>(layer[2]), linear.degree, kBetweenDirections);
      EXPECT_NEAR(static_cast<double>(layer[3]), linear.angle_deg, kAngle_deg);
      EXPECT_GT(std::abs(light.u.at(0, node)), 10 * kBetweenDirections * i);
    }
  }
}

// The disc's light is not polarised; the sense of the angle is a sign of U; black stays black.
TEST(SkyMap, LayersOfPolarisationLeaveOutTheDisc) {
  SkyMapOptions options = sun_at(60);
  options.stokes = true;
  options.ground = false;
  const auto projection = make_map_projection("equirectangular", 32);
  const auto map = [&] {
    return sky_map(model(), Atmosphere<double>{}, spectral_channels(spectra(), {450}), *projection,
                   options);
  };
  const SkyMap without = map();
  options.sun_disc = true;
  options.angle = PolarisationAngle::kIau;
  const SkyMap with = map();
  EXPECT_NE(with.pixels, without.pixels);
  for (std::size_t i = 0; i < with.layer_values.size(); i += 4) {
    ASSERT_EQ(with.layer_values[i], without.layer_values[i]);
    ASSERT_EQ(with.layer_values[i + 1], -without.layer_values[i + 1]);
    ASSERT_EQ(with.layer_values[i + 2], without.layer_values[i + 2]);
  }
  EXPECT_EQ(with.layer_values[static_cast<std::size_t>(4 * 64 * 24) + 2], 0);
  EXPECT_GT(with.layer_values[static_cast<std::size_t>(4 * 64 * 2) + 2], 0.2);
}

TEST(SkyMap, LayersOfPolarisationOfColourAreThoseOfLuminance) {
  SkyMapOptions options = sun_at(60);
  options.stokes = true;
  const SkyMap map = map_of("equirectangular", 16, options);
  EXPECT_EQ(map.layers, (std::vector<std::string>{"stokes.Q", "stokes.U", "dolp", "aolp"}));
  const std::size_t pixel = 32 * 2 + 5;
  const float* const layer = &map.layer_values[4 * pixel];
  const double luminance = static_cast<double>(map.pixels[3 * pixel + 1]);
  constexpr double kFloat = 1e-5;
  EXPECT_NEAR(std::hypot(static_cast<double>(layer[0]), static_cast<double>(layer[1])) / luminance,
              static_cast<double>(layer[2]), kFloat);
  EXPECT_GT(layer[2], 0.05);
}

}  // namespace
}  // namespace skyfit
