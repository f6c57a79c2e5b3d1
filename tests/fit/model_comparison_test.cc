// SPDX-License-Identifier: Apache-2.0
// A comparison finds the errors that are there: none of a model with itself, the scale of a sky
// that is twice as bright, the worst direction of one that is wrong in one; what a model cannot do
// is left out and said.
#include "fit/model_comparison.h"

#include <gmock/gmock.h>

#include <cmath>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "data_refs/truth.h"
#include "model/registry.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

ModelComparison compared(const refs::Reference& reference, const SkyModel& model,
                         const Atmosphere<double>& atmosphere) {
  return compare_model(reference, refs::standard_spectral_data(), model, atmosphere, 0.05, nullptr);
}

class ModelComparisonTest : public ::testing::Test {
 protected:
  ToySky toy_;
  Atmosphere<double> atmosphere_ = true_atmosphere(1);
  refs::Reference reference_ = synthetic_reference(atmosphere_, 0);
};

TEST_F(ModelComparisonTest, OfAModelWithItselfIsNothing) {
  const ModelComparison row = compared(reference_, toy_, atmosphere_);
  ASSERT_TRUE(row.unfitted);
  EXPECT_LT(row.unfitted->rms_log_percent, 1e-10);
  EXPECT_THAT(row.problem, IsEmpty());
  EXPECT_EQ(row.table_bytes, 0u);
  EXPECT_FALSE(row.fitted);
}

TEST_F(ModelComparisonTest, FindsScaleAndWorstDirection) {
  for (refs::Sample& sample : reference_.samples) sample.value *= 2;
  reference_.samples[7].value *= std::exp(-0.3);
  const ModelComparison row = compared(reference_, toy_, atmosphere_);
  ASSERT_TRUE(row.unfitted);
  EXPECT_EQ(row.unfitted->worst, 7u);
  EXPECT_NEAR(row.unfitted->worst_percent, 30, 1.5);  // less its share of the scan's scale
  EXPECT_NEAR(row.unfitted->scale, 2, 0.05);
}

TEST_F(ModelComparisonTest, LeavesOutWhatTheModelRefuses) {
  const refs::Reference truth = refs::truth_reference("truth:earth-550nm-ground");
  const auto nielsen = make_sky_model("nielsen", refs::standard_spectral_data(), 1);
  const ModelComparison row =
      compared(truth, *nielsen, refs::truth_preset("truth:earth-550nm-ground").atmosphere);
  ASSERT_TRUE(row.unfitted);
  EXPECT_LT(row.unfitted->samples, static_cast<int>(truth.samples.size()));
  EXPECT_THAT(row.problem, HasSubstr("the model has no twilight"));
}

// A fit starts where the unfitted model stands, on the planet of its preset.
TEST_F(ModelComparisonTest, AFitOfTheTruthStaysThere) {
  FitOptions options;
  options.start = Preset{};
  options.start->atmosphere = atmosphere_;
  options.start->atmosphere.bottom_radius_m = 3e6;
  options.start->atmosphere.top_radius_m = 3.1e6;
  options.starts = 1;
  options.threads = 1;
  const ModelComparison row = compare_model(reference_, refs::standard_spectral_data(), toy_,
                                            options.start->atmosphere, 0.05, &options);
  ASSERT_TRUE(row.fitted) << row.fit_problem;
  EXPECT_EQ(row.fit->preset.atmosphere.bottom_radius_m, 3e6);
  EXPECT_LT(row.fitted->rms_log_percent, 0.5);
}

TEST_F(ModelComparisonTest, PreethamFits) {
  const auto preetham = make_sky_model("preetham", refs::standard_spectral_data(), 1);
  FitOptions options;
  options.starts = 2;
  const refs::Reference sky = refs::load_reference("cie:12", {0.5, 1.0}, refs::Sampling::kTregenza);
  const ModelComparison row = compare_model(sky, refs::standard_spectral_data(), *preetham,
                                            Atmosphere<double>{}, 0.05, &options);
  ASSERT_TRUE(row.fitted) << row.fit_problem;
  EXPECT_LT(row.fitted->rms_log_percent, 30);
}

TEST_F(ModelComparisonTest, TablesHoldOneLinePerState) {
  const std::vector<ModelComparison> rows = {compared(reference_, toy_, atmosphere_)};
  const std::string csv = comparison_csv(reference_, rows);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2);
  EXPECT_EQ(comparison_json(reference_, rows).at("models").size(), 1u);
  EXPECT_THAT(comparison_text(reference_, rows), HasSubstr("toy"));
}

}  // namespace
}  // namespace skyfit::fit
