// SPDX-License-Identifier: Apache-2.0
// Tables from a cache are those that were computed, bit by bit, and only for the same inputs.
#include "model/tables/table_cache.h"

#include <gtest/gtest.h>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/parameters.h"
#include "model/atmosphere/preset.h"
#include "model/base/temporary_directory.h"
#include "model/registry.h"

namespace skyfit {
namespace {

constexpr TableSizes kTiny{.optical_depth_mu = 8,
                           .optical_depth_r = 4,
                           .irradiance_mu_s = 4,
                           .irradiance_r = 2,
                           .scattering_r = 2,
                           .scattering_ground = 2,
                           .scattering_sky = 3,
                           .scattering_mu_s = 4,
                           .scattering_azimuth = 2,
                           .outside_sky = 2,
                           .outside_mu_s = 4,
                           .outside_azimuth = 2};

const ColorRule& color() {
  static const ColorRule rule = color_rule(refs::standard_spectral_data());
  return rule;
}

Atmosphere<double> earth() {
  return parse_preset(refs::shipped_preset_json("earth-clear"), "earth-clear").atmosphere;
}

void expect_same(const Table& a, const Table& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.rgba, b.rgba);
}

class TableCacheOf : public ::testing::TestWithParam<const char*> {
 protected:
  const TemporaryDirectory folder_;
};

// Of a model of each way in which a renderer reads tables.
TEST_P(TableCacheOf, AModelGivesBackItsTables) {
  const auto model = make_sky_model(GetParam(), refs::standard_spectral_data(), 1);
  const Atmosphere<double> atmosphere = earth();
  int computed = 0;
  const auto tables = [&] {
    ContentCache cache(folder_.path());
    return cached_tables(cache, {GetParam(), {}, atmosphere, color(), kTiny}, [&] {
      ++computed;
      return compute_tables_of(*model, atmosphere, color(), kTiny, 1, {});
    });
  };
  const AtmosphereTables first = tables(), second = tables();
  EXPECT_EQ(computed, 1);
  EXPECT_EQ(second.atmosphere, first.atmosphere);
  EXPECT_EQ(second.phases.of_constituent, first.phases.of_constituent);
  EXPECT_EQ(second.phases.others, first.phases.others);
  EXPECT_EQ(second.phases.depolarisation, first.phases.depolarisation);
  EXPECT_EQ(second.color.nodes, first.color.nodes);
  EXPECT_EQ(second.color.xyz_from_nodes, first.color.xyz_from_nodes);
  EXPECT_EQ(second.sizes.scattering_r, first.sizes.scattering_r);
  expect_same(second.optical_depth, first.optical_depth);
  expect_same(second.irradiance, first.irradiance);
  expect_same(second.rayleigh_like, first.rayleigh_like);
  expect_same(second.single, first.single);
  expect_same(second.phase, first.phase);
  expect_same(second.sky_rays.air, first.sky_rays.air);
  expect_same(second.sky_rays.aerosol, first.sky_rays.aerosol);
  expect_same(second.sky_rays.gathered, first.sky_rays.gathered);
  EXPECT_EQ(second.sky_rays.oneil.samples, first.sky_rays.oneil.samples);
  EXPECT_EQ(second.sky_rays.oneil.phase, first.sky_rays.oneil.phase);
  EXPECT_EQ(second.sky_rays.mapping, first.sky_rays.mapping);
  EXPECT_EQ(second.sky_rays.nielsen.sun, first.sky_rays.nielsen.sun);
  ASSERT_EQ(second.sky_rays.limits.has_value(), first.sky_rays.limits.has_value());
  if (first.sky_rays.limits) {
    EXPECT_EQ(second.sky_rays.limits->model, first.sky_rays.limits->model);
    EXPECT_EQ(second.sky_rays.limits->highest_m, first.sky_rays.limits->highest_m);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, TableCacheOf,
                         ::testing::Values("reference", "oneil:samples=3:isotropic-air", "hillaire",
                                           "bodare", "nielsen:sun-through-sky"));

TEST(TableCache, GivesBackWhatBrunetonLooksUp) {
  const TemporaryDirectory folder;
  ContentCache cache(folder.path());
  const TableInputs inputs{"bruneton:half-inscatter", {}, earth(), color(), kTiny};
  cached_tables(cache, inputs, [] {
    AtmosphereTables tables;
    tables.sky_rays.mapping = SkyRayMapping::kBruneton;
    tables.sky_rays.bruneton.in_scatter = BrunetonInScatter::kInHalfFloats;
    return tables;
  });
  const SkyRayTables found =
      cached_tables(cache, inputs, [] { return AtmosphereTables{}; }).sky_rays;
  EXPECT_EQ(found.mapping, SkyRayMapping::kBruneton);
  EXPECT_EQ(found.bruneton.in_scatter, BrunetonInScatter::kInHalfFloats);
  EXPECT_EQ(found.bruneton.transmittance, BrunetonTransmittance::kOfOpticalDepths);
}

// Every parameter of the atmosphere by its least step, and all that stands beside it.
TEST(TableCache, AnyOtherInputIsComputed) {
  const TemporaryDirectory folder;
  ContentCache cache(folder.path());
  int computed = 0;
  const auto ask = [&](const TableInputs& inputs) {
    const int before = computed;
    cached_tables(cache, inputs, [&] {
      ++computed;
      return AtmosphereTables{};
    });
    return computed > before;
  };
  const Atmosphere<double> atmosphere = earth();
  const TableInputs inputs{"reference", {}, atmosphere, color(), kTiny};
  EXPECT_TRUE(ask(inputs));
  EXPECT_FALSE(ask(inputs));
  for (const Parameter& parameter : parameters_of(atmosphere)) {
    Atmosphere<double> other = atmosphere;
    const double value = get_parameter(atmosphere, parameter);
    set_parameter(other, parameter, std::nextafter(value, 2 * value + 1));
    EXPECT_TRUE(ask({"reference", {}, other, color(), kTiny})) << parameter_info(parameter).name;
  }
  Atmosphere<double> dry = atmosphere;
  dry.sea = false;
  EXPECT_TRUE(ask({"reference", {}, dry, color(), kTiny}));
  EXPECT_TRUE(ask({"oneil", {}, atmosphere, color(), kTiny}));
  EXPECT_TRUE(ask({"reference", {Transfer::kScalar, 0}, atmosphere, color(), kTiny}));
  EXPECT_TRUE(ask({"reference", {Transfer::kVector, 1}, atmosphere, color(), kTiny}));
  ColorRule red = color();
  red.nodes[3].wavelength_nm += 1;
  EXPECT_TRUE(ask({"reference", {}, atmosphere, red, kTiny}));
  TableSizes larger = kTiny;
  ++larger.outside_azimuth;
  EXPECT_TRUE(ask({"reference", {}, atmosphere, color(), larger}));
}

}  // namespace
}  // namespace skyfit
