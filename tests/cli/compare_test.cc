// SPDX-License-Identifier: Apache-2.0
// `skyfit compare`: what it leaves, and what it says where there is nothing to compare.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class CompareTest : public ProgramTest {};

TEST_F(CompareTest, LeavesTablesAndFigures) {
  const std::string text =
      output({"compare", "--reference", "perez:6,0.15", "--sun-zenith-deg", "30,60", "--models",
              "oneil,nielsen,hoffman-preetham", "--fitted", "--out", "compared"});
  EXPECT_THAT(text, HasSubstr("oneil"));
  EXPECT_THAT(files(),
              ::testing::IsSupersetOf(
                  {"compared/comparison.txt", "compared/comparison.csv", "compared/comparison.json",
                   "compared/comparison.svg", "compared/comparison.png", "compared/comparison.pdf",
                   "compared/fisheye.svg", "compared/fisheye.png", "compared/fisheye.pdf"}));
  const json models = json::parse(read("compared/comparison.json")).at("models");
  ASSERT_EQ(models.size(), 6u);  // three models, unfitted and fitted
  for (std::size_t i = 0; i < 6; i += 2) {
    EXPECT_LT(models[i + 1].at("rms_log_percent").get<double>(),
              models[i].at("rms_log_percent").get<double>())
        << models[i].at("model");
  }
  EXPECT_EQ(lines(read("compared/comparison.csv")).size(), 7u);
}

// The air of Mars has a turbidity of 182.
TEST_F(CompareTest, FailsWhereNoModelAnswers) {
  const Outcome outcome =
      run({"compare", "--reference", "cie:12", "--sun-zenith-deg", "40", "--preset", "mars",
           "--models", "hosek-wilkie,preetham", "--out", "compared"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.err, HasSubstr("none of the models can answer"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "compared/comparison.txt"));  // it says why
}

TEST_F(CompareTest, TruthIsComparedWithItsOwnTransfer) {
  const json models = json::parse(output({"compare", "--reference", "truth:earth-550nm-ground",
                                          "--models", "reference", "--json", "--out", "compared"}))
                          .at("models");
  EXPECT_EQ(models[0].at("transfer"), "scalar");
  EXPECT_LT(models[0].at("rms_log_percent").get<double>(), 0.5);
}

}  // namespace
}  // namespace skyfit::cli
