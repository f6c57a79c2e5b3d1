// SPDX-License-Identifier: Apache-2.0
// What a CIE standard sky is fitted with by default: one kind of sky for each type, within bounds
// of particles that exist, and nothing where the caller has chosen a start.
#include "fit/standard_sky.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "data_refs/cie_sky.h"
#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "fit/fit.h"
#include "model/registry.h"

namespace skyfit::fit {
namespace {

std::unique_ptr<SkyModel> model_named(std::string_view name,
                                      Transfer transfer = Transfer::kScalar) {
  return make_sky_model(name, refs::standard_spectral_data(), 2, transfer);
}

TEST(StandardSkyTest, EveryTypeHasExactlyOneKind) {
  for (const refs::CieSky& sky : refs::cie_skies()) {
    int kinds = 0;
    for (const StandardSkyKind& kind : standard_sky_kinds())
      kinds += static_cast<int>(std::ranges::count(kind.types, sky.type));
    EXPECT_EQ(kinds, 1) << sky.type;
    EXPECT_EQ(standard_sky_type("cie:" + std::to_string(sky.type)), sky.type);
  }
  EXPECT_EQ(standard_sky_type("cie:traditional-overcast"), std::nullopt);
  EXPECT_EQ(standard_sky_type("cie:16"), std::nullopt);
}

TEST(StandardSkyTest, ModelsWithoutCloudsFitClearAir) {
  EXPECT_EQ(standard_sky_kind(1, *model_named("reference")).name, "cloud over haze");
  EXPECT_EQ(standard_sky_kind(1, *model_named("nielsen")).name, "clear");
}

TEST(StandardSkyTest, WhatTheCallerSaysStays) {
  const auto model = model_named("reference");
  const StandardSkyKind& kind = standard_sky_kind(12, *model);
  FitOptions options;
  options.fix[Parameter::kGroundAlbedo] = 0.9;  // outside the kind's bounds
  options.bounds[Parameter::kMieScaleHeight] = {100, 200};
  const FitOptions filled = with_standard_sky(options, kind, *model);
  EXPECT_THAT(*filled.free, testing::Contains(Parameter::kMiePhaseG2));
  EXPECT_THAT(*filled.free, testing::Not(testing::Contains(Parameter::kMiePhaseG)));
  EXPECT_THAT(*filled.free, testing::Not(testing::Contains(Parameter::kGroundAlbedo)));
  EXPECT_THAT(*filled.free, testing::Not(testing::Contains(Parameter::kRayleighScattering)));
  EXPECT_EQ(filled.bounds.at(Parameter::kMieScaleHeight).upper, 200);
  EXPECT_EQ(filled.bounds.at(Parameter::kMieSingleScatteringAlbedo).lower, 0.82);
  options.start = parse_preset(refs::shipped_preset_json("earth-hazy"), "earth-hazy");
  EXPECT_FALSE(with_standard_sky(options, kind, *model).free);
}

// Under a cloud of any optical depth over bright ground type 3 is a few percent off.
TEST(StandardSkyTest, AnOvercastSkyIsACloud) {
  const auto model = model_named("reference");
  const refs::Reference reference =
      refs::load_reference("cie:3", {std::numbers::pi / 6}, refs::Sampling::kPrincipalPlane);
  FitOptions options;
  options.starts = 1;
  options.max_iterations = 3;
  const Result result =
      fit_atmosphere(reference, refs::standard_spectral_data(), *model,
                     with_standard_sky(options, standard_sky_kind(3, *model), *model));
  EXPECT_LT(result.errors.rms_log, 3);
  EXPECT_GT(result.unknown("cloud.optical_depth").fitted, 8);
  EXPECT_GT(result.unknown("ground.albedo").fitted, 0.4);
}

}  // namespace
}  // namespace skyfit::fit
