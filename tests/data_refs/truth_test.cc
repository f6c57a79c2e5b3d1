// SPDX-License-Identifier: Apache-2.0
// The tables of truth are references of one wavelength, and each has the atmosphere that made it.
#include "data_refs/truth.h"

#include <gtest/gtest.h>

#include "data_refs/references.h"
#include "data_refs/spectra.h"

namespace skyfit::refs {
namespace {

TEST(Truth, EveryTableIsAReferenceWithItsAtmosphere) {
  for (const TruthEntry& entry : truth_references()) {
    const Reference truth = load_reference(entry.name, {}, Sampling::kPrincipalPlane);
    EXPECT_EQ(truth.name, entry.name);
    EXPECT_EQ(truth.quantity, Quantity::kSpectralRadiance);
    EXPECT_GT(truth.samples.size(), 100u);
    for (const Sample& sample : truth.samples) {
      EXPECT_EQ(sample.wavelength_nm, 550);
      EXPECT_GT(sample.value, 0);
    }
    EXPECT_EQ(truth_preset(entry.name).atmosphere.at("ozone").amount, 0);
  }
  EXPECT_THROW(truth_reference("truth:nonsense"), std::invalid_argument);
}

// The first row of the clear table: 2.520415744e-02 per unit solar irradiance.
TEST(Truth, RadiancesAreThoseUnderTheSunAtOneAu) {
  const Reference clear = truth_reference("truth:earth-550nm-ground");
  EXPECT_DOUBLE_EQ(clear.samples.front().value,
                   2.520415744e-02 * standard_spectral_data().solar_irradiance.at(550));
}

}  // namespace
}  // namespace skyfit::refs
