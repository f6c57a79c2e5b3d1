// SPDX-License-Identifier: Apache-2.0
// Particles in an atmosphere: optical depth and albedo follow from volume, sizes and index, however
// the amount is stated; presets keep them; radiances have exact derivatives by all their
// parameters.
#include "model/atmosphere/size_distribution.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data_refs/spectra.h"
#include "model/atmosphere/derived.h"
#include "model/atmosphere/parameters.h"
#include "model/atmosphere/preset.h"
#include "model/registry.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::string document(const std::string& amount, const std::string& particles) {
  return R"({"skyfit_preset": 2, "name": "particles",
    "planet": {"bottom_radius_m": 6360000, "top_radius_m": 6460000}, "ground": {"albedo": 0.15},
    "constituents": [
      {"name": "rayleigh", "rayleigh": {"kind": "bodhaine-1999", "pressure_hpa": 1013.25},
       "profile": {"type": "exponential", "scale_height_m": 8000}},
      {"name": "fine", )" +
         amount + R"(, "profile": {"type": "exponential", "scale_height_m": 1500},
       "phase": {"type": "size-distribution", "median_radius_um": 0.16, "width": 0.5, )" +
         particles + "}}]}";
}
const std::string kVolume = R"("volume_um3_per_um2": 0.04)";
const std::string kIndex = R"("refractive_index": {"real": 1.45, "imaginary": 0.008})";

Atmosphere<double> atmosphere(const std::string& amount, const std::string& particles) {
  return parse_preset(document(amount, particles), "p.json").atmosphere;
}

std::string message_of(const std::string& amount, const std::string& particles) {
  try {
    atmosphere(amount, particles);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

double depth(const Atmosphere<double>& a, double nm) {
  return vertical_optical_depth(a, a.at("fine"), {nm, 0});
}

TEST(SizeDistribution, DepthIsTheVolumeTimesTheExtinctionOfItsSpheres) {
  const Atmosphere<double> a = atmosphere(kVolume, kIndex);
  for (const double nm : {400.0, 550.0, 870.0}) {
    const auto optics = ParticleTables().optics({nm, 0.16, 0.5, {1.45, 0.008}}, false);
    EXPECT_DOUBLE_EQ(depth(a, nm), 0.04 * optics->extinction[0]);
  }
  const auto green = ParticleTables().optics({550, 0.16, 0.5, {1.45, 0.008}}, false);
  EXPECT_DOUBLE_EQ(single_scattering_albedo(a.at("fine")),
                   green->scattering[0] / green->extinction[0]);
  EXPECT_DOUBLE_EQ(mean_cosine(a.at("fine").phase), green->moment(1)[0]);
  EXPECT_GT(angstrom_exponent(a.at("fine")), 1);
}

TEST(SizeDistribution, MayBeStatedByAnOpticalDepthOrACoefficient) {
  const Atmosphere<double> volume = atmosphere(kVolume, kIndex);
  const double tau = depth(volume, 500), ssa = single_scattering_albedo(volume.at("fine"));
  const Atmosphere<double> by_depth = atmosphere(
      fmt::format(R"("optical_depth": {{"wavelength_nm": 500, "value": {:.17g}}})", tau), kIndex);
  const Atmosphere<double> by_scattering =
      atmosphere(fmt::format(R"("scattering_per_m": {{"wavelength_nm": 550, "value": {:.17g}}})",
                             depth(volume, 550) * ssa / 1500),
                 kIndex);
  constexpr double kRounding = 1e-12;
  for (const double nm : {420.0, 700.0}) {
    EXPECT_NEAR(depth(by_depth, nm) / depth(volume, nm), 1, kRounding);
    EXPECT_NEAR(depth(by_scattering, nm) / depth(volume, nm), 1, kRounding);
  }
}

TEST(SizeDistribution, MaterialsHaveTheirPublishedIndices) {
  for (const Material& material : materials()) {
    const auto index = index_of_material(material.name);
    ASSERT_NE(index, nullptr);
    EXPECT_EQ(index->material(), material.name);
  }
  EXPECT_EQ(index_of_material("water")->at(550), std::complex<double>(1.333, 1.96e-9));
  EXPECT_EQ(index_of_material("soot")->at(550), std::complex<double>(1.75, 0.44));
  EXPECT_NEAR(index_of_material("dust")->at(555).imag(), 0.00195, 1e-12);  // half-way
  EXPECT_EQ(index_of_material("dust")->at(300).imag(), 0.0025);
  EXPECT_EQ(index_of_material("snow"), nullptr);
}

TEST(SizeDistribution, OfPresetsIsKept) {
  for (const std::string& particles :
       {kIndex, std::string(R"("material": "sea-salt")"),
        std::string(R"("refractive_index": {"wavelength_nm": [400, 700], "real": [1.5, 1.48],
                       "imaginary": [0.01, 0.002]})")}) {
    for (const std::string& amount :
         {kVolume, std::string(R"("optical_depth": {"wavelength_nm": 550, "value": 0.1})")}) {
      const Preset preset = parse_preset(document(amount, particles), "p.json");
      const std::string written = preset_to_json(preset);
      const Preset again = parse_preset(written, "again.json");
      EXPECT_EQ(again.atmosphere, preset.atmosphere);
      EXPECT_EQ(preset_to_json(again), written);
    }
  }
}

TEST(SizeDistribution, ComplaintsNameTheField) {
  EXPECT_EQ(message_of(kVolume, R"("material": "snow")"),
            "p.json:7: constituents[1].phase.material = \"snow\": expected one of sulphate, "
            "sulphuric-acid, soot, dust, sea-salt, water");
  EXPECT_NE(message_of(kVolume, R"("material": "dust", )" + kIndex).find("refractive_index"),
            std::string::npos);
  EXPECT_NE(message_of(kVolume + R"(, "single_scattering_albedo": 0.9)", kIndex)
                .find("single_scattering_albedo = 0.9: expected none beside"),
            std::string::npos);
  EXPECT_NE(
      message_of(R"("optical_depth": {"wavelength_nm": 550, "value": 0.1, "exponent": 1})", kIndex)
          .find("exponent = 1"),
      std::string::npos);
  EXPECT_NE(message_of(kVolume, R"("refractive_index": {"real": 0.5, "imaginary": 0})")
                .find("fine.phase.refractive_index.real = 0.5: expected"),
            std::string::npos);
  EXPECT_NE(message_of(kVolume, R"("refractive_index": {"real": 1, "imaginary": 0})")
                .find("fine.phase.refractive_index.real = 1: expected an index that differs"),
            std::string::npos);
  Atmosphere<double> large = atmosphere(kVolume, kIndex);
  large.at("fine").phase.particles.radius_um = 100;
  EXPECT_THROW(validate(large), std::invalid_argument);
  Atmosphere<double> lobe = atmosphere(kVolume, kIndex);
  lobe.at("fine").phase = {};
  EXPECT_THROW(validate(lobe), std::invalid_argument);
}

TEST(SizeDistribution, ParametersAreThoseOfParticles) {
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters_of(atmosphere(kVolume, kIndex)))
    names.push_back(parameter.name());
  const std::vector<std::string> expected = {
      "rayleigh.pressure", "rayleigh.scale_height", "fine.volume",
      "fine.scale_height", "fine.radius",           "fine.width",
      "fine.index.real",   "fine.index.imaginary",  "ground.albedo"};
  EXPECT_EQ(names, expected);
  EXPECT_FALSE(
      has_parameter(atmosphere(kVolume, R"("material": "dust")"), {"fine", Quantity::kIndexReal}));
}

TEST(SizeDistribution, RadiancesHaveExactDerivatives) {
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  const std::vector<WavelengthNode> nodes =
      spectral_nodes(refs::standard_spectral_data(), {460, 640});
  std::vector<SkyPoint> points;
  for (const double sun : {35.0, 80.0}) {
    for (const double view : {20.0, 75.0})
      points.push_back({0, sun * kDegree, view * kDegree, 1.0});
  }
  const Atmosphere<double> a = atmosphere(kVolume, kIndex);
  const std::vector<Parameter> parameters = {{"fine", Quantity::kVolume},
                                             {"fine", Quantity::kRadius},
                                             {"fine", Quantity::kWidth},
                                             {"fine", Quantity::kIndexReal},
                                             {"fine", Quantity::kIndexImaginary}};
  const SkyValues exact = model->radiance(a, nodes, points, parameters);
  for (int k = 0; k < static_cast<int>(parameters.size()); ++k) {
    const Parameter& parameter = parameters[static_cast<std::size_t>(k)];
    const double value = get_parameter(a, parameter), step = 1e-3 * value;
    const auto at = [&](double changed) {
      Atmosphere<double> b = a;
      set_parameter(b, parameter, changed);
      return model->radiance(b, nodes, points, {});
    };
    const SkyValues more = at(value + step), less = at(value - step);
    for (int p = 0; p < exact.points; ++p) {
      for (int w = 0; w < exact.wavelengths; ++w) {
        const double slope = (more.at(p, w) - less.at(p, w)) / (2 * step);
        constexpr double kDifference = 2e-3;  // the step, and single precision of other indices
        EXPECT_NEAR(exact.derivative_at(k, p, w), slope,
                    kDifference * std::abs(slope) + 1e-4 * exact.at(p, w) / value)
            << parameter.name() << " at point " << p;
      }
    }
  }
}

}  // namespace
}  // namespace skyfit
