// SPDX-License-Identifier: Apache-2.0
// A joint fit of spectral scans that the model made returns the parameters, the pointing and the
// scale that made them, and reports the errors that it leaves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "fit/fit.h"
#include "fit/result/report.h"
#include "tests/fit/scans.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Noise-free residuals end at the solver's relative cost tolerance of 1e-5.
constexpr double kSolved = 2e-3;

// Close enough for a luminance (refs::gives_luminance()).
const std::vector<double> kVisible_nm = {440, 480, 520, 560, 600, 640, 680};

FitOptions determined() {
  FitOptions options;
  options.start = power_law_air();
  options.lobes = 1;
  options.use_priors = false;
  options.free = std::vector{Parameter::kMieScattering, Parameter::kMieAngstromExponent,
                             Parameter::kMiePhaseG, Parameter::kGroundAlbedo};
  options.fix = {{Parameter::kRayleighScattering, 1.25e-5},
                 {Parameter::kMieSingleScatteringAlbedo, 0.93}};
  options.noise = NoiseModel{0.01, 0};
  return options;
}

Result fit_toy(const refs::Reference& reference, const FitOptions& options) {
  return fit_atmosphere(reference, refs::standard_spectral_data(), ToySky(), options);
}

const UnknownRow& row_of(const Result& result, const std::string& name) {
  return result.unknown(name);
}

TEST(ScansFitTest, NoiseFreeScansReturnParametersAndPointing) {
  const Atmosphere<double> truth = true_atmosphere(1);
  SyntheticScans how;
  how.azimuth_offset_deg = {7, -4};
  how.wavelength_nm = kVisible_nm;
  const Result result = fit_toy(synthetic_scans(ToySky(), truth, how), determined());
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.errors.luminance, 0.1);
  EXPECT_LT(result.errors.spectral, 0.1);
  EXPECT_NEAR(row_of(result, "mie.scattering").fitted / 1.2e-4, 1, kSolved);
  EXPECT_NEAR(row_of(result, "mie.angstrom_exponent").fitted, 1.3, kSolved);
  EXPECT_NEAR(row_of(result, "ground.albedo").fitted, 0.2, kSolved);
  EXPECT_NEAR(row_of(result, "instrument.azimuth_offset[1]").fitted, 7, 0.02);
  EXPECT_NEAR(row_of(result, "instrument.azimuth_offset[2]").fitted, -4, 0.02);
}

// Absolute: at half an astronomical unit more distance the same sky is fainter, and only the
// distance explains it.
TEST(ScansFitTest, DistanceOfTheSunIsAccountedFor) {
  SyntheticScans how;
  how.sun_distance_au = 1.5;
  const refs::Reference far = synthetic_scans(ToySky(), true_atmosphere(1), how);
  how.sun_distance_au = 1;
  const refs::Reference near = synthetic_scans(ToySky(), true_atmosphere(1), how);
  EXPECT_NEAR(near.samples[0].value / far.samples[0].value, 2.25, 1e-12);
  EXPECT_NEAR(row_of(fit_toy(far, determined()), "mie.scattering").fitted / 1.2e-4, 1, kSolved);
}

TEST(ScansFitTest, UnknownScaleIsFoundAndSharedByTheScans) {
  SyntheticScans how;
  how.scale = 1.2;
  FitOptions options = determined();
  options.scale = Scale::kShared;
  const Result result = fit_toy(synthetic_scans(ToySky(), true_atmosphere(1), how), options);
  EXPECT_NEAR(row_of(result, "instrument.scale").fitted, 1.2, kSolved);
  options.scale = Scale::kPerScan;
  const Result own = fit_toy(synthetic_scans(ToySky(), true_atmosphere(1), how), options);
  EXPECT_NEAR(row_of(own, "instrument.scale[2]").fitted, 1.2, kSolved);
}

TEST(ScansFitTest, TiltIsFound) {
  const Atmosphere<double> truth = true_atmosphere(1);
  refs::Reference reference = synthetic_scans(ToySky(), truth, {});
  const Dataset data = dataset(reference, refs::standard_spectral_data(), {true, 0, {}, 0});
  SkyState state = start_state(truth, 2);
  state.instrument[0][static_cast<std::size_t>(Instrument::kTiltNorth)] = 2 * kDegree;
  state.instrument[0][static_cast<std::size_t>(Instrument::kTiltEast)] = -1 * kDegree;
  const SampleValues values = sky_values(ToySky(), data, state, {});
  for (std::size_t r = 0; r < data.samples.size(); ++r)
    reference.samples[data.samples[r].index].value = values.value(static_cast<Eigen::Index>(r));
  FitOptions options = determined();
  options.pointing = Pointing::kAzimuthAndTilt;
  const Result result = fit_toy(reference, options);
  EXPECT_NEAR(row_of(result, "instrument.tilt_north[1]").fitted, 2, 0.02);
  EXPECT_NEAR(row_of(result, "instrument.tilt_east[1]").fitted, -1, 0.02);
  EXPECT_NEAR(row_of(result, "instrument.tilt_north[2]").fitted, 0, 0.02);
}

// Every scan gets its own aerosol when asked, and the others stay shared.
TEST(ScansFitTest, ParametersPerScan) {
  const Atmosphere<double> morning = true_atmosphere(1);
  Atmosphere<double> noon = morning;
  noon.at("mie").amount = 2e-4;
  refs::Reference reference = synthetic_scans(ToySky(), morning, {});
  const refs::Reference later = synthetic_scans(ToySky(), noon, {});
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    if (reference.samples[i].scan == 1) reference.samples[i] = later.samples[i];
  }
  FitOptions options = determined();
  options.per_scan = {Parameter::kMieScattering};
  const Result result = fit_toy(reference, options);
  EXPECT_NEAR(row_of(result, "mie.scattering[1]").fitted / 1.2e-4, 1, kSolved);
  EXPECT_NEAR(row_of(result, "mie.scattering[2]").fitted / 2e-4, 1, kSolved);
  EXPECT_NEAR(row_of(result, "ground.albedo").fitted, 0.2, kSolved);
  EXPECT_EQ(result.scans[1].atmosphere.at("mie").amount,
            row_of(result, "mie.scattering[2]").fitted);
}

// A direction that looks at something else draws plain squares away, a Cauchy loss hardly.
TEST(ScansFitTest, RobustLossIgnoresADirection) {
  SyntheticScans how;
  how.noise = 0.01;
  refs::Reference reference = synthetic_scans(ToySky(), true_atmosphere(1), how);
  for (std::size_t i = 0; i < how.wavelength_nm.size(); ++i) reference.samples[i].value *= 3;
  FitOptions options = determined();
  const double plain = row_of(fit_toy(reference, options), "mie.scattering").fitted;
  options.loss = Loss::kCauchy;
  const Result result = fit_toy(reference, options);
  const double robust = row_of(result, "mie.scattering").fitted;
  EXPECT_LT(std::abs(robust / 1.2e-4 - 1), 0.02);
  EXPECT_GT(std::abs(plain / 1.2e-4 - 1), 3 * std::abs(robust / 1.2e-4 - 1));
  EXPECT_LT(result.loss_weight[0], 0.05);
  EXPECT_GT(result.loss_weight.back(), 0.7);
}

// The errors are those of their definition: a model that is 10 % too bright everywhere.
TEST(ErrorsTest, UniformExcess) {
  SyntheticScans how;
  how.wavelength_nm = kVisible_nm;
  const refs::Reference reference = synthetic_scans(ToySky(), true_atmosphere(1), how);
  std::vector<double> model;
  for (const refs::Sample& sample : reference.samples) model.push_back(1.1 * sample.value);
  const Errors errors = errors_of(reference, model, refs::standard_spectral_data());
  EXPECT_NEAR(errors.luminance, 10, 1e-9);
  EXPECT_NEAR(errors.spectral, 10, 1e-9);
  EXPECT_NEAR(errors.mean_bias, 10, 1e-9);
  EXPECT_NEAR(errors.rms_log, 0, 1e-9);  // the scale is free
}

// A direction that is stated to look at the sun, but does not, is fitted; one that truly does is
// not.
TEST(ScansFitTest, ConeAroundTheSunIsAboutTheTrueDirections) {
  SyntheticScans how;
  how.view_zenith_deg = {30, 45, 60, 70};
  how.azimuths = 36;  // azimuths 3, 13, 23 .. deg
  how.azimuth_offset_deg = {17, 17};
  FitOptions options = determined();
  options.exclude_sun = 2 * kDegree;
  const Result result = fit_toy(synthetic_scans(ToySky(), true_atmosphere(1), how), options);
  const auto weight_at = [&](double azimuth_deg) {
    for (const refs::Sample& s : result.reference.samples) {
      if (s.scan == 0 && std::abs(s.view_zenith - 30 * kDegree) < 1e-9 &&
          std::abs(s.relative_azimuth - azimuth_deg * kDegree) < 1e-6)
        return s.weight;
    }
    throw std::logic_error("no such direction");
  };
  EXPECT_EQ(weight_at(3), 1);    // 10 deg from the sun in truth
  EXPECT_EQ(weight_at(-17), 0);  // at the sun
}

// Of scans of the truth, with nothing free.
Result evaluated_truth(const std::vector<double>& wavelength_nm) {
  const Atmosphere<double> truth = true_atmosphere(1);
  FitOptions options = determined();
  options.start = Preset{"truth", truth, {}};
  options.free = std::vector<Parameter>{};
  options.fix.clear();
  options.pointing = Pointing::kStated;
  SyntheticScans how;
  how.wavelength_nm = wavelength_nm;
  return fit_toy(synthetic_scans(ToySky(), truth, how), options);
}

TEST(ScansFitTest, NothingFreeEvaluatesThePreset) {
  const Result result = evaluated_truth(kVisible_nm);
  EXPECT_TRUE(result.unknowns.empty());
  EXPECT_LT(result.errors.luminance, 1e-9);
}

TEST(ScansFitTest, ReportsNameErrorsUnknownsAndPhysics) {
  SyntheticScans how;
  how.noise = 0.02;
  how.wavelength_nm = kVisible_nm;
  const Result result = fit_toy(synthetic_scans(ToySky(), true_atmosphere(1), how), determined());
  const std::string text = full_report(result, {});
  for (const char* part : {"luminance", "spectral", "instrument.azimuth_offset[2]", "turbidity",
                           "aerosol optical depth at 550 nm", "plausible"})
    EXPECT_THAT(text, HasSubstr(part));
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    EXPECT_LE(end - begin, 130u) << text.substr(begin, end - begin);
    begin = end + 1;
  }
  const nlohmann::json json = report_json(result, {});
  EXPECT_NEAR(json["luminance_error_percent"], result.errors.luminance, 1e-12);
  EXPECT_EQ(json["unknowns"].size(), result.unknowns.size());
  EXPECT_TRUE(json["findings"]["turbidity"].contains("plausible_upper"));
}

TEST(ScansFitTest, ReportsStateALuminanceOnlyWhereThereIsOne) {
  const Result visible = evaluated_truth(kVisible_nm);
  EXPECT_THAT(brief_report(visible), HasSubstr("luminance error"));
  EXPECT_THAT(full_report(visible, {}), Not(HasSubstr("the wavelengths give none")));
  const Result green = evaluated_truth({550});
  EXPECT_THAT(brief_report(green), AllOf(HasSubstr("spectral error"), Not(HasSubstr("luminance"))));
  EXPECT_THAT(full_report(green, {}), HasSubstr("luminance: the wavelengths give none"));
  EXPECT_THAT(brief_report(evaluated_truth({870})), HasSubstr("RMS log error"));
}

std::string message_of(const refs::Reference& reference, const FitOptions& options) {
  try {
    fit_toy(reference, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(ScansFitTest, BadInputNamesOptionValueAndExpectation) {
  refs::Reference reference = synthetic_scans(ToySky(), true_atmosphere(1), {});
  FitOptions options = determined();
  options.per_scan = {Parameter::kOzoneColumn};
  EXPECT_THAT(message_of(reference, options),
              HasSubstr("fit.per_scan: ozone.column: must be a free parameter"));
  options = determined();
  options.noise = NoiseModel{0, 0};
  EXPECT_THAT(message_of(reference, options), HasSubstr("fit.noise_relative = 0: must be"));
  options = determined();
  options.instrument_priors[Instrument::kScale] = {1, 0.1};
  EXPECT_THAT(message_of(reference, options),
              HasSubstr("fit.prior: instrument.scale: must be free to have a prior"));
  reference.samples[3].value = -1;
  EXPECT_THAT(message_of(reference, determined()), HasSubstr("sample 4: value = -1: must be"));
}

}  // namespace
}  // namespace skyfit::fit
