// SPDX-License-Identifier: Apache-2.0
// The luminance of the zenith with the sun at 60 degrees, from the installed package.
#include <skyfit/data_refs/references.h>
#include <skyfit/data_refs/spectra.h>
#include <skyfit/fit/fit.h>
#include <skyfit/model/registry.h>
#include <skyfit/model/version.h>

#include <cstdio>

int main() {
  const auto preset =
      skyfit::parse_preset(skyfit::refs::shipped_preset_json("earth-clear"), "earth-clear");
  const auto rule = skyfit::luminance_rule(skyfit::refs::standard_spectral_data());
  const skyfit::SkyPoint zenith{.sun_zenith = 1.0471975511965976};
  const auto model = skyfit::make_sky_model("reference", skyfit::refs::standard_spectral_data(), 1);
  const auto sky = model->radiance(preset.atmosphere, rule.nodes, {&zenith, 1}, {});
  double luminance_cd_m2 = 0;
  for (int k = 0; k < sky.wavelengths; ++k) luminance_cd_m2 += rule.weight[k] * sky.at(0, k);
  skyfit::fit::validate(skyfit::fit::FitOptions{});
  std::printf("%s %s %.9g cd/m^2\n", preset.name.c_str(), skyfit::kVersion, luminance_cd_m2);
}
