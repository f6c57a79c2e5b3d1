// SPDX-License-Identifier: Apache-2.0
// The parameter table is consistent with itself, with the atmosphere's defaults and with what an
// atmosphere has.
#include "model/atmosphere/parameters.h"

#include <gmock/gmock.h>

#include <limits>
#include <set>
#include <stdexcept>

namespace skyfit {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(ParameterTable, RowsStandInTheOrderOfTheEnumeration) {
  int row = 0;
  std::set<std::string_view> names;
  for (const ParameterInfo& info : parameter_table()) {
    EXPECT_EQ(static_cast<int>(info.id), row++);
    EXPECT_EQ(parameter_info(info.id).name, info.name);
    EXPECT_EQ(parameter_from_name(info.name), info.id);
    names.insert(info.name);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kParameterCount));
}

TEST(ParameterTable, DefaultsAndPriorsLieWithinTheBounds) {
  for (const ParameterInfo& info : parameter_table()) {
    EXPECT_LT(info.lower, info.default_value) << info.name;
    EXPECT_GT(info.upper, info.default_value) << info.name;
    if (!info.prior) continue;
    EXPECT_GT(info.prior->sigma, 0) << info.name;
    EXPECT_GT(info.prior->mean - info.prior->sigma, info.lower) << info.name;
    EXPECT_LT(info.prior->mean + info.prior->sigma, info.upper) << info.name;
  }
}

TEST(ParameterTable, EveryBoundIsPhysical) {
  for (const PhaseType type : {PhaseType::kCornetteShanks, PhaseType::kTwoLobe}) {
    for (const ParameterInfo& info : parameter_table()) {
      Atmosphere<double> atmosphere;
      atmosphere.mie.phase.type = type;
      if (!has_parameter(atmosphere, info.id)) continue;
      for (const double bound : {info.lower, info.upper}) {
        set_parameter(atmosphere, info.id, bound);
        EXPECT_NO_THROW(validate(atmosphere)) << info.name << " = " << bound;
      }
    }
  }
}

TEST(ParameterTable, DefaultsAreThoseOfTheAtmosphere) {
  const Atmosphere<double> atmosphere;
  for (const ParameterInfo& info : parameter_table()) {
    EXPECT_EQ(get_parameter(atmosphere, info.id), info.default_value) << info.name;
  }
}

TEST(ParameterTable, OnlyExponentAndOzoneAreFixed) {
  for (const ParameterInfo& info : parameter_table()) {
    const bool fixed = info.name == "mie.angstrom_exponent" || info.name == "ozone.column";
    EXPECT_EQ(info.free_by_default, !fixed) << info.name;
  }
}

TEST(Parameter, WrittenIsReadAndNothingElseChanges) {
  Atmosphere<double> atmosphere;
  for (const ParameterInfo& info : parameter_table()) {
    set_parameter(atmosphere, info.id, 100.0 + static_cast<int>(info.id));
  }
  for (const ParameterInfo& info : parameter_table()) {
    EXPECT_EQ(get_parameter(atmosphere, info.id), 100.0 + static_cast<int>(info.id)) << info.name;
  }
  EXPECT_EQ(atmosphere.mie.phase.g2, 100.0 + static_cast<int>(Parameter::kMiePhaseG2));
  EXPECT_EQ(atmosphere.ozone.column_du, 100.0 + static_cast<int>(Parameter::kOzoneColumn));
}

TEST(Parameter, LobesDecideWhichPhaseParametersThereAre) {
  Atmosphere<double> atmosphere;
  for (const PhaseType type :
       {PhaseType::kCornetteShanks, PhaseType::kHenyeyGreenstein, PhaseType::kTwoLobe}) {
    atmosphere.mie.phase.type = type;
    const bool two = type == PhaseType::kTwoLobe;
    EXPECT_EQ(has_parameter(atmosphere, Parameter::kMiePhaseG), !two);
    EXPECT_EQ(has_parameter(atmosphere, Parameter::kMiePhaseG1), two);
    EXPECT_EQ(has_parameter(atmosphere, Parameter::kMiePhaseG2), two);
    EXPECT_EQ(has_parameter(atmosphere, Parameter::kMiePhaseWeight), two);
    EXPECT_TRUE(has_parameter(atmosphere, Parameter::kOzoneColumn));
  }
}

TEST(Parameter, UnknownNameIsNamedWithTheKnownOnes) {
  EXPECT_THAT([] { parameter_from_name("mie.phase.gg"); },
              ThrowsMessage<std::invalid_argument>(testing::AllOf(
                  HasSubstr("mie.phase.gg: unknown parameter"), HasSubstr("mie.phase.g1"))));
}

TEST(Validate, NamesThePathTheValueAndTheExpectation) {
  const auto message_of = [](auto change) -> std::string {
    Atmosphere<double> atmosphere;
    change(atmosphere);
    try {
      validate(atmosphere);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message_of([](auto& a) { a.mie.scattering_per_m.value = -1e-5; }),
            "mie.scattering_per_m.value = -1e-05: expected a coefficient >= 0 1/m");
  EXPECT_EQ(message_of([](auto& a) { a.rayleigh.scale_height_m = 0; }),
            "rayleigh.scale_height_m = 0: expected a height > 0 m");
  EXPECT_EQ(message_of([](auto& a) { a.mie.phase.g = 1; }),
            "mie.phase.g = 1: expected an asymmetry between -1 and 1, both excluded");
  EXPECT_EQ(message_of([](auto& a) { a.ground_albedo = kNan; }),
            "ground.albedo = nan: expected an albedo from 0 to 1");
  EXPECT_EQ(message_of([](auto& a) { a.top_radius_m = a.bottom_radius_m; }),
            "planet.top_radius_m = 6360000: expected a radius > bottom_radius_m = 6360000");
  EXPECT_EQ(message_of([](auto& a) { a.mie.scattering_per_m.exponent = kInfinity; }),
            "mie.scattering_per_m.exponent = inf: expected a finite number");
  EXPECT_EQ(message_of([](auto& a) { a.mie.single_scattering_albedo = 0; }),
            "mie.single_scattering_albedo = 0: expected a ratio > 0 and <= 1");
  EXPECT_EQ(message_of([](auto& a) { a.rayleigh.depolarisation = -0.1; }),
            "rayleigh.depolarisation = -0.1: expected a ratio from 0 to 1");
  EXPECT_EQ(message_of([](auto& a) { a.rayleigh.site_pressure_hpa = 0; }),
            "rayleigh.site_pressure_hpa = 0: expected a pressure > 0 hPa");
  EXPECT_EQ(message_of([](auto& a) { a.mie.phase.type = PhaseType::kTabulated; }),
            "mie.phase.type = tabulated: expected a table");
  EXPECT_EQ(
      message_of([](auto& a) {
        a.ozone.profile = OzoneProfile::kExponential;
        a.rayleigh.profile = std::make_shared<const LinearProfile>(TwoColumns{{0, 3e4}, {1, 0}});
      }),
      "ozone.profile = exponential: expected tent or a table, the air has no scale height");
  EXPECT_EQ(message_of([](auto& a) { a.ozone.column_du = -1; }),
            "ozone.column_du = -1: expected a column >= 0 DU");
}

TEST(Validate, OnlyTheLobesInUseMatter) {
  Atmosphere<double> atmosphere;
  atmosphere.mie.phase.g1 = 5;
  EXPECT_NO_THROW(validate(atmosphere));
  atmosphere.mie.phase.type = PhaseType::kTwoLobe;
  EXPECT_THROW(validate(atmosphere), std::invalid_argument);
  atmosphere.mie.phase.g1 = 0.9;
  atmosphere.mie.phase.g = 5;
  EXPECT_NO_THROW(validate(atmosphere));
}

TEST(Validate, AcceptsAnythingPhysicalOutsideTheFitBounds) {
  Atmosphere<double> atmosphere;
  atmosphere.bottom_radius_m = 1e9;
  atmosphere.top_radius_m = 1.0001e9;
  atmosphere.mie.scattering_per_m.value = 0;
  atmosphere.mie.single_scattering_albedo = 1;
  atmosphere.rayleigh.scattering_per_m.value = 0;
  atmosphere.ozone.column_du = 0;
  EXPECT_NO_THROW(validate(atmosphere));
}

}  // namespace
}  // namespace skyfit
