// SPDX-License-Identifier: Apache-2.0
// Every shipped reference and preset loads by name; what cannot be loaded is named with what was
// expected.
#include "data_refs/references.h"

#include <gmock/gmock.h>

#include <numbers>
#include <stdexcept>

#include "data_refs/cie_sky.h"
#include "model/atmosphere/preset.h"

namespace skyfit::refs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kPi = std::numbers::pi;

TEST(References, AreFifteenTypesAndTheTraditionalOvercast) {
  const std::vector<ReferenceEntry> entries = shipped_references();
  ASSERT_EQ(entries.size(), 16u);
  EXPECT_EQ(entries[11].name, "cie:12");
  EXPECT_EQ(entries[15].name, "cie:traditional-overcast");
  for (const ReferenceEntry& entry : entries) EXPECT_FALSE(entry.description.empty());
}

TEST(References, HaveAScanPerSunAndTheSamplesOfTheSampling) {
  const std::vector<double> suns = {0.0, kPi / 6, kPi / 3};
  for (const ReferenceEntry& entry : shipped_references()) {
    for (const auto& [sampling, count] :
         {std::pair{Sampling::kPrincipalPlane, 35}, {Sampling::kTregenza, 145}}) {
      const Reference reference = load_reference(entry.name, suns, sampling);
      EXPECT_EQ(reference.name, entry.name);
      EXPECT_EQ(reference.quantity, Quantity::kRelativeLuminance);
      ASSERT_EQ(reference.samples.size(), suns.size() * count);
      for (std::size_t i = 0; i < reference.samples.size(); ++i) {
        const Sample& sample = reference.samples[i];
        EXPECT_EQ(sample.scan, static_cast<int>(i) / count);
        EXPECT_EQ(sample.sun_zenith, suns[sample.scan]);
        EXPECT_GT(sample.value, 0);
        EXPECT_EQ(sample.weight, 1);
        EXPECT_FALSE(sample.sigma.has_value());
      }
    }
  }
}

TEST(References, SamplesHoldTheFormula) {
  const Reference reference = load_reference("cie:12", {kPi / 4}, Sampling::kTregenza);
  for (const Sample& s : reference.samples) {
    EXPECT_EQ(s.value, cie_relative_luminance(cie_skies()[11], s.sun_zenith, s.view_zenith,
                                              scattering_angle(s)));
  }
}

TEST(References, UnknownNameAndNightAreErrors) {
  const auto load = [](std::string_view name, std::vector<double> suns) {
    return [name, suns] { load_reference(name, suns, Sampling::kPrincipalPlane); };
  };
  EXPECT_THAT(load("cie:16", {0.0}),
              ThrowsMessage<std::invalid_argument>(HasSubstr("cie:16: no such file or reference")));
  EXPECT_THAT(load("cie:12", {}),
              ThrowsMessage<std::invalid_argument>(HasSubstr("cie:12: no sun_zenith_deg given")));
  EXPECT_THAT(load("cie:12", {95 * kPi / 180}),
              ThrowsMessage<std::invalid_argument>("cie:12: sun_zenith_deg = 95: expected 0 <= "
                                                   "sun_zenith_deg < 90, a sun above the horizon"));
  EXPECT_THAT(load(testing::TempDir(), {}),
              ThrowsMessage<std::invalid_argument>(HasSubstr("no measured sky: expected files")));
  EXPECT_THROW(load("cie:12", {kPi / 2})(), std::invalid_argument);
  EXPECT_THROW(load("cie:12", {std::nan("")})(), std::invalid_argument);
}

TEST(ScatteringAngle, HasItsClosedForms) {
  Sample sample;
  sample.sun_zenith = 0.7;
  sample.view_zenith = 0.7;
  EXPECT_EQ(scattering_angle(sample), 0);
  sample.view_zenith = 0.7 + 1e-9;
  EXPECT_NEAR(scattering_angle(sample), 1e-9, 1e-15);  // acos would give 0 or 1.5e-8
  sample.relative_azimuth = kPi;
  sample.view_zenith = 0.4;
  EXPECT_NEAR(scattering_angle(sample), 1.1, 1e-14);
  sample.view_zenith = 0;
  EXPECT_NEAR(scattering_angle(sample), 0.7, 1e-14);
  sample.sun_zenith = sample.view_zenith = kPi / 2;
  sample.relative_azimuth = 2.0;
  EXPECT_NEAR(scattering_angle(sample), 2.0, 1e-14);
}

TEST(ShippedPresets, AllReadAndCarryTheirName) {
  EXPECT_THAT(shipped_preset_names(),
              ElementsAre("bodare-2014", "bruneton-2008", "earth-alpine", "earth-clear",
                          "earth-hazy", "earth-volcanic", "hillaire-2020", "mars", "nielsen-2003",
                          "oneil-2005", "overcast", "schafhitzel-2007-earth",
                          "schafhitzel-2007-mars", "sperlhofer-2011", "thin-cloud", "titan"));
  for (const std::string& name : shipped_preset_names()) {
    EXPECT_EQ(parse_preset(shipped_preset_json(name), name).name, name);
  }
  EXPECT_THAT(
      [] { shipped_preset_json("venus"); },
      ThrowsMessage<std::invalid_argument>(
          "venus: unknown preset, expected one of bodare-2014, bruneton-2008, earth-alpine, "
          "earth-clear, earth-hazy, earth-volcanic, hillaire-2020, mars, nielsen-2003, oneil-2005, "
          "overcast, schafhitzel-2007-earth, schafhitzel-2007-mars, sperlhofer-2011, thin-cloud, "
          "titan"));
}

}  // namespace
}  // namespace skyfit::refs
