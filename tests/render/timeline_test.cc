// SPDX-License-Identifier: Apache-2.0
// Timeline over a sequence: tables are computed once per step, shared where nothing changes, and
// interpolated in between.
#include "render/sequence/timeline.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>

#include "data_refs/references.h"
#include "data_refs/spectra.h"

namespace skyfit {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr TableSizes kTiny = {16, 16, 8, 4, 4, 4, 8, 8, 4, 8, 8, 4};

Preset preset(double aerosol) {
  Preset preset = parse_preset(refs::shipped_preset_json("earth-clear"), "earth-clear");
  preset.name = "timeline";
  preset.atmosphere.at("mie").amount = aerosol;
  return preset;
}

TEST(Timeline, StepsAreAtMostAQuarter) {
  const std::vector<TimelineStep> steps =
      refined({{0, preset(1e-5)}, {8, preset(4e-5)}, {9, preset(4e-5)}});
  ASSERT_EQ(steps.size(),
            9u);  // ln 4 / ln 1.25 = 6.2, so 7 steps, and the one that changes nothing
  for (std::size_t i = 1; i + 1 < steps.size(); ++i) {
    EXPECT_GT(steps[i].time_s, steps[i - 1].time_s);
    const double ratio = steps[i].preset.atmosphere.at("mie").amount /
                         steps[i - 1].preset.atmosphere.at("mie").amount;
    EXPECT_NEAR(ratio, std::pow(4, 1.0 / 7), 1e-9);
  }
  // The coefficient goes linearly with time, however the steps lie.
  EXPECT_NEAR(steps[3].preset.atmosphere.at("mie").amount, 1e-5 + 3e-5 * steps[3].time_s / 8,
              1e-12);
}

// Tables hold logarithms, in which a cloud that comes up from nothing is not half there half-way.
TEST(Timeline, AnAmountGrowsFromNothingInThinSteps) {
  const auto with_cloud = [](double optical_depth) {
    Preset cloudy = parse_preset(refs::shipped_preset_json("overcast"), "overcast");
    cloudy.atmosphere.at("cloud").amount_type = AmountType::kOpticalDepth;
    cloudy.atmosphere.at("cloud").amount = optical_depth;
    return cloudy;
  };
  for (const bool comes : {true, false}) {
    std::vector<TimelineStep> steps =
        refined({{0, with_cloud(comes ? 0 : 5)}, {8, with_cloud(comes ? 5 : 0)}});
    if (!comes) std::ranges::reverse(steps);
    const auto depth = [&](std::size_t i) { return steps[i].preset.atmosphere.at("cloud").amount; };
    EXPECT_EQ(depth(0), 0);
    EXPECT_LT(depth(1), 0.05);
    for (std::size_t i = 2; i < steps.size(); ++i) EXPECT_LT(depth(i) / depth(i - 1), 2.6);
  }
}

TEST(Timeline, ConstituentsHaveTheOrderOfTheFirst) {
  Preset other = preset(2e-5);
  std::ranges::reverse(other.atmosphere.constituents);
  const std::vector<TimelineStep> steps = refined({{0, preset(1e-5)}, {1, other}});
  const auto& last = steps.back().preset.atmosphere.constituents;
  for (std::size_t i = 0; i < last.size(); ++i)
    EXPECT_EQ(last[i].name, steps[0].preset.atmosphere.constituents[i].name);
  EXPECT_EQ(steps.back().preset.atmosphere.at("mie").amount, 2e-5);
}

TEST(Timeline, MomentsLieBetweenSteps) {
  const std::vector<TimelineStep> steps = {{1, preset(1e-5)}, {3, preset(2e-5)}};
  EXPECT_EQ(moment_at(steps, 0).after, 0u);
  EXPECT_EQ(moment_at(steps, 1).after, 0u);
  EXPECT_EQ(moment_at(steps, 2).after, 1u);
  EXPECT_DOUBLE_EQ(moment_at(steps, 1.5).share, 0.25);
  EXPECT_EQ(moment_at(steps, 3).before, 1u);
  EXPECT_EQ(moment_at(steps, 30).before, 1u);
}

TEST(Timeline, TablesAreMadeOncePerStep) {
  std::atomic<int> calls = 0, running = 0;
  const std::vector<TimelineStep> steps = {
      {0, preset(1e-5)}, {1, preset(1.2e-5)}, {2, preset(1.2e-5)}, {3, preset(1e-5)}};
  Timeline timeline(
      steps,
      [&](std::size_t step) {
        EXPECT_EQ(++running, 1);
        ++calls;
        const AtmosphereTables tables =
            compute_tables(steps[step].preset.atmosphere,
                           color_rule(refs::standard_spectral_data()), kTiny, 1, {});
        --running;
        return tables;
      },
      0);
  const Timeline::Now start = timeline.at(0), again = timeline.at(0), half = timeline.at(0.5);
  EXPECT_EQ(start.tables, again.tables);
  EXPECT_NE(start.tables, half.tables);
  EXPECT_NEAR(half.preset.atmosphere.at("mie").amount, 1.1e-5, 1e-15);
  const std::size_t texel = half.tables->optical_depth.rgba.size() / 2;
  EXPECT_GT(half.tables->optical_depth.rgba[texel], start.tables->optical_depth.rgba[texel]);
  EXPECT_EQ(timeline.at(1.2).tables, timeline.at(1.9).tables);  // nothing changes
  EXPECT_EQ(timeline.at(3).preset.name, "timeline");
  EXPECT_EQ(calls, 3);  // of four steps two are the same
}

TEST(Timeline, ErrorsOfTheTablesArrive) {
  Timeline timeline(
      {{0, preset(1e-5)}},
      [](std::size_t) -> AtmosphereTables { throw std::runtime_error("no tables"); }, 0);
  EXPECT_THAT([&] { timeline.at(0); }, ThrowsMessage<std::runtime_error>("no tables"));
}

TEST(Timeline, BetweenTwoPlanetsThereIsNone) {
  Preset mars = parse_preset(refs::shipped_preset_json("mars"), "mars");
  EXPECT_THAT(
      [&] {
        refined({{0, preset(1e-5)}, {2, mars}});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("presets timeline and mars at 0 s")));
}

}  // namespace
}  // namespace skyfit
