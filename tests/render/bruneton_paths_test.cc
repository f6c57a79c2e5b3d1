// SPDX-License-Identifier: Apache-2.0
// Frames of `bruneton` without its repairs: the ground is seen through transmittances in half
// floats, and light before it is the difference of two look-ups by radii. Far from the horizon
// both are what the repaired ones are, to their noise; beside it the latter is dark in places.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/registry.h"
#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

const Preset& preset() {
  static const Preset loaded = shipped("sperlhofer-2011");
  return loaded;
}

// What the layers hold where the ground is.
struct Paths {
  std::vector<double> in_scatter, transmittance;
};
Paths paths(const std::string& model, const FrameOptions& options) {
  static Renderer renderer;
  const SpectralData& spectra = refs::standard_spectral_data();
  renderer.set_atmosphere(preset(),
                          compute_tables_of(*make_sky_model(model, spectra, 2), preset().atmosphere,
                                            color_rule(spectra), kSmallTables, 2, {}));
  const Frame frame = draw_layers(options, renderer);
  Paths found;
  for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
    if (!std::isfinite(frame.depth_m[i])) continue;
    found.in_scatter.push_back(double{frame.layers->in_scatter[3 * i + 1]});
    found.transmittance.push_back(double{frame.layers->transmittance[3 * i + 1]});
  }
  return found;
}

// Mean of the distance of the ratios from 1; not 0.
double mean_error(const std::vector<double>& values, const std::vector<double>& expected) {
  EXPECT_EQ(values.size(), expected.size());
  EXPECT_GT(values.size(), 500u);
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += std::abs(values[i] / expected[i] - 1);
  EXPECT_GT(sum, 0);
  return sum / static_cast<double>(values.size());
}

TEST(BrunetonPaths, FarFromTheHorizonTheyAreTheRepairedOnes) {
  FrameOptions options = options_of("10km", 96, 60);
  options.sun_zenith = 60 * kDegree;
  options.camera.view_zenith = 120 * kDegree;
  options.aerial = AerialPerspective::kPerPixel;
  const Paths repaired = paths("bruneton", options),
              noisy = paths("bruneton:half-transmittance", options),
              by_radii = paths("bruneton:half-inscatter", options);
  std::printf("[ mean ] transmittance %.2g, in-scatter by it %.2g, by radii %.2g\n",
              mean_error(noisy.transmittance, repaired.transmittance),
              mean_error(noisy.in_scatter, repaired.in_scatter),
              mean_error(by_radii.in_scatter, repaired.in_scatter));
  EXPECT_LT(mean_error(noisy.transmittance, repaired.transmittance), 1e-3);
  EXPECT_LT(mean_error(noisy.in_scatter, repaired.in_scatter), 1e-3);
  EXPECT_EQ(by_radii.transmittance, repaired.transmittance);
  EXPECT_LT(mean_error(by_radii.in_scatter, repaired.in_scatter), 0.02);
}

TEST(BrunetonPaths, ByRadiiTheyAreDarkInPlacesBesideTheHorizon) {
  FrameOptions options = options_of("sunset", 96, 60);
  options.sun_zenith = 85 * kDegree;
  options.camera.azimuth = 40 * kDegree;  // to the land
  options.camera.view_zenith = 92 * kDegree;
  options.camera.vertical_fov = 12 * kDegree;
  options.aerial = AerialPerspective::kPerPixel;
  const Paths repaired = paths("bruneton", options),
              by_radii = paths("bruneton:half-inscatter", options);
  ASSERT_EQ(by_radii.in_scatter.size(), repaired.in_scatter.size());
  int dark = 0;
  for (std::size_t i = 0; i < repaired.in_scatter.size(); ++i)
    dark += by_radii.in_scatter[i] < 0.75 * repaired.in_scatter[i];
  std::printf("[ a quarter too dark ] %d of %zu pixels\n", dark, repaired.in_scatter.size());
  EXPECT_GT(dark, static_cast<int>(repaired.in_scatter.size() / 20));
}

}  // namespace
}  // namespace skyfit
