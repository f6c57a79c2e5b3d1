// SPDX-License-Identifier: Apache-2.0
// The report states what the result holds, every root mean square is what its definition says, and
// the preset survives being written and read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "fit/fit.h"
#include "model/atmosphere/derived.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

using testing::HasSubstr;

const refs::Reference& reference() {
  static const refs::Reference made = synthetic_reference(true_atmosphere(2), 0.02);
  return made;
}

const FitResult& result() {
  static const FitResult fitted =
      fit_atmosphere(reference(), refs::standard_spectral_data(), ToySky(), FitOptions{});
  return fitted;
}

TEST(ReportTest, LinesFitOneHundredColumns) {
  std::istringstream lines(full_report(result()));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  EXPECT_EQ(brief_report(result()).find('\n'), std::string::npos);
}

TEST(ReportTest, EveryParameterHasARow) {
  const std::string text = full_report(result());
  for (const FittedParameter& row : result().parameters) {
    EXPECT_THAT(text, HasSubstr(std::string(row.id.name())));
  }
  EXPECT_THAT(text, HasSubstr("One sigma is from the residuals"));
  EXPECT_EQ(report_json(result())["parameters"].size(), result().parameters.size());
  EXPECT_EQ(report_json(result())["rms_log_percent"].get<double>(), result().rms_log_percent);
}

// rms = weighted standard deviation of log(model / reference) about each scan's mean.
TEST(ReportTest, RmsIsTheStandardDeviationOfTheLogRatio) {
  const auto expected = [](double cone, double largest_sun) {
    std::vector<double> sum(4), count(4);
    double squares = 0, all = 0;
    for (const bool second_pass : {false, true}) {
      for (std::size_t i = 0; i < reference().samples.size(); ++i) {
        const refs::Sample& sample = reference().samples[i];
        if (refs::scattering_angle(sample) < cone || sample.sun_zenith > largest_sun) continue;
        const double ratio = std::log(result().fitted_model[i] / sample.value);
        if (!second_pass) {
          sum[sample.scan] += ratio;
          count[sample.scan] += 1;
        } else {
          squares += std::pow(ratio - sum[sample.scan] / count[sample.scan], 2);
          all += 1;
        }
      }
    }
    return 100 * std::sqrt(squares / all);
  };
  const double any = 4;
  EXPECT_NEAR(result().fitted_rms.all, expected(3 * kDegree, any), 1e-9);
  EXPECT_NEAR(result().fitted_rms.cone3, expected(3 * kDegree, any), 1e-9);
  EXPECT_NEAR(result().fitted_rms.cone10, expected(9.999 * kDegree, any), 1e-9);
  EXPECT_NEAR(result().fitted_rms.sun_below_70, expected(3 * kDegree, 70 * kDegree), 1e-9);
}

TEST(ReportTest, PresetIsReadBackWithItsRecord) {
  const Preset again = parse_preset(preset_to_json(result().preset), "preset.json");
  EXPECT_EQ(again.atmosphere.at("mie").amount, result().preset.atmosphere.at("mie").amount);
  EXPECT_EQ(again.fit["rms_log_percent"].get<double>(), result().rms_log_percent);
  EXPECT_EQ(again.fit["reference"]["name"], "synthetic");
  EXPECT_EQ(again.fit["covariance"]["matrix"].size(), result().covariance_parameters.size());
  EXPECT_EQ(again.fit["model"], "toy");
}

TEST(ReportTest, StatedSigmaIsUsedAndNamed) {
  refs::Reference stated = reference();
  for (refs::Sample& sample : stated.samples) sample.sigma = 0.02 * sample.value;
  const FitResult fitted =
      fit_atmosphere(stated, refs::standard_spectral_data(), ToySky(), FitOptions{});
  EXPECT_FALSE(fitted.sigma_from_residuals);
  EXPECT_NEAR(fitted.sigma_log_percent, 2, 1e-9);
  EXPECT_NEAR(fitted.chi_square_per_dof, 1, 0.4);  // 120 degrees of freedom: 0.13 one sigma
  EXPECT_THAT(full_report(fitted), HasSubstr("One sigma is from the reference's sigma"));
}

// Mean cosine of the phase function by quadrature.
TEST(ReportTest, MeanCosineOfCornetteShanks) {
  Atmosphere<double> atmosphere = true_atmosphere(1);
  double mean = 0;
  constexpr int kSteps = 20000;
  for (int i = 0; i < kSteps; ++i) {
    const double nu = -1 + (i + 0.5) * 2 / kSteps;
    mean += 2 * std::numbers::pi * nu * toy_cornette_shanks(atmosphere.at("mie").phase.g, nu) * 2 /
            kSteps;
  }
  EXPECT_NEAR(aerosol_mean_cosine(atmosphere), mean, 1e-6);
}

}  // namespace
}  // namespace skyfit::fit
