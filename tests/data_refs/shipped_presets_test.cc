// SPDX-License-Identifier: Apache-2.0
// Every shipped preset is read, survives writing and reading, and has a sky that is finite and not
// negative; Mars has the sky that its landers saw.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/derived.h"
#include "model/atmosphere/preset.h"
#include "model/photometry/photometry.h"
#include "model/registry.h"
#include "model/sky_model.h"

namespace skyfit::refs {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Preset shipped(const std::string& name) { return parse_preset(shipped_preset_json(name), name); }

struct Colour {
  double x, y, luminance;
};

// Of the preset's star on the way through the sky, CIE 1931.
std::vector<Colour> colours(const Atmosphere<double>& atmosphere,
                            const std::vector<SkyPoint>& points) {
  const SpectralData spectra = spectral_data_of(atmosphere);
  const XyzRule rule = xyz_rule(spectra);
  const SkyValues sky =
      make_sky_model("reference", spectra, 2)->radiance(atmosphere, rule.nodes, points, {});
  std::vector<Colour> result;
  for (int i = 0; i < sky.points; ++i) {
    double xyz[3] = {};
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < rule.nodes.size(); ++k)
        xyz[c] += rule.weight[c][k] * sky.at(i, static_cast<int>(k));
    }
    const double sum = xyz[0] + xyz[1] + xyz[2];
    result.push_back({xyz[0] / sum, xyz[1] / sum, xyz[1]});
  }
  return result;
}

SkyPoint toward(double sun_deg, double view_deg, double azimuth_deg) {
  return {0, sun_deg * kDegree, view_deg * kDegree, azimuth_deg * kDegree};
}

class ShippedPreset : public testing::TestWithParam<std::string> {};

TEST_P(ShippedPreset, SurvivesWritingAndReading) {
  const Preset preset = shipped(GetParam());
  EXPECT_EQ(preset.name, GetParam());
  const std::string text = preset_to_json(preset);
  const Preset again = parse_preset(text, "again");
  EXPECT_EQ(again.note, preset.note);
  EXPECT_EQ(preset_to_json(again), text);
}

TEST_P(ShippedPreset, HasASky) {
  const Atmosphere<double> atmosphere = shipped(GetParam()).atmosphere;
  std::vector<SkyPoint> points;
  for (const double sun : {0.0, 60.0, 88.0, 93.0}) {
    for (const double view : {0.0, 60.0, 89.0, 100.0}) {
      for (const double azimuth : {0.0, 180.0}) points.push_back(toward(sun, view, azimuth));
    }
  }
  for (const Colour& c : colours(atmosphere, points)) {
    EXPECT_TRUE(std::isfinite(c.luminance) && c.luminance >= 0) << c.luminance;
    EXPECT_TRUE(c.luminance == 0 || (c.x > 0 && c.y > 0 && c.x + c.y <= 1)) << c.x << " " << c.y;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ShippedPreset, testing::ValuesIn(shipped_preset_names()),
                         [](const auto& row) {
                           std::string name = row.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(Mars, NoonIsYellowishBrown) {
  const Atmosphere<double> mars = shipped("mars").atmosphere;
  const std::vector<Colour> sky =
      colours(mars, {toward(30, 0, 0), toward(30, 60, 180), toward(30, 85, 180)});
  constexpr double kWhiteX = 0.3127, kWhiteY = 0.3290;  // D65
  for (const Colour& c : sky) {
    EXPECT_GT(c.x, kWhiteX + 0.03);
    EXPECT_GT(c.y, kWhiteY + 0.02);
  }
  // "The sky reddens away from the sun and toward the horizon" (Maki et al. 1999).
  EXPECT_GT(sky[1].x, sky[0].x);
  EXPECT_GT(sky[2].x, sky[1].x);
}

TEST(Mars, AureoleOfTheSettingSunIsBlue) {
  const Atmosphere<double> mars = shipped("mars").atmosphere;
  const std::vector<Colour> sky = colours(
      mars, {toward(88, 86, 0), toward(88, 86, 90), toward(88, 86, 180), toward(88, 45, 180)});
  for (std::size_t far = 1; far < sky.size(); ++far) EXPECT_LT(sky[0].x, sky[far].x - 0.05);
  constexpr double kSunX = 0.322;  // above the air: the aureole is bluer than the sun itself
  EXPECT_LT(sky[0].x, kSunX - 0.02);
}

TEST(Mars, DustScattersBlueMoreIntoTheForwardPeakAndLessElsewhere) {
  const Atmosphere<double> mars = shipped("mars").atmosphere;
  const Constituent<double>& dust = mars.at("dust");
  const auto light = [&](double nm, double angle_deg) {
    return dust.albedo_spectrum->at(nm) *
           dust.phase.by_wavelength->at(nm)->phase(angle_deg * kDegree);
  };
  EXPECT_GT(light(450, 1), 1.5 * light(650, 1));
  for (const double angle : {15.0, 60.0, 120.0}) EXPECT_LT(light(450, angle), light(650, angle));
}

TEST(Titan, SunsetAndNoonAreOrange) {
  const Atmosphere<double> titan = shipped("titan").atmosphere;
  for (const Colour& c : colours(titan, {toward(0, 45, 0), toward(60, 0, 0), toward(80, 60, 90)})) {
    EXPECT_GT(c.x, 0.45);
    EXPECT_GT(c.y, 0.36);
  }
}

TEST(EarthAlpine, IsUnderThePressureOfItsHeight) {
  const Atmosphere<double> alpine = shipped("earth-alpine").atmosphere;
  EXPECT_NEAR(alpine.at("rayleigh").site_pressure_hpa, standard_pressure_hpa(2800), 0.5);
}

}  // namespace
}  // namespace skyfit::refs
