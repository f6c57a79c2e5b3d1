// SPDX-License-Identifier: Apache-2.0
// Tables that `bodare` renews over frames: of an atmosphere that stays they are at every frame
// those that are made at once; of one that changes they lie between the two last whole sets, whose
// atmospheres are those of the frames in which their updates began.
#include "render/sequence/table_updates.h"

#include <gtest/gtest.h>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/tables/table_blend.h"

namespace skyfit {
namespace {

constexpr TableSizes kTiny = {16, 16, 8, 4, 4, 4, 8, 8, 4, 8, 8, 4};
constexpr BodareUpdateOptions kShort = {.orders = 2, .slices = 2};
constexpr int kFrames = 4;  // of an update: 2 + 2 / 2 + 1
constexpr double kPerSecond = 10;

Preset preset(double aerosol) {
  Preset preset = parse_preset(refs::shipped_preset_json("bodare-2014"), "bodare-2014");
  preset.atmosphere.at("mie").amount = aerosol;
  return preset;
}

ColorRule color() { return color_rule(refs::standard_spectral_data()); }

TableUpdates updates_of(std::vector<TimelineStep> steps) {
  return {std::move(steps), kPerSecond, color(), [](const Preset& p) { return p.atmosphere; },
          kShort,           kTiny,      2};
}

AtmosphereTables at_once(const Preset& p) {
  const ColorRule rule = color();
  const BodareUpdate filled(p.atmosphere, {rule.nodes.begin(), rule.nodes.end()}, kShort);
  return compute_tables_of(*filled.newer().model(2), p.atmosphere, rule, kTiny, 2, {});
}

void expect_same(const AtmosphereTables& tables, const AtmosphereTables& expected) {
  EXPECT_EQ(tables.atmosphere, expected.atmosphere);
  EXPECT_EQ(tables.sky_rays.air.rgba, expected.sky_rays.air.rgba);
  EXPECT_EQ(tables.sky_rays.aerosol.rgba, expected.sky_rays.aerosol.rgba);
  EXPECT_EQ(tables.sky_rays.gathered.rgba, expected.sky_rays.gathered.rgba);
  EXPECT_EQ(tables.rayleigh_like.rgba, expected.rayleigh_like.rgba);
  EXPECT_EQ(tables.irradiance.rgba, expected.irradiance.rgba);
  EXPECT_EQ(tables.optical_depth.rgba, expected.optical_depth.rgba);
}

// The aerosol grows by 1e-5 per frame. In the third update the set of frame 0 gives way to that of
// frame 4, over the first order and its gathering: 0, 1/2, then 1 until the end.
TEST(TableUpdates, LieBetweenTheTwoLastWholeSets) {
  const auto of_frame = [](int frame) { return preset(1e-5 * (1 + frame)); };
  constexpr int kLast = 20;
  TableUpdates updates = updates_of({{0, of_frame(0)}, {kLast / kPerSecond, of_frame(kLast)}});
  const AtmosphereTables older = at_once(of_frame(0)),
                         newer = at_once(
                             preset_at({{0, of_frame(0)}, {kLast / kPerSecond, of_frame(kLast)}},
                                       kFrames / kPerSecond));
  EXPECT_NEAR(newer.atmosphere.at("mie").amount, 5e-5, 1e-12);
  ASSERT_EQ(updates.frames_of_update(), kFrames);
  for (const int frame : {2, 5}) {  // of the first two updates, for which there is frame 0 alone
    SCOPED_TRACE(frame);
    expect_same(*updates.at(frame).tables, older);
  }
  for (const auto& [frame, blend] : {std::pair{8, 0.0}, {9, 0.5}, {11, 1.0}}) {
    SCOPED_TRACE(frame);  // frame 10 is left out and done all the same
    const TableUpdates::Now now = updates.at(frame);
    EXPECT_EQ(now.blend, blend);
    expect_same(*now.tables, blend > 0 && blend < 1 ? interpolated_tables(older, newer, blend)
                             : blend > 0            ? newer
                                                    : older);
    EXPECT_NEAR(now.preset.atmosphere.at("mie").amount, 1e-5 + blend * 4e-5, 1e-12);
  }
}

}  // namespace
}  // namespace skyfit
