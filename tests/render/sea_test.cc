// SPDX-License-Identifier: Apache-2.0
// The sea's glitter is that of Cox & Munk 1954, in closed form, in the shader and in a frame; its
// slopes are normalised, its facets reflect by Fresnel.
#include "model/shared/sea.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/glm.hpp>

#include "model/tables/table_lookup.h"
#include "tests/render/frame_fixture.h"
#include "tests/render/map_fixture.h"

namespace skyfit {
namespace {

SharedSea<double> sea;  // stateless

TEST(Sea, WaterReflectsByFresnel) {
  // Head on ((n - 1) / (n + 1))^2; along the surface everything; at Brewster's angle half of one
  // polarisation, ((n^2 - 1) / (n^2 + 1))^2 / 2.
  constexpr double n = 1.34;
  EXPECT_NEAR(sea.water_reflectance(1.0), std::pow((n - 1) / (n + 1), 2), 1e-12);
  EXPECT_NEAR(sea.water_reflectance(0.0), 1, 1e-12);
  EXPECT_NEAR(sea.water_reflectance(std::cos(std::atan(n))),
              0.5 * std::pow((n * n - 1) / (n * n + 1), 2), 1e-12);
}

// Energy: without Fresnel's reflectance the glitter of a high sun over all eyes is the beam's share
// 1 that facets turn upward, nearly all. Integral of L / F * mu_v over the hemisphere = mean facet
// area toward the sun / level area = mu_s.
TEST(Sea, GlitterCarriesTheBeam) {
  const double variance = sea.sea_slope_variance(5.0);
  EXPECT_NEAR(variance, 0.0286, 1e-12);
  for (const double zenith_deg : {0.0, 20.0, 40.0}) {
    const double mu_s = std::cos(zenith_deg * kDegree), sine = std::sin(zenith_deg * kDegree);
    constexpr int kPolar = 400, kAzimuth = 360;
    double sum = 0;
    for (int i = 0; i < kPolar; ++i) {
      const double mu_v = (i + 0.5) / kPolar, across = std::sqrt(1 - mu_v * mu_v);
      for (int j = 0; j < kAzimuth; ++j) {
        const double nu =
            mu_v * mu_s + across * sine * std::cos(2 * std::numbers::pi * (j + 0.5) / kAzimuth);
        const double reflectance = sea.water_reflectance(std::sqrt(0.5 * (1 + nu)));
        sum += sea.sea_glitter(mu_v, mu_s, nu, variance) / reflectance * mu_v *
               (2 * std::numbers::pi / kPolar / kAzimuth);
      }
    }
    EXPECT_NEAR(sum / mu_s, 1, 0.02) << zenith_deg;
  }
}

// From 300 m, where the glitter is most of the light: the frame's light less the mirrored sky
// and the water's own, over the formula without masking.
using SeaOfAMap = MapFiles;

TEST_F(SeaOfAMap, GlitterOfAFrameIsTheFormulas) {
  Scene scene;
  scene.height_map =
      write("flat.png", 16, 8, 1, OIIO::TypeDesc::UINT8, std::vector<float>(16 * 8, 0.0f));
  Renderer drawn = make_renderer(scene);
  for (const double wind : {2.0, 8.0}) {
    FrameOptions options = options_at({300, 125 * kDegree, 0, 60 * kDegree}, 40 * kDegree, 96, 64);
    options.wind_m_s = wind;
    const Frame frame = draw_layers(options, drawn);
    const AtmosphereTables& tables = small_tables();
    const double mu_s = std::cos(options.sun_zenith), variance = 0.003 + 5.12e-3 * wind;
    const auto luminance = [&](const NodeValues& value) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += tables.color.xyz_from_nodes[1][k] * value[k];
      return sum;
    };
    const double beam = luminance(lookup_sun_transmittance(tables, 0, mu_s));
    const glm::dvec3 sun = direction_to(options.sun_zenith, 0);
    WorstPixel worst;
    for (std::size_t i = 0; i < frame.luminance.size(); ++i) {
      const glm::dvec3 to_eye = -ray_of(frame, i);
      const double mu_v = to_eye.z, nu = glm::dot(to_eye, sun);
      if (is_sky(frame, i) || mu_v < 0.3) continue;
      const double cos_incidence = std::sqrt(0.5 * (1 + nu));
      const double mu_n = (mu_v + mu_s) / (2 * cos_incidence);
      const double tangent2 = 1 / (mu_n * mu_n) - 1;
      const double expected = beam * sea.water_reflectance(cos_incidence) *
                              std::exp(-tangent2 / variance) /
                              (std::numbers::pi * variance * 4 * mu_v * std::pow(mu_n, 4));
      const double seen =
          luminance_of(frame.layers->reflected, i) / luminance_of(frame.layers->transmittance, i);
      // In the mean slope that the eye sees.
      const double slope = sea.sea_seen_slope(mu_v, variance) / std::sqrt(1 - mu_v * mu_v);
      const glm::dvec3 normal = glm::normalize(glm::dvec3(slope * to_eye.x, slope * to_eye.y, 1));
      const glm::dvec3 mirrored = glm::reflect(-to_eye, normal);
      const double sky =
          sea.water_reflectance(glm::dot(to_eye, normal)) *
          luminance(lookup_radiance(tables, 0, mirrored.z, mu_s, glm::dot(mirrored, sun), false));
      const double water = luminance_of(frame.layers->albedo, i) / std::numbers::pi *
                           (beam * mu_s + luminance(lookup_irradiance(tables, 0, mu_s)));
      if (expected < 2 * (sky + water)) continue;
      worst.add(frame, i, (seen - sky - water) / expected - 1);
    }
    std::printf("[ sea    ] wind %g m/s\n", wind);
    worst.print("glitter");
    EXPECT_GT(worst.count(), 300);
    EXPECT_LT(worst.error(), 0.05);
  }
}

// Under closed clouds, from 2 m: the light of the level sea less the water's own is the share that
// water reflects of what another picture shows in the mirrored directions. A clear sky is far from
// it.
TEST_F(SeaOfAMap, MirrorsTheCloudsAboveIt) {
  Scene scene;
  scene.height_map =
      write("flat.png", 16, 8, 1, OIIO::TypeDesc::UINT8, std::vector<float>(16 * 8, 0.0f));
  Renderer drawn = make_renderer(scene);
  constexpr double kView = 78 * kDegree, kSun = 50 * kDegree, kAzimuth = 70 * kDegree;
  const auto draw = [&](double view_zenith, std::vector<CloudLayer> clouds) {
    FrameOptions options = options_at({2, view_zenith, kAzimuth, 10 * kDegree}, kSun, 32, 32);
    options.wind_m_s = 0;
    options.clouds = std::move(clouds);
    options.shadows = true;
    return draw_layers(options, drawn);
  };
  const AtmosphereTables& tables = small_tables();
  double sky = 0;
  const NodeValues irradiance = lookup_irradiance(tables, 0, std::cos(kSun));
  for (std::size_t k = 0; k < 4; ++k) sky += tables.color.xyz_from_nodes[1][k] * irradiance[k];
  const std::vector<CloudLayer> closed = {{3000, 1, 1}};
  const Frame sea_frame = draw(std::numbers::pi - kView, closed), above = draw(kView, closed),
              clear = draw(kView, {});
  const double variance = sea.sea_slope_variance(0.0);
  WorstPixel worst;
  double difference = 0;
  for (std::size_t i = 0; i < sea_frame.luminance.size(); ++i) {
    const glm::dvec3 to_eye = -ray_of(sea_frame, i);
    const double slope =
        sea.sea_seen_slope(to_eye.z, variance) / std::sqrt(1 - to_eye.z * to_eye.z);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(slope * to_eye.x, slope * to_eye.y, 1));
    const glm::dvec3 mirrored = glm::reflect(-to_eye, normal);
    std::size_t nearest = 0;
    for (std::size_t j = 0; j < above.luminance.size(); ++j)
      if (glm::dot(ray_of(above, j), mirrored) > glm::dot(ray_of(above, nearest), mirrored))
        nearest = j;
    if (std::acos(std::min(glm::dot(ray_of(above, nearest), mirrored), 1.0)) > 0.4 * kDegree)
      continue;
    const double own = luminance_of(sea_frame.layers->albedo, i) / std::numbers::pi * sky;
    const double reflected = luminance_of(sea_frame.layers->reflected, i) /
                                 luminance_of(sea_frame.layers->transmittance, i) -
                             own;
    const double share = sea.water_reflectance(glm::dot(to_eye, normal));
    worst.add(sea_frame, i, reflected / (share * above.luminance[nearest]) - 1);
    difference =
        std::max(difference, std::abs(above.luminance[nearest] / clear.luminance[nearest] - 1.0));
  }
  worst.print("mirrored clouds");
  EXPECT_GT(worst.count(), 300);
  EXPECT_LT(worst.error(), 0.02);  // the nearest pixel is up to 0.2 deg off
  EXPECT_GT(difference, 0.2) << "of clouds to a clear sky";
}

}  // namespace
}  // namespace skyfit
