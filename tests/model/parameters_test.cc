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

TEST(Parameter, NamesAreReadBack) {
  std::set<std::string> names;
  for (const Parameter& id : standard_parameters()) {
    EXPECT_EQ(parameter_info(id).name, id.name());
    EXPECT_EQ(parameter_from_name(id.name()), id);
    names.insert(id.name());
  }
  EXPECT_EQ(names.size(), standard_parameters().size());
  EXPECT_EQ(parameter_from_name("dust.base_m"), Parameter("dust", Quantity::kBase));
}

TEST(Parameter, DefaultsAndPriorsLieWithinTheBounds) {
  Atmosphere<double> power_law, pressure;
  pressure.at("rayleigh") = standard_air<double>();
  for (const Parameter& id : standard_parameters()) {
    const Atmosphere<double>& atmosphere =
        id == Parameter::kRayleighPressure ? pressure : power_law;
    const ParameterInfo info = parameter_info(id);
    EXPECT_LT(info.lower, get_parameter(atmosphere, id)) << info.name;
    EXPECT_GT(info.upper, get_parameter(atmosphere, id)) << info.name;
    if (!info.prior) continue;
    EXPECT_GT(info.prior->sigma, 0) << info.name;
    EXPECT_GT(info.prior->mean - info.prior->sigma, info.lower) << info.name;
    EXPECT_LT(info.prior->mean + info.prior->sigma, info.upper) << info.name;
  }
}

// Of the standard constituents, of a layer and of one that states its optical depth.
Atmosphere<double> with_dust() {
  Atmosphere<double> atmosphere;
  Constituent<double> dust = standard_mie<double>();
  dust.name = "dust";
  dust.amount_type = AmountType::kOpticalDepth;
  dust.amount = 0.2;
  dust.profile.type = ProfileType::kLayer;
  dust.profile.base_m = 3000;
  dust.profile.top_m = 4000;
  atmosphere.constituents.push_back(dust);
  return atmosphere;
}

TEST(Parameter, EveryBoundIsPhysical) {
  for (const PhaseType type : {PhaseType::kCornetteShanks, PhaseType::kTwoLobe}) {
    Atmosphere<double> atmosphere = with_dust();
    atmosphere.at("mie").phase.type = type;
    for (const Parameter& id : parameters_of(atmosphere)) {
      const bool edge = id.quantity() == Quantity::kBase || id.quantity() == Quantity::kTop;
      if (edge) continue;  // they bound each other
      const ParameterInfo info = parameter_info(id);
      for (const double bound : {info.lower, info.upper}) {
        Atmosphere<double> changed = atmosphere;
        set_parameter(changed, id, bound);
        EXPECT_NO_THROW(validate(changed)) << info.name << " = " << bound;
      }
    }
  }
}

TEST(Parameter, OnlyExponentAndOzoneOfTheStandardOnesAreFixed) {
  for (const Parameter& id : standard_parameters()) {
    const bool fixed = id == Parameter::kMieAngstromExponent || id == Parameter::kOzoneColumn;
    EXPECT_EQ(parameter_info(id).free_by_default, !fixed) << id.name();
  }
  EXPECT_FALSE(parameter_info({"dust", Quantity::kOpticalDepth}).free_by_default);
}

TEST(Parameter, AnAtmosphereListsWhatItHas) {
  std::vector<std::string> names;
  for (const Parameter& id : parameters_of(with_dust())) {
    EXPECT_TRUE(has_parameter(with_dust(), id)) << id.name();
    if (id.constituent() == "dust") names.push_back(id.name());
  }
  EXPECT_THAT(names, testing::ElementsAre("dust.optical_depth", "dust.angstrom_exponent",
                                          "dust.single_scattering_albedo", "dust.base_m",
                                          "dust.top_m", "dust.phase.g"));
  EXPECT_THAT(
      [] {
        require_parameter(with_dust(), {"dust", Quantity::kScaleHeight});
      },
      ThrowsMessage<std::invalid_argument>(
          HasSubstr("dust.scale_height: the atmosphere has no such parameter")));
}

TEST(Parameter, WrittenIsReadAndNothingElseChanges) {
  Atmosphere<double> atmosphere;
  // The pressure of air is its amount, as its scattering is.
  std::vector<Parameter> ids(standard_parameters().begin(), standard_parameters().end());
  std::erase(ids, Parameter::kRayleighPressure);
  double value = 100;
  for (const Parameter& id : ids) set_parameter(atmosphere, id, value++);
  value = 100;
  for (const Parameter& id : ids) EXPECT_EQ(get_parameter(atmosphere, id), value++) << id.name();
  EXPECT_EQ(atmosphere.at("mie").phase.g2, 108);
  EXPECT_EQ(atmosphere.at("ozone").amount, 110);
}

TEST(Parameter, LobesDecideWhichPhaseParametersThereAre) {
  Atmosphere<double> atmosphere;
  for (const PhaseType type :
       {PhaseType::kCornetteShanks, PhaseType::kHenyeyGreenstein, PhaseType::kTwoLobe}) {
    atmosphere.at("mie").phase.type = type;
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
  EXPECT_EQ(message_of([](auto& a) { a.at("mie").amount = -1e-5; }),
            "mie.scattering_per_m.value = -1e-05: expected a coefficient from 0 to 10 1/m");
  EXPECT_EQ(message_of([](auto& a) { a.at("rayleigh").profile.scale_height_m = 0; }),
            "rayleigh.profile.scale_height_m = 0: expected a height from 1 to 10000000 m");
  EXPECT_EQ(message_of([](auto& a) { a.at("mie").phase.g = 1; }),
            "mie.phase.g = 1: expected an asymmetry from -0.8 to 0.999");
  EXPECT_EQ(message_of([](auto& a) { a.ground_albedo = kNan; }),
            "ground.albedo = nan: expected an albedo from 0 to 1");
  EXPECT_EQ(
      message_of([](auto& a) { a.top_radius_m = a.bottom_radius_m; }),
      "planet.top_radius_m = 6360000: expected a radius from bottom_radius_m + 100 = 6360100 m "
      "to 1.3 times the bottom radius");
  EXPECT_EQ(message_of([](auto& a) { a.at("mie").angstrom_exponent = kInfinity; }),
            "mie.scattering_per_m.exponent = inf: expected an exponent from -20 to 20");
  EXPECT_EQ(message_of([](auto& a) { a.at("mie").single_scattering_albedo = 0; }),
            "mie.single_scattering_albedo = 0: expected a ratio > 0 and <= 1");
  EXPECT_EQ(message_of([](auto& a) { a.at("rayleigh").phase.depolarisation = -0.1; }),
            "rayleigh.phase.depolarisation = -0.1: expected a ratio from 0 to 1");
  EXPECT_EQ(message_of([](auto& a) { a.at("rayleigh").site_pressure_hpa = 0; }),
            "rayleigh.site_pressure_hpa = 0: expected a pressure > 0 and <= 1000000 hPa");
  EXPECT_EQ(message_of([](auto& a) { a.at("mie").phase.type = PhaseType::kTabulated; }),
            "mie.phase.type = tabulated: expected a table");
  EXPECT_EQ(message_of([](auto& a) {
              a.at("ozone").profile.type = ProfileType::kSameAs;
              a.at("ozone").profile.of = "smoke";
            }),
            "ozone.profile.of = smoke: expected the name of a constituent with a profile of its "
            "own");
  EXPECT_EQ(message_of([](auto& a) { a.at("ozone").name = "mie"; }),
            "constituents.name = \"mie\": expected a name that no other constituent has");
  EXPECT_EQ(message_of([](auto& a) { a.constituents.resize(9); }),
            "constituents = 9 of them: expected at most 8");
  EXPECT_EQ(message_of([](auto& a) { a.at("ozone").amount = -1; }),
            "ozone.column_du = -1: expected a column from 0 to 100000 DU");
}

TEST(Validate, OnlyTheLobesInUseMatter) {
  Atmosphere<double> atmosphere;
  atmosphere.at("mie").phase.g1 = 5;
  EXPECT_NO_THROW(validate(atmosphere));
  atmosphere.at("mie").phase.type = PhaseType::kTwoLobe;
  EXPECT_THROW(validate(atmosphere), std::invalid_argument);
  atmosphere.at("mie").phase.g1 = 0.9;
  atmosphere.at("mie").phase.g = 5;
  EXPECT_NO_THROW(validate(atmosphere));
}

TEST(Validate, AcceptsAnythingPhysicalOutsideTheFitBounds) {
  Atmosphere<double> atmosphere;
  atmosphere.bottom_radius_m = 1e9;
  atmosphere.top_radius_m = 1.0001e9;
  atmosphere.at("mie").amount = 0;
  atmosphere.at("mie").single_scattering_albedo = 1;
  atmosphere.at("rayleigh").amount = 0;
  atmosphere.at("ozone").amount = 0;
  EXPECT_NO_THROW(validate(atmosphere));
}

}  // namespace
}  // namespace skyfit
