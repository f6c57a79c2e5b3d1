// SPDX-License-Identifier: Apache-2.0
// What everyone knows of light in the air holds in a frame: distance fades monotonically and turns
// blue, low suns are red, the horizon is bright, the zenith darkens with altitude, the earth casts
// its shadow; suns add up.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>

#include "model/tables/table_lookup.h"
#include "tests/render/mesh_fixture.h"

namespace skyfit {
namespace {

constexpr double kTables = 0.01;       // of small tables, between two ways through them
constexpr double kFloatSum = 2e-6;     // sums of floats in another order
constexpr double kColorMatrix = 1e-5;  // relative to the largest component, which may cancel

std::size_t middle_of(const Frame& frame) {
  return static_cast<std::size_t>(frame.height / 2) * frame.width + frame.width / 2;
}

// Luminance of the sky in a direction.
double sky_luminance(double altitude, double sun_deg, double zenith_deg, double azimuth_deg,
                     Renderer& with = renderer()) {
  const Frame frame =
      with.draw(options_at({altitude, zenith_deg * kDegree, azimuth_deg * kDegree, 1 * kDegree},
                           sun_deg * kDegree, 9, 9));
  EXPECT_TRUE(is_sky(frame, middle_of(frame)));
  return frame.luminance[middle_of(frame)];
}

TEST(Distance, AddsLightAndTakesTransmittance) {
  // The same ray, ever more of it, by a sphere that fills the middle of the picture.
  for (const double zenith : {60.0, 88.0, 100.0}) {
    for (const double sun : {40.0, 85.0}) {
      double scattered = 0, passed = 1.0000001;
      // Shorter paths are within the error of these small tables.
      for (double d = 60; d < (zenith > 90 ? 40e3 : 1e6); d *= 2) {
        FrameOptions options = options_at({10e3, zenith * kDegree, 1, 0.1}, sun * kDegree, 16, 16);
        options.moon = Moon{options.camera.view_zenith, 1, d, 0.1 * d, 0.1};
        const Frame frame = draw_layers(options);
        const std::size_t i = middle_of(frame);
        ASSERT_LT(frame.depth_m[i], d);
        const double now = luminance_of(frame.layers->in_scatter, i);
        // Where there is no air left, nothing more is added or taken.
        const bool air = 10e3 + d * std::cos(options.camera.view_zenith) < 60e3;
        EXPECT_GT(now, scattered * (air ? 1 : 1 - kFloatSum))
            << "zenith " << zenith << ", distance " << d;
        scattered = now;
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_LE(frame.layers->transmittance[3 * i + k], 1 + kColorMatrix);
        const double t = luminance_of(frame.layers->transmittance, i);
        EXPECT_LE(t, passed + kFloatSum) << "zenith " << zenith << ", distance " << d;
        EXPECT_GT(t, 0);
        passed = t;
      }
      EXPECT_LT(passed, 0.99);
    }
  }
}

TEST(Distance, AddsLightAndTakesTransmittanceOverThePlain) {
  const Frame frame = draw_layers(options_of("ground", 96, 60));
  int compared = 0;
  for (int x = 0; x < frame.width; x += 5) {
    for (int y = frame.height - 2; y >= 0; --y) {
      const auto above = static_cast<std::size_t>(y * frame.width + x), below = above + frame.width;
      if (is_sky(frame, above)) break;
      ASSERT_GT(frame.depth_m[above], frame.depth_m[below]);
      EXPECT_GT(luminance_of(frame.layers->in_scatter, above),
                luminance_of(frame.layers->in_scatter, below));
      EXPECT_LT(luminance_of(frame.layers->transmittance, above),
                luminance_of(frame.layers->transmittance, below) + kFloatSum);
      ++compared;
    }
  }
  EXPECT_GT(compared, 200);
}

TEST(Distance, TurnsADarkThingBlueByDay) {
  // Above the haze, which whitens.
  const auto color_at = [](double d) {
    FrameOptions options =
        options_at({4e3, 89 * kDegree, 180 * kDegree, 0.1}, 40 * kDegree, 16, 16);
    options.moon = Moon{options.camera.view_zenith, options.camera.azimuth, d, 0.1 * d, 0.02};
    const Frame frame = renderer().draw(options);
    EXPECT_LT(frame.depth_m[middle_of(frame)], d);
    return color_of(frame.rgb, middle_of(frame));
  };
  const glm::dvec3 near = color_at(10), far = color_at(30e3);
  std::printf("[   blue ] blue / red %.2f at 10 m, %.2f at 30 km\n", near.b / near.r,
              far.b / far.r);
  EXPECT_GT(far.b, far.r);
  EXPECT_GT(far.b / far.r, 1.3 * near.b / near.r);
  EXPECT_GT(far.g, near.g);  // and brighter: it is dark
}

TEST(Sun, IsRedderAtSunsetThanAtNoon) {
  const auto color_at = [](double zenith) {
    const Frame frame = renderer().draw(
        options_at({100, zenith * kDegree, 0, 1 * kDegree}, zenith * kDegree, 17, 17));
    return color_of(frame.rgb, middle_of(frame));
  };
  const glm::dvec3 noon = color_at(20), low = color_at(80), sunset = color_at(88);
  std::printf(
      "[    red ] blue / red %.3f, %.3f, %.3f and %.3g, %.3g, %.3g cd/m^2 of green with the "
      "sun at 20, 80, 88 deg\n",
      noon.b / noon.r, low.b / low.r, sunset.b / sunset.r, noon.g, low.g, sunset.g);
  EXPECT_LT(low.b / low.r, 0.7 * noon.b / noon.r);
  EXPECT_LT(sunset.b / sunset.r, 0.3 * low.b / low.r);  // blue is out of the gamut by then
  EXPECT_LT(sunset.g / sunset.r, 0.7 * low.g / low.r);
  EXPECT_LT(sunset.g, 0.3 * noon.g);
  EXPECT_GT(sunset.r, sunset.g);
}

TEST(Sky, IsBrighterAtTheHorizonThanAtTheZenith) {
  for (const double sun : {50.0, 60.0, 70.0}) {
    for (const double azimuth : {0.0, 25.0, 50.0}) {  // over the water
      const double horizon = sky_luminance(2, sun, 82, azimuth),
                   zenith = sky_luminance(2, sun, 0, 0);
      EXPECT_GT(horizon, 1.3 * zenith) << "sun " << sun << ", azimuth " << azimuth;
    }
  }
}

TEST(Sky, DarkensAtTheZenithWithAltitude) {
  for (const double sun : {40.0, 75.0}) {
    const double ground = sky_luminance(2, sun, 0, 0), flight = sky_luminance(10e3, sun, 0, 0),
                 balloon = sky_luminance(40e3, sun, 0, 0);
    std::printf("[ zenith ] sun %g: %.4g, %.4g, %.4g cd/m^2 at 2 m, 10 km, 40 km\n", sun, ground,
                flight, balloon);
    EXPECT_LT(flight, 0.6 * ground);
    EXPECT_LT(balloon, 0.1 * flight);
    EXPECT_GT(balloon, 0);
  }
}

TEST(Sky, ShowsTheEarthsShadowOppositeTheSunAfterSunset) {
  // From above the haze: the shadow's edge rises as the sun sinks. With the suns of small tables
  // the belt of a sun at -4 deg would be too dark by an eighth.
  TableSizes sizes = kSmallTables;
  sizes.scattering_mu_s = TableSizes{}.scattering_mu_s;
  const AtmosphereTables tables = tables_of(earth_clear(), sizes);
  Renderer drawn = make_renderer();
  drawn.set_atmosphere(earth_clear(), tables);
  double before = 0;
  for (const double down : {1.0, 2.0, 3.0, 4.0}) {
    const auto luminance = [&](double elevation) {
      return sky_luminance(5e3, 90 + down, 90 - elevation, 180, drawn);
    };
    double brightest = 0, belt = 0;
    for (double elevation = 0.5; elevation < 30; elevation += 0.5) {
      const double l = luminance(elevation);
      if (l > brightest) brightest = l, belt = elevation;
    }
    const double low = luminance(0.5), part = luminance(0.8 * down) / brightest;
    std::printf(
        "[ shadow ] sun at -%g deg: %.3g cd/m^2 at 0.5 deg, %.3g in the shadow at %.1f, "
        "brightest %.3g at %.1f deg\n",
        down, low, part * brightest, 0.8 * down, brightest, belt);
    EXPECT_LT(low, 0.7 * brightest);
    EXPECT_GT(belt, down);  // the shadow's edge stands about as high as the sun is low
    EXPECT_GT(belt, before);
    before = belt;
  }
}

TEST(Moon, OutsideTheAirHasAllOfItsLightInFront) {
  FrameOptions options = options_at({2, 60 * kDegree, 90 * kDegree, 2 * kDegree}, 1, 32, 32);
  const Frame without = draw_layers(options);
  options.moon = Moon{60 * kDegree, 90 * kDegree};
  const Frame with = draw_layers(options);
  WorstPixel worst;
  int covered = 0;
  for (std::size_t i = 0; i < with.luminance.size(); ++i) {
    worst.add(
        with, i,
        luminance_of(with.layers->in_scatter, i) / luminance_of(without.layers->in_scatter, i) - 1);
    if (is_sky(with, i)) continue;
    ++covered;
    EXPECT_GE(with.luminance[i], without.luminance[i] * (1 - kTables));
  }
  worst.print("in-scatter with and without the moon");
  EXPECT_GT(covered, 30);
  EXPECT_LT(worst.error(), 1e-3);  // of an empty path from the top to the moon
}

TEST(Moon, InsideTheAirHasLessLightInFrontThanTheSky) {
  FrameOptions options = options_at({2, 80 * kDegree, 90 * kDegree, 10 * kDegree}, 1, 32, 32);
  const Frame without = draw_layers(options);
  options.moon = Moon{80 * kDegree, 90 * kDegree, 29e3, 1e3, 0.5};  // 5 km high
  const Frame with = draw_layers(options);
  int covered = 0;
  for (std::size_t i = 0; i < with.luminance.size(); ++i) {
    if (is_sky(with, i) || !is_sky(without, i)) continue;
    ++covered;
    const double part =
        luminance_of(with.layers->in_scatter, i) / luminance_of(without.layers->in_scatter, i);
    EXPECT_GT(part, 0.2);
    EXPECT_LT(part, 0.95);
    EXPECT_GT(luminance_of(with.layers->reflected, i), 0);
  }
  EXPECT_GT(covered, 100);
}

TEST(Moon, ShowsNoSeamWhereItCrossesTheAtmospheresEdge) {
  const double bottom = earth_clear().atmosphere.bottom_radius_m,
               thickness = earth_clear().atmosphere.top_radius_m - bottom;
  for (const double altitude : {2.0, 99e3, 130e3}) {
    // A sphere beside the eye whose front reaches from below the edge to above it.
    FrameOptions options =
        options_at({altitude, altitude > 1e4 ? 95 * kDegree : 50 * kDegree, 180 * kDegree, 0.7},
                   40 * kDegree, 64, 64);
    options.moon = Moon{options.camera.view_zenith, 180 * kDegree, 200e3, 70e3, 0.5};
    const Frame frame = draw_layers(options);
    // Second differences down the columns, of light per albedo: a seam is one that stands out.
    double at_edge = 0, elsewhere = 0;
    int crossings = 0;
    for (int x = 12; x < 52; ++x) {
      std::vector<double> light, height;
      for (int y = 8; y < 56; ++y) {
        const auto i = static_cast<std::size_t>(y * 64 + x);
        if (is_sky(frame, i) || frame.layers->albedo[3 * i] <= 0) {
          light.clear(), height.clear();
          continue;
        }
        const glm::dvec3 p =
            double{frame.depth_m[i]} * ray_of(frame, i) + glm::dvec3(0, 0, bottom + altitude);
        height.push_back(glm::length(p) - bottom);
        light.push_back(luminance_of(frame.layers->reflected, i) /
                            luminance_of(frame.layers->albedo, i) +
                        luminance_of(frame.layers->in_scatter, i));
        const std::size_t n = light.size();
        if (n < 3) continue;
        const double bend = std::abs(light[n - 1] - 2 * light[n - 2] + light[n - 3]) / light[n - 2];
        const bool crosses = (height[n - 1] - thickness) * (height[n - 3] - thickness) <= 0;
        crossings += crosses ? 1 : 0;
        double& largest = crosses ? at_edge : elsewhere;
        largest = std::max(largest, bend);
      }
    }
    std::printf(
        "[   seam ] eye at %g m: second differences %.2g at the edge, %.2g elsewhere, %d "
        "crossings\n",
        altitude, at_edge, elsewhere, crossings);
    EXPECT_GT(crossings, 20);
    EXPECT_LT(at_edge, 2 * elsewhere + 1e-3);
  }
}

TEST(SecondSun, AddsItsLight) {
  const FrameOptions first = options_at({2, 60 * kDegree, 0.3, 1}, 70 * kDegree, 64, 40);
  const SecondSun other{50 * kDegree, 75 * kDegree, 0.3};
  FrameOptions both = first, second = first;
  both.second_sun = other;
  second.sun_zenith = other.zenith;
  second.camera.azimuth -= other.azimuth;
  const Frame sum = renderer().draw(both), a = renderer().draw(first), b = renderer().draw(second);
  WorstPixel worst;
  for (std::size_t i = 0; i < sum.luminance.size(); ++i) {
    if (!is_sky(sum, i) || !is_sky(a, i) || !is_sky(b, i)) continue;
    worst.add(sum, i, sum.luminance[i] / (a.luminance[i] + other.irradiance * b.luminance[i]) - 1);
  }
  worst.print("both suns against their sum");
  EXPECT_GT(worst.count(), 1000);
  EXPECT_LT(worst.error(), kTables);
}

bool at_edge_of_gamut(const std::vector<float>& rgb, std::size_t pixel) {
  const glm::dvec3 color = color_of(rgb, pixel);
  return std::min({color.r, color.g, color.b}) <= 0 && luminance_of(rgb, pixel) > 0;
}

void expect_layers_to_add_up(std::initializer_list<const char*> views) {
  for (const char* view : views) {
    FrameOptions options = options_of(view, 64, 40);
    options.shadows = true;
    options.clouds = {CloudLayer{}};
    options.second_sun = SecondSun{};
    options.moon = Moon{options.camera.view_zenith - 0.1, options.camera.azimuth, 50e3, 2e3, 0.3};
    const Frame frame = draw_layers(options);
    WorstPixel worst, luminance;
    for (std::size_t i = 0; i < frame.luminance.size(); ++i) {
      const std::vector<float>&air = frame.layers->in_scatter, &ground = frame.layers->reflected;
      const double whole = luminance_of(air, i) + luminance_of(ground, i);
      luminance.add(frame, i, (whole - frame.luminance[i]) / std::max(whole, 1e-6));
      // Brought into the gamut, each by itself, three parts add up by their luminance only.
      if (at_edge_of_gamut(air, i) || at_edge_of_gamut(ground, i)) continue;
      const glm::dvec3 sum = color_of(air, i) + color_of(ground, i);
      const glm::dvec3 off = sum - color_of(frame.rgb, i);
      const double scale = std::max({std::abs(sum.r), std::abs(sum.g), std::abs(sum.b), 1e-6});
      worst.add(frame, i, glm::length(off) / scale);
    }
    worst.print(view);
    luminance.print("by luminance");
    EXPECT_GT(worst.count(), 64 * 40 / 2);
    EXPECT_LT(worst.error(), kColorMatrix) << view;
    EXPECT_LT(luminance.error(), kColorMatrix) << view;
  }
}

TEST(Layers, AddUpToThePicture) { expect_layers_to_add_up({"valley", "space"}); }
TEST(SlowLayers, AddUpToThePicture) { expect_layers_to_add_up({"sunset", "10km", "limb"}); }

}  // namespace
}  // namespace skyfit
