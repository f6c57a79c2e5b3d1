// SPDX-License-Identifier: Apache-2.0
// Lists, sizes and parameters of the command line mean what the help says, and what cannot be meant
// is refused with the option, the text and the expectation.
#include "cli/arguments.h"

#include <gmock/gmock.h>

#include <functional>
#include <numbers>

namespace skyfit::cli {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

std::string refusal(const std::function<void()>& parse) {
  try {
    parse();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "was accepted";
}

std::string list_refusal(const std::string& text) {
  return refusal([&] { parse_list("--angle", text); });
}

TEST(List, KeepsValuesInOrder) {
  EXPECT_THAT(parse_list("--angle", "3,1.5,-2e1,+4, 1.5"), ElementsAre(3, 1.5, -20, 4, 1.5));
  EXPECT_THAT(parse_list("--angle", "7"), ElementsAre(7));
}

TEST(List, IncludesTheStopOfARange) {
  EXPECT_THAT(parse_list("--angle", "0:80:20"), ElementsAre(0, 20, 40, 60, 80));
  EXPECT_THAT(parse_list("--angle", "10:-10:-10"), ElementsAre(10, 0, -10));
  EXPECT_THAT(parse_list("--angle", "5:5:1"), ElementsAre(5));
  EXPECT_THAT(parse_list("--angle", "0:9:4"), ElementsAre(0, 4, 8));
}

// 0.1 is not exact in binary: the sum of steps falls short of or passes the stop by rounding only.
TEST(List, IncludesTheStopOfAStepThatIsNotExact) {
  for (const int count : {3, 7, 10, 33, 1000, 99999}) {
    const std::string stop = std::to_string(count / 10) + "." + std::to_string(count % 10);
    const std::vector<double> values = parse_list("--angle", "0:" + stop + ":0.1");
    ASSERT_EQ(values.size(), static_cast<std::size_t>(count) + 1) << stop;
    EXPECT_EQ(values.back(), std::stod(stop));
  }
}

TEST(List, RefusesWhatIsNoList) {
  for (const char* text : {"", ",", "1,", "a", "1 2", "0:10", "0:10:1:2", "::", "0:1:", "0,5:6",
                           "1;2", "0x10", "1,nan", "inf", "0:inf:1", "nan:1:1", "1e999", "0..5"}) {
    EXPECT_THAT(list_refusal(text),
                AllOf(HasSubstr("--angle"), HasSubstr(text), HasSubstr("expected")))
        << text;
  }
}

TEST(List, RefusesStepsThatLeadNowhere) {
  EXPECT_THAT(list_refusal("0:10:0"), HasSubstr("\"0:10:0\": expected a step that is not zero"));
  EXPECT_THAT(list_refusal("0:10:-1"), HasSubstr("sign is wrong"));
  EXPECT_THAT(list_refusal("10:0:1"), HasSubstr("sign is wrong"));
}

TEST(List, RefusesAbsurdCounts) {
  EXPECT_THAT(list_refusal("0:1:1e-9"), HasSubstr("at most 1000000 values"));
  EXPECT_THAT(list_refusal("-1e308:1e308:1e-308"), HasSubstr("at most 1000000 values"));
}

TEST(List, RefusesValuesOutsideTheRange) {
  EXPECT_THAT(refusal([] { parse_list_within("--angle", "0,200", 0, 180, "an angle"); }),
              HasSubstr("--angle \"0,200\": 200: expected an angle from 0 to 180"));
  EXPECT_THAT(parse_list_within("--angle", "0,180", 0, 180, "an angle"), ElementsAre(0, 180));
}

TEST(ImageSize, IsWidthByHeight) {
  const ImageSize size = parse_image_size("--size", "1280x720");
  EXPECT_EQ(size.width, 1280);
  EXPECT_EQ(size.height, 720);
}

TEST(ImageSize, RefusesNoAndAbsurdSizes) {
  for (const char* text :
       {"", "x", "1280", "1280x", "x720", "0x720", "1280x0", "-1x5", "1280X720", "12.5x10", "9x9x9",
        "20000x10", "16384x16384", "99999999999x1", "1280x720 "}) {
    EXPECT_THAT(refusal([&] { parse_image_size("--size", text); }),
                AllOf(HasSubstr("--size"), HasSubstr("expected WIDTHxHEIGHT")))
        << text;
  }
}

TEST(Parameters, AreReadByName) {
  EXPECT_THAT(parse_parameters("--free", "mie.phase.g1, ground.albedo"),
              ElementsAre(Parameter::kMiePhaseG1, Parameter::kGroundAlbedo));
  EXPECT_THAT(
      parse_fixed("--fix", {"ground.albedo=0.2,mie.scale_height=1e3", "ozone.column=0"}),
      UnorderedElementsAre(Pair(Parameter::kMieScaleHeight, 1000), Pair(Parameter::kOzoneColumn, 0),
                           Pair(Parameter::kGroundAlbedo, 0.2)));
  const auto priors = parse_priors("--prior", {"ground.albedo=0.2:0.05"});
  ASSERT_EQ(priors.size(), 1u);
  EXPECT_EQ(priors.at(Parameter::kGroundAlbedo).mean, 0.2);
  EXPECT_EQ(priors.at(Parameter::kGroundAlbedo).sigma, 0.05);
  const auto bounds = parse_bounds("--bounds", {"mie.phase.g2=-0.6:0.5,ground.albedo=0.1:0.3"});
  ASSERT_EQ(bounds.size(), 2u);
  EXPECT_EQ(bounds.at(Parameter::kMiePhaseG2).lower, -0.6);
  EXPECT_EQ(bounds.at(Parameter::kMiePhaseG2).upper, 0.5);
}

TEST(Parameters, RefuseUnknownNamesAndHalfValues) {
  EXPECT_THAT(refusal([] { parse_parameters("--free", "mie.beta"); }),
              AllOf(HasSubstr("--free"), HasSubstr("mie.beta")));
  for (const char* text :
       {"ground.albedo", "ground.albedo=", "ground.albedo=x", "ground.albedo=nan", "albedo=1", "=1",
        "ground.albedo=1,ground.albedo=1"}) {
    EXPECT_THAT(refusal([&] { parse_fixed("--fix", {text}); }), HasSubstr("--fix")) << text;
  }
  for (const char* text :
       {"ground.albedo", "ground.albedo=1", "ground.albedo=1:0", "ground.albedo=1:-1",
        "ground.albedo=1:nan", "ground.albedo=:1", "x=1:1"}) {
    EXPECT_THAT(refusal([&] { parse_priors("--prior", {text}); }), HasSubstr("--prior")) << text;
  }
  for (const char* text :
       {"ground.albedo", "ground.albedo=1", "ground.albedo=0.5:0.5", "ground.albedo=1:0",
        "ground.albedo=0:nan", "x=0:1", "ground.albedo=0:1,ground.albedo=0:1"}) {
    EXPECT_THAT(refusal([&] { parse_bounds("--bounds", {text}); }), HasSubstr("--bounds")) << text;
  }
}

TEST(Degrees, AreRadiansAndBack) {
  EXPECT_DOUBLE_EQ(radians(180), std::numbers::pi);
  EXPECT_DOUBLE_EQ(degrees(radians(37)), 37);
}

}  // namespace
}  // namespace skyfit::cli
