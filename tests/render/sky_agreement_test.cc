// SPDX-License-Identifier: Apache-2.0
// The sky in a frame has the luminance that the reference model gives for the same direction, from
// every named view.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "data_refs/spectra.h"
#include "model/sky_model.h"
#include "render/render.h"
#include "tests/render/gl_fixture.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kTables = 0.03;  // what interpolation in the tables may cost

class SkyAgreement : public ::testing::TestWithParam<std::tuple<std::string, std::string, double>> {
};

TEST_P(SkyAgreement, SkyPixelsHaveTheModelsLuminance) {
  const auto& [preset_name, view, sun] = GetParam();
  const Preset preset = shipped(preset_name);
  static std::map<std::string, AtmosphereTables> cache;
  if (!cache.contains(preset_name)) cache.emplace(preset_name, tables_of(preset, TableSizes{}));
  FrameOptions options;
  options.width = 96;
  options.height = 60;
  options.samples_per_side = 1;
  options.camera = find_view(view).camera;
  options.sun_zenith = sun * kDegree;
  const Frame frame = render_frame(preset, cache.at(preset_name), options);

  std::vector<std::size_t> pixels;
  std::vector<SkyPoint> points;
  const double r = preset.atmosphere.bottom_radius_m + options.camera.altitude_m;
  for (std::size_t i = 0; i < frame.luminance.size(); i += 7) {
    if (std::isfinite(frame.depth_m[i])) continue;
    const SkyPoint point{options.camera.altitude_m, options.sun_zenith,
                         frame.view_zenith_deg[i] * kDegree, frame.view_azimuth_deg[i] * kDegree};
    const double from_sun =
        std::cos(point.view_zenith) * std::cos(point.sun_zenith) +
        std::sin(point.view_zenith) * std::sin(point.sun_zenith) * std::cos(point.relative_azimuth);
    if (from_sun > std::cos(1 * kDegree)) continue;  // the disc is drawn apart
    const bool down = point.view_zenith > std::numbers::pi / 2;
    const double tangent = down ? r * std::sin(point.view_zenith) : r;
    if (tangent < preset.atmosphere.bottom_radius_m) continue;         // the ground itself
    if (tangent > preset.atmosphere.bottom_radius_m + 60e3) continue;  // next to nothing to see
    pixels.push_back(i);
    points.push_back(point);
  }
  const LuminanceRule rule = luminance_rule(refs::standard_spectral_data());
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  const SkyValues values = model->radiance(preset.atmosphere, rule.nodes, points, {});
  double worst = 0, brightest = 0;
  std::size_t worst_point = 0;
  std::vector<double> expected(points.size(), 0);
  for (std::size_t p = 0; p < points.size(); ++p) {
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      expected[p] += rule.weight[k] * values.at(static_cast<int>(p), static_cast<int>(k));
    }
    brightest = std::max(brightest, expected[p]);
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (expected[p] < 1e-4 * brightest) continue;  // in the planet's shadow
    const double error = std::abs(frame.luminance[pixels[p]] / expected[p] - 1);
    if (error > worst) worst = error, worst_point = p;
  }
  std::printf("[   worst ] %.2f %% of %zu points\n", 100 * worst, points.size());
  if (points.empty()) return;  // a view of nothing but ground and space
  const SkyPoint& at = points[worst_point];
  EXPECT_LT(worst, kTables) << "view zenith " << at.view_zenith / kDegree << ", azimuth "
                            << at.relative_azimuth / kDegree << ": frame "
                            << frame.luminance[pixels[worst_point]] << ", model "
                            << expected[worst_point] << " cd/m^2";
}

using ::testing::Combine;
using ::testing::Values;

INSTANTIATE_TEST_SUITE_P(ClearSky, SkyAgreement,
                         Combine(Values("earth-clear"), Values("ground", "sunset", "away", "10km"),
                                 Values(30.0, 80.0, 85.0)));
INSTANTIATE_TEST_SUITE_P(OtherSky, SkyAgreement,
                         Combine(Values("bruneton-2008"),
                                 Values("ground", "sunset", "away", "10km"), Values(60.0)));
INSTANTIATE_TEST_SUITE_P(FromSpace, SkyAgreement,
                         Combine(Values("earth-clear"), Values("limb"),
                                 Values(30.0, 60.0, 80.0, 85.0)));

}  // namespace
}  // namespace skyfit
