// SPDX-License-Identifier: Apache-2.0
// The starts of a fit: as many as asked for, different, within the bounds, the forward lobe first.
#include "fit/problem/starts.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

std::vector<FreeParameter> all_free(int lobes) {
  FitOptions options;
  options.lobes = lobes;
  return choose_free_parameters(options, ToySky(), true_atmosphere(lobes));
}

FreeParameter free_parameter(Parameter id) {
  return {{parameter_info(id).lower, parameter_info(id).upper, false, std::nullopt}, id};
}

class StartsTest : public testing::TestWithParam<int> {};

TEST_P(StartsTest, AreDifferentAndWithinTheBounds) {
  const std::vector<FreeParameter> parameters = all_free(GetParam());
  const std::vector<Start> starts =
      choose_starts(true_atmosphere(GetParam()), parameters, 40, false);
  ASSERT_EQ(starts.size(), 40u);
  std::set<std::string> names;
  for (const Start& start : starts) {
    names.insert(start.name);
    validate(start.atmosphere);
    EXPECT_GT(start.atmosphere.at("mie").phase.g1, start.atmosphere.at("mie").phase.g2)
        << start.name;
    for (const FreeParameter& parameter : parameters) {
      EXPECT_GE(get_parameter(start.atmosphere, parameter.id), parameter.lower);
      EXPECT_LE(get_parameter(start.atmosphere, parameter.id), parameter.upper);
    }
  }
  EXPECT_EQ(names.size(), starts.size());
}

INSTANTIATE_TEST_SUITE_P(Lobes, StartsTest, testing::Values(1, 2));

TEST(StartsTest, OwnAtmosphereComesFirst) {
  const std::vector<Start> starts = choose_starts(true_atmosphere(2), all_free(2), 3, true);
  ASSERT_EQ(starts.size(), 3u);
  EXPECT_EQ(starts[0].atmosphere.at("mie").phase.g1, true_atmosphere(2).at("mie").phase.g1);
  EXPECT_EQ(starts[0].atmosphere.at("mie").amount, true_atmosphere(2).at("mie").amount);
}

TEST(StartsTest, FixedParametersKeepTheirValues) {
  for (const Start& start :
       choose_starts(true_atmosphere(2), {free_parameter(Parameter::kMiePhaseG2)}, 4, false)) {
    EXPECT_EQ(start.atmosphere.at("mie").phase.g1, true_atmosphere(2).at("mie").phase.g1);
    EXPECT_EQ(start.atmosphere.at("mie").amount, true_atmosphere(2).at("mie").amount);
  }
}

TEST(StartsTest, OneWhenNoPhaseParameterIsFree) {
  EXPECT_EQ(choose_starts(true_atmosphere(2), {free_parameter(Parameter::kGroundAlbedo)}, 4, false)
                .size(),
            1u);
}

}  // namespace
}  // namespace skyfit::fit
