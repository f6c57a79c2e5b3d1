// SPDX-License-Identifier: Apache-2.0
// The maps of polarisation show the model's Q / I and U / I, mirrored about the sun's vertical
// circle, and name the neutral points; the colours of angles have a period of half a turn.
#include <gmock/gmock.h>

#include <numbers>

#include "data_refs/spectra.h"
#include "model/solver/reference_model.h"
#include "render/plot/figure_style.h"
#include "render/plot/polarisation_maps.h"

namespace skyfit::plot {
namespace {

using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;
const WavelengthNode kNode = spectral_nodes(refs::standard_spectral_data(), {450}).front();

TEST(PlotPolarisation, ShowsTheModel) {
  const ReferenceModel model({});
  const Atmosphere<double> air;
  const PolarisedSky sky = polarised_sky(model, air, kNode, 0, 60 * kDegree);
  for (const double zenith : {17.3, 44.4, 80.7}) {
    for (const double azimuth : {-133.1, -20.5, 77.7}) {
      const SkyPoint at{0, 60 * kDegree, zenith * kDegree, azimuth * kDegree};
      const StokesValues light = model.stokes(air, {&kNode, 1}, {&at, 1}, {});
      const auto [q, u] = polarisation_of(sky, at.view_zenith, at.relative_azimuth);
      constexpr double kBetweenDirections = 1e-3;
      EXPECT_NEAR(q, light.q.value[0] / light.i.value[0], kBetweenDirections);
      EXPECT_NEAR(u, light.u.value[0] / light.i.value[0], kBetweenDirections);
      EXPECT_GT(std::abs(u), 10 * kBetweenDirections);
    }
  }
}

TEST(PlotPolarisation, NamesTheNeutralPointsAndTheSense) {
  const PolarisedSky sky = polarised_sky(ReferenceModel({}), {}, kNode, 0, 70 * kDegree);
  const std::string seen = polarisation_figure("a sky", sky, PolarisationAngle::kClockwise).body,
                    iau = polarisation_figure("a sky", sky, PolarisationAngle::kIau).body;
  for (const char* name : {"Babinet", "Arago", "above the antisolar point"})
    EXPECT_THAT(seen, HasSubstr(name));
  EXPECT_THAT(seen, HasSubstr("deg, clockwise"));
  EXPECT_THAT(iau, HasSubstr("deg, counter-clockwise"));
}

TEST(PlotPolarisation, ColoursOfAnglesRepeatAfterHalfATurn) {
  for (const double deg : {-90.0, -30.0, 0.0, 71.0})
    EXPECT_EQ(half_turn_color(deg), half_turn_color(deg + 180));
  EXPECT_NE(half_turn_color(45), half_turn_color(-45));
  EXPECT_NE(half_turn_color(0), half_turn_color(90));
}

}  // namespace
}  // namespace skyfit::plot
