// SPDX-License-Identifier: Apache-2.0
// What the options of `skyfit render` ask for: the sun of a day, the frames of a day, headings.
#include "cli/render_request.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cli/arguments.h"
#include "cli/render_arguments.h"
#include "model/atmosphere/preset.h"

namespace skyfit::cli {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

RenderRequest request(std::vector<std::string> arguments) {
  CLI::App app;
  RenderOptions options;
  add_render_options(app, options);
  arguments.insert(arguments.end(), {"--preset", "earth-clear"});
  std::ranges::reverse(arguments);  // as CLI11 wants them
  app.parse(arguments);
  return render_request(options, app);
}

std::vector<std::string> at_zurich(std::vector<std::string> more) {
  more.insert(more.end(), {"--latitude-deg", "47.4", "--longitude-deg", "8.5"});
  return more;
}

// At the solstice the sun culminates at 90 - latitude + 23.44 degrees, in the south.
TEST(RenderRequest, TheSunOfADay) {
  const RenderRequest r = request(at_zurich(
      {"--date", "2026-06-21", "--time", "13:28", "--utc-offset-h", "2", "--out", "x.png"}));
  const Shot shot = shot_at(r.sequence, 0, sun_over);
  EXPECT_NEAR(shot.sun.zenith / kDegree, 47.4 - 23.44, 0.02);
  EXPECT_NEAR(shot.sun.azimuth / kDegree, 180, 1);
  EXPECT_TRUE(shot.camera.above_ground);
  EXPECT_FALSE(r.is_sequence);
}

TEST(RenderRequest, ADayIsAFilmOfTenSecondsFromAStandingCamera) {
  const RenderRequest r = request(at_zurich(
      {"--date", "2026-06-21", "--time", "05:00..21:00", "--view", "ground", "--out-dir", "x"}));
  EXPECT_TRUE(r.is_sequence);
  EXPECT_EQ(r.sequence.frames, 240);
  ASSERT_EQ(r.sequence.keyframes.size(), 2u);
  EXPECT_EQ(*r.sequence.keyframes[1].sun.time - *r.sequence.keyframes[0].sun.time,
            std::chrono::hours(16));
  EXPECT_NEAR(r.sequence.keyframes[1].time_s, r.sequence.time_s(239), 1e-12);
  const Shot first = shot_at(r.sequence, 0, sun_over), last = shot_at(r.sequence, 9, sun_over);
  EXPECT_TRUE(first.camera.from_north);
  EXPECT_EQ(first.camera.azimuth, last.camera.azimuth);
  EXPECT_NEAR(first.camera.azimuth, first.sun.azimuth, 1e-12);  // toward the sun at first
}

TEST(RenderRequest, PolarisationIsThatOfTheReferenceInAnExr) {
  EXPECT_EQ(request({"--stokes", "--out", "x.exr"}).stokes, PolarisationAngle::kClockwise);
  EXPECT_EQ(request({"--stokes", "--iau", "--out", "x.exr"}).stokes, PolarisationAngle::kIau);
  EXPECT_FALSE(request({"--out", "x.exr"}).stokes);
  EXPECT_THROW(request({"--stokes", "--out", "x.png"}), UsageError);
  for (const auto& [option, value] : {std::pair("--model", "bruneton"),
                                      {"--clouds", "0.4"},
                                      {"--orders", "2"},
                                      {"--strip", "mie.scattering=1e-6..8e-6"}})
    EXPECT_THROW(request({"--stokes", option, value, "--out", "x.exr"}), UsageError) << option;
}

TEST(RenderRequest, TablesByTheirNames) {
  const RenderRequest r =
      request({"--out", "x.png", "--table-size", "small", "--table-precision", "8bit"});
  EXPECT_EQ(r.table_precision, TablePrecision::k8Bit);
  EXPECT_LT(r.table_sizes.scattering_mu_s, TableSizes{}.scattering_mu_s);
  EXPECT_EQ(request({"--out", "x.png"}).table_sizes.scattering_mu_s, TableSizes{}.scattering_mu_s);
  EXPECT_THROW(request({"--out", "x.png", "--table-size", "huge"}), UsageError);
}

TEST(RenderRequest, StepsAndFramesOfADay) {
  const RenderRequest steps = request(at_zurich(
      {"--date", "2026-06-21", "--time", "22:00..01:10", "--step-min", "30", "--out-dir", "x"}));
  EXPECT_EQ(steps.sequence.frames, 7);  // past midnight: 22:00, 22:30 .. 01:00
  EXPECT_EQ(*steps.sequence.keyframes[1].sun.time - *steps.sequence.keyframes[0].sun.time,
            std::chrono::hours(3));
  const RenderRequest frames = request(at_zurich(
      {"--date", "2026-06-21", "--time", "10:00..14:00", "--frames", "5", "--out-dir", "x"}));
  EXPECT_EQ(frames.sequence.frames, 5);
  const RenderRequest one = request(at_zurich(
      {"--date", "2026-06-21", "--time", "10:00..14:00", "--frames", "1", "--out-dir", "x"}));
  EXPECT_EQ(one.sequence.keyframes.size(), 1u);
}

TEST(RenderRequest, SceneOptions) {
  const RenderRequest r =
      request({"--moon", "60,-20", "--second-sun", "70,90,0.5", "--clouds", "0.3,2500", "--shadows",
               "--aerial", "pixel", "--gpu", "--layers", "--out", "x.exr", "--tone", "exponential",
               "--exposure", "1e-4"});
  EXPECT_NEAR(r.frame.moon->azimuth, -20 * kDegree, 1e-12);
  EXPECT_EQ(r.frame.second_sun->irradiance, 0.5);
  EXPECT_EQ(r.frame.clouds->altitude_m, 2500);
  EXPECT_EQ(r.frame.clouds->opacity, CloudLayer{}.opacity);
  EXPECT_TRUE(r.frame.shadows && r.frame.layers);
  EXPECT_EQ(r.frame.aerial, AerialPerspective::kPerPixel);
  EXPECT_EQ(r.device, GraphicsDevice::kGpu);
  EXPECT_EQ(r.tone.curve, ToneCurve::kExponential);
  EXPECT_EQ(r.tone.exposure, 1e-4);
}

TEST(RenderRequest, WithoutAtmosphereNothingScatters) {
  EXPECT_FALSE(
      request({"--out", "x.png"}).sequence.keyframes[0].preset.atmosphere.constituents.empty());
  EXPECT_TRUE(request({"--atmosphere", "off", "--out", "x.png"})
                  .sequence.keyframes[0]
                  .preset.atmosphere.constituents.empty());
  EXPECT_EQ(request({"--tone", "clip", "--out", "x.png"}).tone.curve, ToneCurve::kClip);
}

TEST(RenderRequest, ModelsThatDoNotDrawAreRefused) {
  EXPECT_EQ(request({"--model", "nielsen:sun-through-sky", "--out", "x.png"}).model,
            "nielsen:sun-through-sky");
  EXPECT_THROW(request({"--model", "preetham", "--out", "x.png"}), UsageError);
}

TEST(RenderRequest, StripsAreEvenlySpaced) {
  const RenderRequest r = request({"--strip", "ozone.column=100..400:4", "--out", "x.png"});
  EXPECT_EQ(r.strip->parameter, Parameter::kOzoneColumn);
  EXPECT_THAT(r.strip->values, ::testing::ElementsAre(100, 200, 300, 400));
}

}  // namespace
}  // namespace skyfit::cli
