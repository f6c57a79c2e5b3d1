// SPDX-License-Identifier: Apache-2.0
// Irradiances beside a sky in one fit: each keeps its own noise and scale, the information of both
// adds, and what made them is found again.
#include <gmock/gmock.h>

#include <cmath>

#include "data_refs/irradiance.h"
#include "data_refs/joint_reference.h"
#include "fit/exchange/result_netcdf.h"
#include "fit/fit.h"
#include "fit/problem/problem.h"
#include "fit/result/record.h"
#include "fit/result/report.h"
#include "fit/uncertainty/checks.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSubsetOf;

constexpr double kRounding = 1e-12;
constexpr double kNoise = 0.02, kIrradianceNoise = 0.03;

const SpectralData& spectra() { return refs::standard_spectral_data(); }

// Replaces every value by that of the toy sky, times a logarithmic noise.
refs::Reference made_by(refs::Reference reference, const Atmosphere<double>& atmosphere,
                        std::uint32_t seed, double noise) {
  for (refs::Sample& sample : reference.samples) sample.value = 1;
  const Dataset data = dataset(reference, spectra(), {});
  const Eigen::VectorXd values =
      sky_values(ToySky(), data, start_state(atmosphere, static_cast<int>(data.scans.size())), {})
          .value;
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0, 1);
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    refs::Sample& sample = reference.samples[data.samples[i].index];
    sample.value = values(static_cast<Eigen::Index>(i)) * std::exp(noise * normal(generator));
    if (sample.irradiance) sample.sigma = kIrradianceNoise * sample.value;
  }
  return reference;
}

// Beam and sky under suns of 20, 40 and 60 deg, which are those of the scans of the synthetic sky.
refs::Reference irradiances(const char* const values = "direct=1lx,diffuse=4lx,global=5lx") {
  std::vector<refs::Reference> suns;
  for (const double sun : {20, 40, 60})
    suns.push_back(refs::irradiance_reference(values, sun * kDegree, {}));
  return refs::joint_reference(suns);
}

refs::Reference sky(refs::Quantity quantity) {
  refs::Reference reference = synthetic_reference(true_atmosphere(1), 0);
  reference.quantity = quantity;
  return reference;
}

std::vector<Parameter> freed() {
  return {Parameter::kMieScattering, Parameter::kMieSingleScatteringAlbedo,
          Parameter::kGroundAlbedo};
}

FitOptions options() {
  FitOptions options;
  options.lobes = 1;
  options.starts = 1;
  options.use_priors = false;
  options.exclude_sun = 0;
  options.noise = NoiseModel{kNoise, 0};
  options.link = Link::kLog;
  options.pointing = Pointing::kStated;
  options.start = Preset{};
  options.start->name = "truth";
  options.start->atmosphere = true_atmosphere(1);
  options.free = freed();
  return options;
}

// J^T J of the whitened residuals at the truth.
Eigen::MatrixXd information(const refs::Reference& reference) {
  FitOptions wanted = options();
  if (refs::is_irradiance(reference.quantity)) wanted.noise.reset();
  const Problem problem = make_problem(reference, spectra(), ToySky(), wanted);
  const SampleValues values = sky_values(ToySky(), problem.fitted, problem.start, problem.unknowns);
  const Eigen::MatrixXd jacobian =
      whiten(problem.fitted, problem.likelihood, values, 1).jacobian_per_unit;
  return jacobian.transpose() * jacobian;
}

TEST(IrradianceBesideSky, InformationOfBothAdds) {
  for (const auto quantity : {refs::Quantity::kLuminance, refs::Quantity::kRelativeLuminance}) {
    for (const char* const values :
         {"direct=1lx,diffuse=1lx", "direct=1W/m2,global=1W/m2,precipitable_water=14mm"}) {
      const refs::Reference light = made_by(irradiances(values), true_atmosphere(1), 1, 0);
      const Eigen::MatrixXd both = information(refs::with_irradiances(sky(quantity), light)),
                            sum = information(sky(quantity)) + information(light);
      EXPECT_LT((both - sum).cwiseAbs().maxCoeff(), kRounding * sum.cwiseAbs().maxCoeff())
          << values;
    }
  }
}

TEST(IrradianceBesideSky, WhatMadeBothIsFoundAndNoSigmaGrows) {
  const Atmosphere<double> truth = true_atmosphere(1);
  refs::Reference seen = made_by(sky(refs::Quantity::kRelativeLuminance), truth, 3, kNoise);
  // A relative luminance has a scale of its own, of which irradiances know nothing.
  for (refs::Sample& sample : seen.samples) sample.value *= 1e-3 * (1 + sample.scan);
  const refs::Reference light = made_by(irradiances(), truth, 4, kIrradianceNoise);
  const auto fitted = [&](const refs::Reference& reference) {
    FitOptions wanted = options();
    if (refs::is_irradiance(reference.quantity)) wanted.noise.reset();
    return fit_atmosphere(reference, spectra(), ToySky(), wanted);
  };
  const Result both = fitted(refs::with_irradiances(seen, light)), of_sky = fitted(seen),
               of_light = fitted(light);
  for (const Parameter& id : freed()) {
    const UnknownRow& row = both.unknown(id.name());
    EXPECT_NEAR(row.fitted * row.unknown.unit_value(), get_parameter(truth, id),
                3 * row.sigma * row.unknown.unit_value())
        << id.name();
    EXPECT_LT(row.sigma, of_sky.unknown(id.name()).sigma) << id.name();
    EXPECT_LT(row.sigma, of_light.unknown(id.name()).sigma) << id.name();
  }
  EXPECT_NEAR(both.chi_square_per_dof, 1, 0.3);
  EXPECT_EQ(both.samples, of_sky.samples);
  EXPECT_EQ(both.directions, of_sky.directions);
  ASSERT_EQ(both.irradiances.size(), 3u);
  EXPECT_EQ(both.irradiances[0].what, kDirectNormal);
  EXPECT_EQ(both.irradiances[0].samples, 3);
  EXPECT_NEAR(both.irradiances[0].sigma, 100 * kIrradianceNoise, 1e-6);
  EXPECT_LT(both.irradiances[0].rms, 300 * kIrradianceNoise);
}

// The three suns of irradiances(), and one of which there is no scan.
refs::Reference with_evening() {
  refs::Reference evening = refs::irradiance_reference("direct=50000lx", 70 * kDegree, {});
  return refs::with_irradiances(sky(refs::Quantity::kLuminance),
                                refs::joint_reference({irradiances(), evening}));
}

TEST(IrradianceBesideSky, ScaleAndPointingAreThoseOfTheSkyAlone) {
  FitOptions wanted = options();
  wanted.scale = Scale::kPerScan;
  wanted.pointing = Pointing::kAzimuth;
  const Problem problem = make_problem(with_evening(), spectra(), ToySky(), wanted);
  ASSERT_EQ(problem.scans(), 5);
  for (const Instrument id : {Instrument::kScale, Instrument::kAzimuthOffset}) {
    const auto count = std::ranges::count_if(problem.unknowns, [&](const Unknown& unknown) {
      return unknown.what == std::variant<Parameter, Instrument>(id);
    });
    EXPECT_EQ(count, 4) << instrument_info(id).name;
  }
  SkyState moved = problem.start;
  for (InstrumentState& instrument : moved.instrument) {
    instrument[static_cast<std::size_t>(Instrument::kScale)] = 1.1;
    instrument[static_cast<std::size_t>(Instrument::kAzimuthOffset)] = 5 * kDegree;
  }
  const SampleValues at_start =
                         sky_values(ToySky(), problem.fitted, problem.start, problem.unknowns),
                     after = sky_values(ToySky(), problem.fitted, moved, problem.unknowns);
  const std::vector<int> beside = irradiances_beside_sky(problem.fitted);
  ASSERT_EQ(beside.size(), 10u);
  EXPECT_EQ(after.value(beside), at_start.value(beside));
  for (std::size_t u = 0; u < problem.unknowns.size(); ++u) {
    if (!std::holds_alternative<Instrument>(problem.unknowns[u].what)) continue;
    EXPECT_EQ(after.derivative.col(static_cast<Eigen::Index>(u))(beside).norm(), 0);
  }
}

TEST(IrradianceBesideSky, TheNoiseOfTheSkyIsNotThatOfTheIrradiances) {
  FitOptions wanted = options();
  wanted.noise.reset();
  wanted.link.reset();
  const Problem problem = make_problem(with_evening(), spectra(), ToySky(), wanted);
  EXPECT_FALSE(problem.likelihood.noise_is_known);
  EXPECT_EQ(problem.likelihood.link, Link::kLinear);
  const SampleValues values = sky_values(ToySky(), problem.fitted, problem.start, {});
  const Eigen::VectorXd once = whiten(problem.fitted, problem.likelihood, values, 1).residual,
                        thrice = whiten(problem.fitted, problem.likelihood, values, 3).residual;
  for (std::size_t i = 0; i < problem.fitted.samples.size(); ++i) {
    const Sample& sample = problem.fitted.samples[i];
    const auto row = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(once(row), (sample.beside_sky ? 1 : 3) * thrice(row),
                kRounding * (1 + std::abs(once(row))));
    if (!sample.beside_sky) continue;
    EXPECT_NEAR(once(row), std::log(values.value(row) / sample.value) / 0.05,
                kRounding * (1 + std::abs(once(row))));
  }
}

TEST(IrradianceBesideSky, HoldOutsAndBootstrapLeaveTheIrradiances) {
  const ToySky model;
  FitOptions wanted = options();
  wanted.free = {Parameter::kMieScattering};
  const Result result = fit_atmosphere(with_evening(), spectra(), model, wanted);
  const std::vector<HoldOut> scans = leave_one_scan_out(spectra(), model, wanted, result);
  ASSERT_EQ(scans.size(), 4u);  // not the evening
  const std::vector<HoldOut> parts = hold_out_directions(spectra(), model, wanted, result, 2, 1);
  for (const HoldOut& part : parts) EXPECT_TRUE(std::isfinite(part.predicted.luminance));
  const Bootstrap drawn = bootstrap(spectra(), model, wanted, result, 2, 1);
  EXPECT_EQ(drawn.failed, 0);
}

TEST(IrradianceBesideSky, ReportsRecordsAndTablesHoldBoth) {
  const Result result =
      fit_atmosphere(refs::with_irradiances(
                         made_by(sky(refs::Quantity::kLuminance), true_atmosphere(1), 5, kNoise),
                         made_by(irradiances(), true_atmosphere(1), 6, kIrradianceNoise)),
                     spectra(), ToySky(), options());
  EXPECT_THAT(full_report(result, {}), HasSubstr("with 9 illuminances, log residuals"));
  EXPECT_THAT(full_report(result, {}), HasSubstr("Illuminances beside the sky, percent"));
  const Result read = result_of(result.preset, "preset");
  EXPECT_EQ(read.reference.irradiance_quantity, refs::Quantity::kIlluminance);
  ASSERT_EQ(read.irradiances.size(), 3u);
  EXPECT_EQ(read.irradiances[2].what, kGlobalHorizontal);
  EXPECT_EQ(read.irradiances[2].rms, result.irradiances[2].rms);
  const NetcdfFile file = netcdf_of(result);
  using Dimension = std::pair<std::string, std::size_t>;
  EXPECT_THAT(std::vector<Dimension>({{"sample", 4 * 33}, {"irradiance_sample", 9}}),
              IsSubsetOf(file.dimensions));
  const auto variable =
      std::ranges::find(file.variables, "irradiance_model", &NetcdfVariable::name);
  ASSERT_NE(variable, file.variables.end());
  EXPECT_EQ(variable->units, "lx");
  EXPECT_EQ(std::get<std::vector<double>>(variable->values).size(), 9u);
}

}  // namespace
}  // namespace skyfit::fit
