// SPDX-License-Identifier: Apache-2.0
// The sky in a frame has the luminance that its model gives for the same direction, within 1 %,
// from every named view and under suns from the zenith to the horizon.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "data_refs/spectra.h"
#include "model/registry.h"
#include "model/sky_model.h"
#include "render/render.h"
#include "tests/render/gl_fixture.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTables = 0.01;  // what interpolation in the tables may cost
// The limb beyond the terminator, darker than a thousandth of its brightest part, where the texels
// of the sun are too coarse: twice as many halve the error.
constexpr double kShadow = 0.04, kShadowed = 1e-3;

struct SkyPixels {
  std::vector<float> luminance;
  std::vector<SkyPoint> points;
};

// Of every eleventh pixel, without the sun's disc, the ground and the air above 60 km, where next
// to nothing is to be seen.
SkyPixels sky_pixels(const Frame& frame, const FrameOptions& options, double bottom_radius) {
  SkyPixels sky;
  const double r = bottom_radius + options.camera.altitude_m;
  for (std::size_t i = 0; i < frame.luminance.size(); i += 11) {
    if (std::isfinite(frame.depth_m[i])) continue;
    const SkyPoint point{options.camera.altitude_m, options.sun_zenith,
                         frame.view_zenith_deg[i] * kDegree, frame.view_azimuth_deg[i] * kDegree};
    const double from_sun =
        std::cos(point.view_zenith) * std::cos(point.sun_zenith) +
        std::sin(point.view_zenith) * std::sin(point.sun_zenith) * std::cos(point.relative_azimuth);
    if (from_sun > std::cos(1 * kDegree)) continue;  // the disc is drawn apart
    const bool down = point.view_zenith > std::numbers::pi / 2;
    const double tangent = (down ? r * std::sin(point.view_zenith) : r) - bottom_radius;
    if (tangent < 0 || tangent > 60e3) continue;
    sky.luminance.push_back(frame.luminance[i]);
    sky.points.push_back(point);
  }
  return sky;
}

void expect_agreement(const SkyPixels& sky, const double* expected, double tolerance_of_dark) {
  const std::size_t count = sky.points.size();
  const double brightest = *std::max_element(expected, expected + count);
  double worst = 0;
  for (std::size_t p = 0; p < count; ++p) {
    if (expected[p] < 1e-4 * brightest) continue;  // next to nothing
    const double error = std::abs(sky.luminance[p] / expected[p] - 1);
    worst = std::max(worst, error);
    const SkyPoint& at = sky.points[p];
    EXPECT_LT(error, expected[p] < kShadowed * brightest ? tolerance_of_dark : kTables)
        << "view zenith " << at.view_zenith / kDegree << ", azimuth "
        << at.relative_azimuth / kDegree << ": frame " << sky.luminance[p] << ", model "
        << expected[p] << " cd/m^2";
  }
  std::printf("[   worst ] sun %2.0f: %.2f %% of %zu points\n",
              sky.points.front().sun_zenith / kDegree, 100 * worst, count);
}

struct View {
  const char* name;
  std::vector<double> suns;  // degrees
};
struct Sky {
  const char *model, *preset;
  std::vector<View> views;
};
class SkyAgreement : public ::testing::TestWithParam<Sky> {};

TEST_P(SkyAgreement, SkyPixelsHaveTheModelsLuminance) {
  const auto& [model_name, preset_name, views] = GetParam();
  const Preset preset = shipped(preset_name);
  const SpectralData& spectra = refs::standard_spectral_data();
  const auto model = make_sky_model(model_name, spectra, 2);
  // The sky of the others is read from tables of theirs.
  const TableSizes sizes = model->name() == "reference" ? TableSizes{} : kSmallTables;
  static Renderer renderer;  // it keeps its shaders and its ground
  renderer.set_atmosphere(
      preset, compute_tables_of(*model, preset.atmosphere, color_rule(spectra), sizes, 2, {}));
  FrameOptions options;
  options.width = 96;
  options.height = 60;
  options.samples_per_side = 1;
  std::vector<SkyPixels> skies;
  std::vector<SkyPoint> points;  // of all frames: the model then solves its field once
  for (const View& view : views) {
    options.camera = find_view(view.name).camera;
    for (const double sun : view.suns) {
      options.sun_zenith = sun * kDegree;
      skies.push_back(
          sky_pixels(renderer.draw(options), options, preset.atmosphere.bottom_radius_m));
      ASSERT_FALSE(skies.back().points.empty());
      points.insert(points.end(), skies.back().points.begin(), skies.back().points.end());
    }
  }
  const LuminanceRule rule = luminance_rule(spectra);
  const SkyValues values = model->radiance(preset.atmosphere, rule.nodes, points, {});
  std::vector<double> expected(points.size(), 0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    for (std::size_t k = 0; k < rule.nodes.size(); ++k)
      expected[p] += rule.weight[k] * values.at(static_cast<int>(p), static_cast<int>(k));
  }
  const double* of_sky = expected.data();
  for (const SkyPixels& sky : skies) {
    const bool outside = sky.points.front().altitude_m > 60e3;
    expect_agreement(sky, of_sky, outside ? kShadow : kTables);
    of_sky += sky.points.size();
  }
}

INSTANTIATE_TEST_SUITE_P(
    NamedViews, SkyAgreement,
    ::testing::Values(
        Sky{"reference",
            "earth-clear",
            {{"ground", {85}},
             {"sunset", {80, 88}},
             {"away", {75}},
             {"10km", {60, 90}},
             {"orbit", {30, 85}},
             {"limb", {0, 30, 60, 80, 85, 88, 90}},
             {"space", {30, 60, 85}}}},
        Sky{"reference",
            "bruneton-2008",
            {{"ground", {60}},
             {"sunset", {90}},
             {"away", {30, 88}},
             {"10km", {90}},
             {"limb", {30, 75, 85, 90}},
             {"space", {30, 75, 88}}}},
        Sky{"bruneton",
            "earth-clear",
            {{"ground", {30, 80, 88}}, {"10km", {60, 92}}, {"orbit", {30, 88}}}},
        Sky{"hillaire", "earth-clear", {{"ground", {30, 88}}, {"10km", {92}}, {"orbit", {30}}}},
        Sky{"bodare", "earth-clear", {{"sunset", {60, 90}}}},
        Sky{"oneil", "earth-clear", {{"10km", {60, 92}}, {"limb", {30, 85, 90}}}},
        Sky{"oneil", "oneil-2005", {{"sunset", {60, 88}}}},
        Sky{"oneil:samples=3:isotropic-air:no-shadow",
            "oneil-2005",
            {{"ground", {30, 92}}, {"space", {60}}}},
        Sky{"oneil:samples=20", "oneil-2005", {{"limb", {30, 85, 92}}}},
        Sky{"nielsen", "earth-hazy", {{"10km", {88}}}},
        Sky{"nielsen:rayleigh-phase:sun-through-sky", "nielsen-2003", {{"10km", {60}}}},
        Sky{"hoffman-preetham", "nielsen-2003", {{"10km", {30}}}},
        Sky{"preetham", "earth-hazy", {{"ground", {30, 80}}}},
        Sky{"hosek-wilkie", "earth-hazy", {{"ground", {30, 80}}}}));

INSTANTIATE_TEST_SUITE_P(
    SlowViews, SkyAgreement,
    ::testing::Values(
        Sky{"bodare", "earth-clear", {{"limb", {30, 85, 92}}}},
        Sky{"bodare:mie-from-rayleigh", "bodare-2014", {{"sunset", {60}}}},
        Sky{"bruneton:half-inscatter:mie-from-rayleigh", "sperlhofer-2011", {{"ground", {60, 91}}}},
        Sky{"schafhitzel", "bruneton-2008", {{"valley", {80}}, {"limb", {30, 85, 90}}}}));

}  // namespace
}  // namespace skyfit
