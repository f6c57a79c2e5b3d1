// SPDX-License-Identifier: Apache-2.0
// The examples of measured skies hold what they say they were made of: the sky of the preset
// earth-clear at the sun of their time and place, in every direction and wavelength.
#include <gmock/gmock.h>

#include <cmath>
#include <ostream>
#include <string>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/preset.h"
#include "model/registry.h"
#include "model/sky_model.h"

namespace skyfit::refs {
namespace {

struct Example {
  std::string file;
  Quantity quantity;
  std::size_t samples, used, scans;
  double digits;  // to which the file holds its values, relative
  // Most examples were made before the model knew polarisation.
  Transfer transfer = Transfer::kScalar;

  friend void PrintTo(const Example& example, std::ostream* out) { *out << example.file; }
};

class MeasuredExamples : public testing::TestWithParam<Example> {};

// Of the sample in the unit of the reference, at the sun's distance.
double model_value(const SkyModel& model, const Sample& sample, Quantity quantity,
                   double distance_au) {
  static const Preset preset = parse_preset(shipped_preset_json("earth-clear"), "earth-clear");
  const SpectralData& data = standard_spectral_data();
  const SkyPoint point{0, sample.sun_zenith, sample.view_zenith, sample.relative_azimuth};
  const LuminanceRule rule = luminance_rule(data);
  const bool is_spectral = quantity == Quantity::kSpectralRadiance;
  const auto nodes = is_spectral ? spectral_nodes(data, {sample.wavelength_nm}) : rule.nodes;
  const SkyValues values = model.radiance(preset.atmosphere, nodes, {&point, 1}, {});
  double sum = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    sum += values.at(0, static_cast<int>(k)) *
           (is_spectral ? data.solar_irradiance.at(sample.wavelength_nm) : rule.weight[k]);
  }
  return sum / (distance_au * distance_au);
}

TEST_P(MeasuredExamples, HoldTheSkyTheySay) {
  const Example& example = GetParam();
  const Reference sky =
      load_reference(SKYFIT_EXAMPLES + example.file, {}, Sampling::kPrincipalPlane);
  EXPECT_EQ(sky.quantity, example.quantity);
  EXPECT_EQ(sky.samples.size(), example.samples);
  EXPECT_EQ(sky.scans.size(), example.scans);
  const auto model = make_sky_model("reference", standard_spectral_data(), 1, example.transfer);
  std::size_t used = 0;
  for (const Sample& sample : sky.samples) {
    EXPECT_EQ(sample.weight == 0, !sample.zero_weight_reason.empty());
    if (sample.weight == 0) continue;
    // Every eleventh: a model evaluation each.
    if (used++ % 11 != 0) continue;
    const double expected =
        model_value(*model, sample, sky.quantity, sky.scans[sample.scan].sun_distance_au);
    EXPECT_NEAR(sample.value / expected, 1, example.digits)
        << sample.direction << " at " << sample.wavelength_nm;
  }
  EXPECT_EQ(used, example.used);
}

// Five or four digits, or hundredths of the dimmest 3 kcd/m^2; a sky radiometer has angles to
// 0.01 deg, 0.1 % near the sun; luminances come from rules of
// wavelengths that agree within 0.1 %; the folder's spectra step at the edges of bands,
// and over the 6 deg above the horizon the sky of an image is curved.
INSTANTIATE_TEST_SUITE_P(
    , MeasuredExamples,
    testing::Values(Example{"spectral_scan.csv", Quantity::kSpectralRadiance, 225, 216, 1, 1e-4},
                    Example{"spectral_scan_folder", Quantity::kSpectralRadiance, 183, 183, 1, 0.01},
                    Example{"aeronet_almucantar.csv", Quantity::kSpectralRadiance, 295, 231, 2,
                            1e-4},
                    Example{"aeronet_polarised.csv", Quantity::kSpectralRadiance, 90, 89, 1, 1e-4,
                            Transfer::kVector},
                    Example{"sky_radiometer.dat", Quantity::kSpectralRadiance, 252, 170, 2, 2e-3,
                            Transfer::kVector},
                    Example{"arm_csphotalm.nc", Quantity::kSpectralRadiance, 295, 231, 2, 1e-4},
                    Example{"fisheye.exr", Quantity::kLuminance, 573, 550, 1, 0.03},
                    Example{"sky_scan_145.csv", Quantity::kLuminance, 145, 142, 1, 1e-3},
                    Example{"sky_scan_eko.csv", Quantity::kLuminance, 290, 290, 2, 0.01}),
    [](const auto& test) { return test.param.file.substr(0, test.param.file.find('.')); });

}  // namespace
}  // namespace skyfit::refs
