// SPDX-License-Identifier: Apache-2.0
// The compiled-in spectra are the published ones: known values and integrals.
#include "data_refs/spectra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "data_refs/embedded.h"

namespace skyfit::refs {
namespace {

TEST(Spectra, CoverTheVisibleInAscendingOrder) {
  const SpectralData& data = standard_spectral_data();
  for (const Spectrum* s :
       {&data.x_bar, &data.y_bar, &data.z_bar, &data.solar_irradiance, &data.ozone_cross_section}) {
    EXPECT_LE(s->wavelength_nm.front(), 380);
    EXPECT_GE(s->wavelength_nm.back(), 780);
    EXPECT_TRUE(std::is_sorted(s->wavelength_nm.begin(), s->wavelength_nm.end()));
    EXPECT_EQ(s->wavelength_nm.size(), s->value.size());
    EXPECT_GE(*std::min_element(s->value.begin(), s->value.end()), 0);
  }
}

TEST(Spectra, LuminousEfficiencyPeaksAtOneAt555) {
  const Spectrum& v = standard_spectral_data().y_bar;
  EXPECT_EQ(v.at(555), 1.0);
  EXPECT_EQ(*std::max_element(v.value.begin(), v.value.end()), 1.0);
}

TEST(Spectra, MatchingFunctionsHaveEqualAreas) {
  // CIE 015: the equal-energy spectrum has x = y = 1/3; 5 nm figures keep that to 4e-4.
  const SpectralData& data = standard_spectral_data();
  const auto area = [](const Spectrum& s) {
    return std::accumulate(s.value.begin(), s.value.end(), 0.0);
  };
  EXPECT_NEAR(area(data.x_bar) / area(data.y_bar), 1, 4e-4);
  EXPECT_NEAR(area(data.z_bar) / area(data.y_bar), 1, 4e-4);
}

TEST(Spectra, SunGivesItsIlluminanceOutsideTheAtmosphere) {
  // About 133 klx at 1 au: Darula, Kittler & Gueymard 2005 give 133.3 to 134.1 klx over the
  // published spectra.
  const LuminanceRule rule = luminance_sum_5nm(standard_spectral_data());
  EXPECT_NEAR(std::accumulate(rule.weight.begin(), rule.weight.end(), 0.0), 133.7e3, 1.0e3);
}

TEST(Spectra, OzoneAbsorbsMostAt600OfTheVisible) {
  const Spectrum& ozone = standard_spectral_data().ozone_cross_section;
  for (double nm = 400; nm <= 2500; nm += 10) EXPECT_LE(ozone.at(nm), ozone.at(600));
  EXPECT_NEAR(ozone.at(600), 5.1e-25, 0.2e-25);  // Chappuis band
}

// The Huggins bands at 340 nm: 1.3e-25 to 1.6e-25 m2 at stratospheric temperatures over 10 nm (Bass
// & Paur 1984). Both tables reach as far as has_spectra_at() says.
TEST(Spectra, ReachFromTheUltravioletToTheInfrared) {
  const SpectralData& data = standard_spectral_data();
  EXPECT_NEAR(data.ozone_cross_section.at(340), 1.45e-25, 0.2e-25);
  EXPECT_TRUE(has_spectra_at(data, 300) && has_spectra_at(data, 2500));
  EXPECT_FALSE(has_spectra_at(data, 299.9) || has_spectra_at(data, 2500.1));
  EXPECT_EQ(data.y_bar.at_or_zero(870), 0);
  // ASTM E490 has 1366.1 W/m2, of which 300 to 2500 nm hold 95.2 %.
  const Spectrum& sun = data.solar_irradiance;
  const double sum = 5 * std::accumulate(sun.value.begin(), sun.value.end(), 0.0);
  EXPECT_NEAR(sum, 0.952 * 1366.1, 7);
}

TEST(Embedded, UnknownFileIsAnError) { EXPECT_THROW(embedded_text("no.csv"), std::out_of_range); }

}  // namespace
}  // namespace skyfit::refs
