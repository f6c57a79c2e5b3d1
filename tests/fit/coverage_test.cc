// SPDX-License-Identifier: Apache-2.0
// One sigma is one sigma: over 200 repetitions of synthetic scans with known parameters and noise,
// the true value of every unknown lies within one sigma in 57 to 79 % of them (68.3 % expected,
// 3.3 % the standard deviation of such a share). Slow.
#include <gtest/gtest.h>

#include <map>

#include "fit/fit.h"
#include "model/registry.h"
#include "tests/fit/scans.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

constexpr int kRepetitions = 200;
constexpr double kLeast = 0.57, kMost = 0.79;

struct Coverage {
  int within = 0, counted = 0;
};

double true_value(const UnknownRow& row, const Atmosphere<double>& truth,
                  const SyntheticScans& how) {
  if (const Parameter* parameter = std::get_if<Parameter>(&row.unknown.what))
    return get_parameter(truth, *parameter);
  return how.azimuth_offset_deg[static_cast<std::size_t>(row.unknown.scan)];
}

std::map<std::string, Coverage> coverage(const Atmosphere<double>& truth,
                                         const FitOptions& options) {
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  SyntheticScans how;
  how.azimuth_offset_deg = {6, 9};
  how.noise = 0.02;
  std::map<std::string, Coverage> result;
  for (int k = 0; k < kRepetitions; ++k) {
    how.seed = static_cast<unsigned int>(1000 + k);
    const Result fitted = fit_atmosphere(synthetic_scans(*model, truth, how),
                                         refs::standard_spectral_data(), *model, options);
    for (const UnknownRow& row : fitted.unknowns) {
      Coverage& c = result[row.unknown.name()];
      ++c.counted;
      c.within += std::abs(row.fitted - true_value(row, truth, how)) <= row.sigma;
    }
  }
  return result;
}

TEST(CoverageTest, TrueValuesLieWithinOneSigmaAsOftenAsTheyShould) {
  const Atmosphere<double> truth = true_atmosphere(1);
  FitOptions options;
  options.lobes = 1;
  options.start = Preset{"truth", truth, {}};
  options.starts = 1;
  options.use_priors = false;
  options.free =
      std::vector{Parameter::kMieScattering, Parameter::kMieAngstromExponent, Parameter::kMiePhaseG,
                  Parameter::kMieSingleScatteringAlbedo, Parameter::kGroundAlbedo};
  options.noise = NoiseModel{0.02, 0};
  for (const auto& [name, c] : coverage(truth, options)) {
    const double share = static_cast<double>(c.within) / c.counted;
    std::printf("%-32s within one sigma in %.1f %% of %d\n", name.c_str(), 100 * share, c.counted);
    EXPECT_GE(share, kLeast) << name;
    EXPECT_LE(share, kMost) << name;
  }
}

}  // namespace
}  // namespace skyfit::fit
