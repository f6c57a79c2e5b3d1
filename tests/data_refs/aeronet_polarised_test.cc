// SPDX-License-Identifier: Apache-2.0
// Of three radiances through polarisers 60 deg apart, P_k = I + Q cos 2a_k + U sin 2a_k, the mean
// is I, and sqrt(Q^2 + U^2) / I is the stated degree; every fault is one line.
#include "data_refs/aeronet_polarised.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "complaint.h"
#include "data_refs/measured_formats.h"
#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/preset.h"
#include "model/numerics/angles.h"
#include "model/registry.h"
#include "model/sky_model.h"

namespace skyfit::refs {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string kHead =
    "AERONET Version 3;\nAERONET_Site,Date(dd:mm:yyyy),Time(hh:mm:ss),Nominal_Wavelength(nm),"
    "Solar_Zenith_Angle(Degrees),Sky_Scan_Type";

std::string columns(const std::string& names) {
  std::string text;
  for (const std::string quantity : {"Degree_of_Polarization", "P1_Radiance", "P2_Radiance",
                                     "P3_Radiance", "Scattering_Angle"}) {
    if (names.find(quantity.substr(0, 2)) == names.npos) continue;
    for (const std::string angle : {"-90", "90"})
      text += "," + quantity + "_for_Azimuth_Angle_in_Degrees_" + angle;
  }
  return text + "\n";
}

// Q / I = 0.3, U / I = 0.4, polarisers from 0 deg on.
constexpr double kRadiance = 10, kQ = 3, kU = 4;
std::string through(int polariser) {
  const double twice = 2 * 60 * polariser * kRadiansPerDegree;
  return std::to_string(kRadiance + kQ * std::cos(twice) + kU * std::sin(twice));
}

std::string line(const std::string& degrees, const std::string& type = "Almucantar",
                 const std::string& first = through(0)) {
  std::string text =
      "Site,03:01:2019,11:11:49,440,60," + type + "," + degrees + "," + first + "," + through(0);
  for (const int polariser : {1, 2}) text += "," + through(polariser) + "," + through(polariser);
  return text + ",75,75\n";
}

Reference parse(const std::string& text) { return parse_aeronet_polarised(text, "sky.alp", {}); }
std::string complaint(const std::string& text) {
  return complaint_of([&] { parse(text); });
}
const std::string kAll = kHead + columns("De P1 P2 P3 Sc");

TEST(AeronetPolarised, TheMeanOfTheThreeIsTheRadiance) {
  for (const std::string degrees : {"0.5,0.52", "50,52"}) {  // a fraction or percent
    const Reference sky = parse(kAll + line(degrees));
    ASSERT_EQ(sky.samples.size(), 2u);
    const Sample& sample = sky.samples[0];
    EXPECT_NEAR(sample.value, 0.01 * kRadiance, 1e-8);  // of uW cm-2 sr-1 nm-1
    EXPECT_NEAR(sample.relative_azimuth, -90 * kRadiansPerDegree, 1e-12);
    EXPECT_NEAR(sample.view_zenith, 60 * kRadiansPerDegree, 1e-12);
    ASSERT_EQ(sample.polarisation.size(), 1u);
    EXPECT_EQ(sample.polarisation[0].what, Polarisation::kDegree);
    EXPECT_NEAR(sample.polarisation[0].value, 0.5, 1e-12);
    EXPECT_NEAR(sky.samples[1].polarisation[0].value, 0.52, 1e-12);
    EXPECT_THAT(sky.notes, testing::Contains(HasSubstr("--scale profiled")));
  }
}

TEST(AeronetPolarised, ADegreeThatTheThreeDoNotHaveIsNotUsed) {
  const Reference sky = parse(kAll + line("0.4,0.5"));
  EXPECT_EQ(sky.samples[0].zero_weight_reason,
            "degree of polarisation is not that of P1, P2 and P3");
  EXPECT_EQ(sky.samples[1].zero_weight_reason, "");
}

TEST(AeronetPolarised, WhatIsMissingIsLeftOut) {
  const Reference sky = parse(kAll + line("0.5,-999", "Almucantar", "-999"));
  EXPECT_EQ(sky.samples[0].zero_weight_reason, "missing");
  EXPECT_TRUE(sky.samples[1].polarisation.empty());
  EXPECT_GT(sky.samples[1].weight, 0);
}

TEST(AeronetPolarised, FaultsNameLineAndColumn) {
  EXPECT_THAT(complaint(kHead + columns("De P1 P3") + line("0.5,0.5")),
              StartsWith("sky.alp:2: expected a column P2_Radiance_for_Azimuth_Angle.._-90"));
  EXPECT_THAT(complaint(kHead + columns("P1 P2 P3") + line("0.5,0.5")),
              StartsWith("sky.alp:2: expected columns Degree_of_Polarization_for_Azimuth_Angle"));
  EXPECT_EQ(complaint(kAll + line("0.5,0.5", "Principal Plane")),
            "sky.alp:3: Sky_Scan_Type = \"Principal Plane\": expected an almucantar");
  EXPECT_THAT(complaint(kAll + line("0.5,high")), HasSubstr("\"high\": expected a number"));
  EXPECT_EQ(complaint(kAll + "Site,03:01:2019,11:11:49,440,60,Almucantar,0.5\n"),
            "sky.alp:3: expected 14 fields, got 7");
}

// Titles above the names, as in the example; measured_examples_test.cc has its radiances.
TEST(AeronetPolarised, TheExampleHoldsTheDegreesItSays) {
  const Reference sky =
      load_measured_sky(std::string(SKYFIT_EXAMPLES) + "aeronet_polarised.csv", {});
  ASSERT_EQ(sky.samples.size(), 90u);
  const auto model = make_sky_model("reference", standard_spectral_data(), 1, Transfer::kVector);
  const Preset preset = parse_preset(shipped_preset_json("earth-clear"), "earth-clear");
  for (std::size_t i = 0; i < sky.samples.size(); i += 13) {
    const Sample& sample = sky.samples[i];
    const SkyPoint point{0, sample.sun_zenith, sample.view_zenith, sample.relative_azimuth};
    const StokesValues stokes = model->stokes(
        preset.atmosphere, spectral_nodes(standard_spectral_data(), {sample.wavelength_nm}),
        {&point, 1}, {});
    ASSERT_EQ(sample.polarisation.size(), 1u);
    EXPECT_NEAR(sample.polarisation[0].value,
                std::hypot(stokes.q.at(0, 0), stokes.u.at(0, 0)) / stokes.i.at(0, 0), 1e-5);
  }
}

}  // namespace
}  // namespace skyfit::refs
