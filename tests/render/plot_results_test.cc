// SPDX-License-Identifier: Apache-2.0
// What a fit leaves becomes the figure's data: scales leave no mean residual, the cone around the
// sun does not count, maps of an analytic reference show 145 patches, and folders that are no
// results are refused by name.
#include <gmock/gmock.h>

#include <numbers>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "plot_samples.h"
#include "render/plot/evaluate.h"
#include "render/plot/results.h"

namespace skyfit::plot {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

constexpr double kRadian = std::numbers::pi / 180;

// A sky whose radiance is a power of the view zenith's cosine: enough to see what is done with the
// values.
class CosineSky : public SkyModel {
 public:
  std::string_view name() const override { return "cosine"; }
  SkyValues radiance(const Atmosphere<double>&, std::span<const WavelengthNode> wavelengths,
                     std::span<const SkyPoint> points, std::span<const Parameter>) const override {
    SkyValues values;
    values.points = static_cast<int>(points.size());
    values.wavelengths = static_cast<int>(wavelengths.size());
    for (const auto& point : points)
      values.value.insert(values.value.end(), wavelengths.size(),
                          1.1 + std::cos(point.view_zenith));
    return values;
  }
};

FitOutcome outcome(const std::string& reference,
                   const std::string& quantity = "relative_luminance") {
  FitOutcome fit;
  fit.folder = "out";
  fit.preset.name = "a name";
  fit.preset.fit = {{"model", "cosine"},
                    {"reference",
                     {{"name", reference},
                      {"description", "A sky"},
                      {"quantity", quantity},
                      {"exclude_sun_deg", 3}}},
                    {"likelihood", {{"scale", "profiled"}}}};
  const auto samples =
      refs::load_reference("cie:12", {0, 40 * kRadian}, refs::Sampling::kPrincipalPlane);
  fit.samples = evaluated_samples(samples, fit.preset.atmosphere, refs::standard_spectral_data(),
                                  CosineSky(), 3 * kRadian);
  return fit;
}

Comparison figure(const std::vector<FitOutcome>& fits) {
  const CosineSky sky;
  return comparison_of(fits, refs::standard_spectral_data(),
                       [&](std::string_view name, Transfer) -> const SkyModel& {
                         EXPECT_EQ(name, "cosine");
                         return sky;
                       });
}

TEST(EvaluatedSamples, ScaleLeavesNoMeanResidualPerSun) {
  const auto samples = outcome("cie:12").samples;
  for (const double sun : {0.0, 40.0}) {
    double sum = 0, size = 0;
    for (const auto& sample : samples) {
      if (sample.sun_zenith_deg != sun) continue;
      sum += sample.weight * sample.residual();
      size += std::abs(sample.residual());
      EXPECT_NEAR(sample.residual(), std::log(sample.model / sample.reference), 1e-14);
    }
    EXPECT_NEAR(sum, 0, 1e-12);
    EXPECT_GT(size, 1) << "a cosine is no CIE sky";
  }
}

TEST(EvaluatedSamples, ConeAroundTheSunHasNoWeightAndAnglesAreWhole) {
  int left_out = 0;
  for (const auto& sample : outcome("cie:12").samples) {
    if (sample.weight == 0) ++left_out;
    EXPECT_EQ(sample.view_zenith_deg, std::round(sample.view_zenith_deg));
    if (sample.weight == 0) {
      EXPECT_EQ(sample.view_zenith_deg, sample.sun_zenith_deg);
    }
  }
  EXPECT_EQ(left_out, 2);  // one per sun: the sampling's 5 degrees hit the sun itself
}

TEST(ComparisonOf, MapsOfAnAnalyticReferenceShowTregenzasPatches) {
  const Comparison comparison = figure({outcome("cie:12")});
  EXPECT_EQ(comparison.curves[0].hemisphere.size(), 2u * 145u);
  EXPECT_EQ(comparison.title, "A sky");
  EXPECT_EQ(comparison.reference_label, "reference cie:12");
}

TEST(ComparisonOf, SaysWhetherTheScaleIsFree) {
  FitOutcome fit = outcome("cie:12");
  EXPECT_THAT(figure({fit}).subtitle, HasSubstr("luminance scale free per sun position"));
  fit.preset.fit["likelihood"]["scale"] = "fixed";
  EXPECT_THAT(figure({fit}).subtitle, Not(HasSubstr("free")));
}

TEST(ComparisonOf, MapsOfMeasurementsShowTheirSamples) {
  const FitOutcome fit = outcome("roof.csv");
  EXPECT_EQ(samples_to_csv(figure({fit}).curves[0].hemisphere), samples_to_csv(fit.samples));
}

TEST(ComparisonOf, SeveralFitsOfOneNameAreToldApartByFolder) {
  FitOutcome a = outcome("cie:12"), b = a, c = a;
  b.folder = "second";
  c.preset.name = "another";
  const Comparison comparison = figure({a, b, c});
  EXPECT_EQ(comparison.curves[0].label, "a name (out)");
  EXPECT_EQ(comparison.curves[1].label, "a name (second)");
  EXPECT_EQ(comparison.curves[2].label, "another");
}

TEST(ComparisonOf, RefusesWhatCannotShareAFigure) {
  EXPECT_THAT(
      [] {
        figure({outcome("cie:12"), outcome("a.csv", "luminance_cd_m2")});
      },
      ThrowsMessage<std::invalid_argument>(
          HasSubstr("its reference has another unit than that of out")));
  EXPECT_THAT([] { figure({}); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("0 fits: expected 1 to 4")));
  FitOutcome unfitted = outcome("cie:12");
  unfitted.preset.fit = nullptr;
  EXPECT_THAT([&] { figure({unfitted}); }, ThrowsMessage<std::invalid_argument>(HasSubstr(
                                               "out: fit/reference/quantity: missing, expected")));
  FitOutcome wrong = outcome("cie:12");
  wrong.preset.fit["reference"]["exclude_sun_deg"] = "three";
  EXPECT_THAT([&] { figure({wrong}); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("out: fit/reference/exclude_sun_deg = \"three\": expected a number")));
}

TEST_F(PlotTest, AFitThatWasWrittenReadsBack) {
  const FitOutcome fit = outcome("cie:12");
  std::ofstream(folder_ / "preset.json") << preset_to_json(fit.preset);
  write_samples_csv(folder_ / "samples.csv", fit.samples);
  const FitOutcome read = read_fit_outcome(folder_);
  EXPECT_EQ(read.preset.name, "a name");
  EXPECT_EQ(read.samples.size(), fit.samples.size());
  write_comparison(figure({read}), {folder_ / "again.png"});
  EXPECT_GT(std::filesystem::file_size(folder_ / "again.png"), 20000u);
}

TEST_F(PlotTest, AFolderThatIsNoResultIsNamed) {
  EXPECT_THAT([&] { read_fit_outcome(folder_); },
              ThrowsMessage<std::runtime_error>(HasSubstr((folder_ / "preset.json").string())));
}

}  // namespace
}  // namespace skyfit::plot
