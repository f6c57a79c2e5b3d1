// SPDX-License-Identifier: Apache-2.0
// The report states what the result holds, every root mean square is what its definition says, and
// the preset survives being written and read.
#include "fit/result/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "fit/fit.h"
#include "fit/result/record.h"
#include "model/atmosphere/derived.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const refs::Reference& reference() {
  static const refs::Reference made = synthetic_reference(true_atmosphere(2), 0.02);
  return made;
}

const Result& result() {
  static const Result fitted =
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
  for (const UnknownRow& row : result().unknowns) {
    EXPECT_THAT(text, HasSubstr(std::string(row.unknown.name())));
  }
  EXPECT_THAT(text, HasSubstr("One sigma is from the residuals"));
  EXPECT_EQ(report_json(result())["unknowns"].size(), result().unknowns.size());
  EXPECT_EQ(report_json(result())["rms_log_percent"].get<double>(), result().errors.rms_log);
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
        const double ratio = std::log(result().model[i] / sample.value);
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
  EXPECT_NEAR(result().rms.all, expected(3 * kDegree, any), 1e-9);
  EXPECT_NEAR(result().rms.cone3, expected(3 * kDegree, any), 1e-9);
  EXPECT_NEAR(result().rms.cone10, expected(9.999 * kDegree, any), 1e-9);
  EXPECT_NEAR(result().rms.sun_below_70, expected(3 * kDegree, 70 * kDegree), 1e-9);
}

TEST(ReportTest, PresetIsReadBackWithItsRecord) {
  const Preset again = parse_preset(preset_to_json(result().preset), "preset.json");
  EXPECT_EQ(again.atmosphere.at("mie").amount, result().preset.atmosphere.at("mie").amount);
  EXPECT_EQ(again.fit["rms_log_percent"].get<double>(), result().errors.rms_log);
  EXPECT_EQ(again.fit["reference"]["name"], "synthetic");
  EXPECT_EQ(again.fit["covariance"]["matrix"].size(), result().covariance_unknowns.size());
  EXPECT_EQ(again.fit["model"], "toy");
}

// Everything that the reports say comes back from the preset, and the checks from report.json.
TEST(ReportTest, RecordIsReadBackIntoTheSameResult) {
  const Preset written = parse_preset(preset_to_json(result().preset), "preset.json");
  const Result again = result_of(written, "preset.json");
  Checks checks;
  checks.profiles.push_back({"ground.albedo", "1", {0.1, 0.2}, {0, 4}, {0.1, kNan}, {kNan, kNan}});
  checks.bootstrap = Bootstrap{2, 1, std::vector(result().unknowns.size(), 0.5),
                               std::vector(result().unknowns.size(), kNan)};
  checks.hold_outs.push_back({"scan 1", result().errors, result().start_errors});
  const nlohmann::json report = report_json(result(), checks);
  const PresetDocument document = PresetDocument::of_value(report, "report.json");
  const Checks read = checks_of(document.root());
  EXPECT_EQ(full_report(again, read), full_report(result(), checks));
  EXPECT_EQ(report_json(again, read), report);
}

TEST(ReportTest, ARecordThatIsNoneIsRefused) {
  Preset broken = result().preset;
  broken.fit["likelihood"]["link"] = "cubic";
  EXPECT_THAT([&] { result_of(broken, "p.json"); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr(
                  "p.json: fit.likelihood.link = \"cubic\": expected one of log, linear")));
  broken.fit = nullptr;
  EXPECT_THAT([&] { result_of(broken, "p.json"); },
              testing::ThrowsMessage<std::invalid_argument>(
                  HasSubstr("p.json: fit = null: expected an object")));
}

TEST(ReportTest, StatedSigmaIsUsedAndNamed) {
  refs::Reference stated = reference();
  for (refs::Sample& sample : stated.samples) sample.sigma = 0.02 * sample.value;
  const Result fitted =
      fit_atmosphere(stated, refs::standard_spectral_data(), ToySky(), FitOptions{});
  EXPECT_TRUE(fitted.likelihood.noise_is_known);
  EXPECT_NEAR(fitted.sigma_percent, 2, 1e-9);
  EXPECT_NEAR(fitted.chi_square_per_dof, 1, 0.4);  // 120 degrees of freedom: 0.13 one sigma
  EXPECT_THAT(full_report(fitted), HasSubstr("One sigma is from the known noise"));
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
