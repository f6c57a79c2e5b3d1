// SPDX-License-Identifier: Apache-2.0
// Readings of polarisation in a fit: their Jacobian equals central differences under both links and
// with a profiled scale; a sky of the reference model is found again; polarisation narrows what
// radiance alone leaves open; models without it leave the readings out and say so; the report has
// their misfit.
#include <gmock/gmock.h>

#include <cmath>

#include "data_refs/sample_csv.h"
#include "data_refs/spectra.h"
#include "fit/fit.h"
#include "fit/problem/free_parameters.h"
#include "fit/result/record.h"
#include "fit/result/report.h"
#include "model/registry.h"
#include "model/solver/reference_model.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

using ::testing::HasSubstr;

constexpr double kNm = 550;

const SpectralData& spectra() { return refs::standard_spectral_data(); }

Atmosphere<double> true_sky() {
  Atmosphere<double> atmosphere = true_atmosphere(1);
  set_scattering(atmosphere.at("mie"), 550, 0.5e-4, 1.3);
  return atmosphere;
}

// A spectral scan of the reference model with what it says of polarisation; `scale` on the
// radiances alone.
refs::Reference scan(bool degree, double scale = 1) {
  refs::Reference reference;
  reference.name = "scan";
  reference.description = "reference model";
  reference.quantity = refs::Quantity::kSpectralRadiance;
  const std::vector<WavelengthNode> nodes = spectral_nodes(spectra(), {kNm});
  std::vector<SkyPoint> points;
  for (const double zenith : {10.0, 35.0, 55.0, 75.0}) {
    for (const double azimuth : {20.0, 75.0, 120.0, 175.0, -60.0}) {
      refs::Sample sample;
      sample.sun_zenith = 60 * kDegree;
      sample.view_zenith = zenith * kDegree;
      sample.relative_azimuth = azimuth * kDegree;
      sample.wavelength_nm = kNm;
      reference.samples.push_back(sample);
      points.push_back(sky_point(sample));
    }
  }
  const StokesValues light = ReferenceModel({}).stokes(true_sky(), nodes, points, {});
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double i = light.i.value[k], q = light.q.value[k] / i, u = light.u.value[k] / i;
    refs::Sample& sample = reference.samples[k];
    sample.value = scale * i * spectra().solar_irradiance.at(kNm);
    if (degree) {
      sample.polarisation = {{refs::Polarisation::kDegree, std::hypot(q, u), {}}};
    } else {
      sample.polarisation = {{refs::Polarisation::kQ, q, 0.005},
                             {refs::Polarisation::kU, u, 0.005}};
    }
  }
  return reference;
}

refs::Reference without_polarisation(refs::Reference reference) {
  for (refs::Sample& sample : reference.samples) sample.polarisation.clear();
  return reference;
}

FitOptions options() {
  FitOptions options;
  options.lobes = 1;
  options.starts = 1;
  options.pointing = Pointing::kStated;
  Preset start;
  start.name = "start";
  start.atmosphere = true_sky();
  set_scattering(start.atmosphere.at("mie"), 550, 1e-4, 1.3);
  start.atmosphere.ground_albedo = 0.4;
  options.start = start;
  options.free = {Parameter::kMieScattering, Parameter::kGroundAlbedo};
  options.use_priors = false;
  options.noise = NoiseModel{0.02, 0};
  return options;
}

TEST(PolarisationFit, JacobianEqualsCentralDifferences) {
  const ReferenceModel model({});
  for (const bool degree : {false, true}) {
    const Dataset data = dataset(scan(degree), spectra(), {false, 0, {}, 0, true});
    ASSERT_EQ(data.samples.size(), degree ? 40u : 60u);
    for (const auto& [link, scale] : {std::pair{Link::kLinear, Scale::kFixed},
                                      {Link::kLog, Scale::kProfiled},
                                      {Link::kLinear, Scale::kProfiled}}) {
      const Likelihood likelihood{link, scale, {}, true, Loss::kNone, 3};
      for (const Parameter& id : {Parameter::kMieScattering, Parameter::kMieSingleScatteringAlbedo,
                                  Parameter::kMiePhaseG, Parameter::kGroundAlbedo}) {
        const auto white_at = [&](double value, const std::vector<Unknown>& unknowns) {
          Atmosphere<double> atmosphere = true_sky();
          set_parameter(atmosphere, id, value);
          return whiten(data, likelihood,
                        sky_values(model, data, start_state(atmosphere, 1), unknowns), 2);
        };
        const double value = get_parameter(true_sky(), id), step = 1e-4 * value;
        const Eigen::VectorXd difference =
            (white_at(value + step, {}).residual - white_at(value - step, {}).residual) /
            (2 * step);
        const Eigen::VectorXd exact =
            white_at(value, {{free_parameter(id, parameter_info(id), {}), id, kAllScans}})
                .jacobian_per_unit.col(0);
        constexpr double kDifference = 1e-5;
        EXPECT_LT((exact - difference).cwiseAbs().maxCoeff(),
                  kDifference * exact.cwiseAbs().maxCoeff())
            << id.name();
        for (const int row : polarisations(data)) ASSERT_NE(exact(row), 0);
      }
    }
  }
}

// The instrument's scale is unknown, to which a degree of polarisation does not yield.
TEST(PolarisationFit, FindsTheSkyAndNarrowsIt) {
  const ReferenceModel model({});
  FitOptions with_scale = options();
  with_scale.scale = Scale::kProfiled;
  const Result radiance =
                   fit_atmosphere(without_polarisation(scan(false)), spectra(), model, with_scale),
               both = fit_atmosphere(scan(false, 1.3), spectra(), model, with_scale),
               degree = fit_atmosphere(scan(true), spectra(), model, with_scale);
  EXPECT_TRUE(radiance.polarisation.empty());
  for (const Result* result : {&both, &degree}) {
    for (const auto& [name, truth] :
         {std::pair{"mie.scattering", 0.5e-4}, {"ground.albedo", 0.2}}) {
      const UnknownRow &row = result->unknown(name), &alone = radiance.unknown(name);
      constexpr double kSolver = 1e-3;  // where the solver stops
      EXPECT_NEAR(row.fitted / (truth / row.unknown.unit_value()), 1, kSolver) << name;
      EXPECT_LT(row.sigma, 0.6 * alone.sigma) << name;
    }
  }
  ASSERT_EQ(both.polarisation.size(), 2u);
  EXPECT_EQ(both.polarisation[0].readings, 20);
  EXPECT_GT(both.polarisation[0].start_rms, 1);  // percentage points
  EXPECT_LT(both.polarisation[0].rms, 1e-2);
  EXPECT_NEAR(both.polarisation[0].sigma, 0.5, 1e-9);
  EXPECT_NEAR(degree.polarisation.at(0).sigma, 100 * kPolarisationSigma, 1e-9);
  EXPECT_EQ(both.samples, 20);
  EXPECT_THAT(full_report(both, {}), HasSubstr("Polarisation, RMS in percentage points"));
  const auto record = both.preset.fit.at("polarisation");
  EXPECT_EQ(record.at("u_over_i").at("readings"), 20);
  EXPECT_FALSE(radiance.preset.fit.contains("polarisation"));
}

TEST(PolarisationFit, OfAScalarModelLeavesItOutAndSaysSo) {
  FitOptions evaluate = options();
  evaluate.free = std::vector<Parameter>{};
  const auto scalar = make_sky_model("reference", spectra(), 1, Transfer::kScalar);
  const Result result = fit_atmosphere(scan(false), spectra(), *scalar, evaluate);
  EXPECT_TRUE(result.polarisation.empty());
  EXPECT_THAT(result.reference.notes,
              ::testing::Contains(HasSubstr("readings of polarisation are left out")));
}

// Written as a CSV and read again.
TEST(PolarisationFit, ReadingsSurviveACsv) {
  for (const bool degree : {false, true}) {
    const refs::Reference before = scan(degree), after = refs::parse_sample_csv(
                                                     refs::sample_csv_text(before), "again.csv");
    ASSERT_EQ(after.samples.size(), before.samples.size());
    for (std::size_t i = 0; i < before.samples.size(); ++i) {
      const auto &x = before.samples[i].polarisation, &y = after.samples[i].polarisation;
      ASSERT_EQ(x.size(), y.size());
      for (std::size_t k = 0; k < x.size(); ++k) {
        constexpr double kNineDigits = 1e-9;
        EXPECT_EQ(x[k].what, y[k].what);
        EXPECT_NEAR(x[k].value, y[k].value, kNineDigits);
        EXPECT_EQ(x[k].sigma, y[k].sigma);
      }
    }
  }
}

}  // namespace
}  // namespace skyfit::fit
