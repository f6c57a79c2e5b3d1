// SPDX-License-Identifier: Apache-2.0
// A ground with a spectrum: the sky over it at a wavelength is that over a grey ground of the
// albedo there, its derivative that times the shape; a preset keeps it.
#include <gtest/gtest.h>

#include <memory>

#include "model/atmosphere/preset.h"
#include "model/solver/reference_model.h"

namespace skyfit {
namespace {

std::shared_ptr<const GroundSpectrum> red_edge() {
  return std::make_shared<const GroundSpectrum>(TwoColumns{{400, 550, 700, 750}, {2, 4, 4, 20}});
}

TEST(GroundSpectrumTest, IsScaledToOneAt550AndConstantBeyondTheEnds) {
  const auto shape = red_edge();
  EXPECT_DOUBLE_EQ(shape->at(550), 1);
  EXPECT_DOUBLE_EQ(shape->at(725), 3);
  EXPECT_DOUBLE_EQ(shape->at(300), 0.5);
  EXPECT_DOUBLE_EQ(shape->at(900), 5);
  EXPECT_THROW(GroundSpectrum(TwoColumns{{400, 700}, {0, 0}}), std::invalid_argument);
  EXPECT_THROW(GroundSpectrum(TwoColumns{{400, 300}, {1, 1}}), std::invalid_argument);
}

TEST(GroundSpectrumTest, SkyIsThatOverAGreyGroundOfTheAlbedoThere) {
  const ReferenceModel model(ReferenceOptions{});
  const std::vector<WavelengthNode> at = {{750, 0}};
  const std::vector<SkyPoint> points = {{0, 0.8, 0.9, 0.5}};
  const std::vector<Parameter> albedo = {Parameter::kGroundAlbedo};
  Atmosphere<double> colored, grey;
  colored.ground_albedo = 0.1;
  colored.ground_spectrum = red_edge();
  grey.ground_albedo = 0.5;
  const SkyValues a = model.radiance(colored, at, points, albedo);
  const SkyValues b = model.radiance(grey, at, points, albedo);
  EXPECT_DOUBLE_EQ(a.at(0, 0), b.at(0, 0));
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(a.derivative_at(0, 0, 0) / (5 * b.derivative_at(0, 0, 0)), 1, kRounding);
}

// 0.4 times 5 would be 2: it stays at 1, where no change of the parameter moves it.
TEST(GroundSpectrumTest, AlbedoStaysAtOne) {
  Atmosphere<double> a;
  a.ground_albedo = 0.4;
  a.ground_spectrum = red_edge();
  EXPECT_EQ(ground_albedo_at(a, 750), 1);
  EXPECT_DOUBLE_EQ(ground_albedo_at(a, 550), 0.4);
}

TEST(GroundSpectrumTest, PresetKeepsIt) {
  Preset preset;
  preset.name = "meadow";
  preset.atmosphere.ground_spectrum = red_edge();
  const Preset again = parse_preset(preset_to_json(preset), "meadow.json");
  ASSERT_NE(again.atmosphere.ground_spectrum, nullptr);
  EXPECT_EQ(again.atmosphere.ground_spectrum->table(), preset.atmosphere.ground_spectrum->table());
}

}  // namespace
}  // namespace skyfit
