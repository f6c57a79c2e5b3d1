// SPDX-License-Identifier: Apache-2.0
// Parameters of other programs: what is written is read back, what a program can hold loses
// nothing, what it cannot hold is refitted and stated, and strangers' files are refused by name and
// field.
#include "tests/fit/exchange.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/exchange/engines.h"
#include "fit/exchange/programs.h"
#include "fit/exchange/reduction.h"
#include "fit/exchange/srgb.h"
#include "model/atmosphere/derived.h"
#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

EngineAtmosphere restricted(const Atmosphere<double>& atmosphere, const Engine& engine) {
  EngineAtmosphere form = engine_atmosphere(engine_form(atmosphere, spectra(), engine.lobe));
  engine.restrict_to(form);
  return form;
}

void expect_near(const Rgb& a, const Rgb& b, std::string_view what) {
  for (std::size_t k = 0; k < 3; ++k)
    // Scripts hold six digits.
    EXPECT_NEAR(a[k], b[k], 2e-5 * std::abs(b[k]) + 1e-15) << what << " " << k;
}

class Engines : public ::testing::TestWithParam<std::string_view> {};

TEST_P(Engines, ReadsWhatItWrites) {
  const Engine& engine = engine_named(GetParam());
  for (const char* name : {"earth-clear", "earth-alpine", "hillaire-2020"}) {
    const EngineAtmosphere written = restricted(shipped(name), engine);
    const std::string text = engine.write(written, {name, "", 0.5, 1, {}});
    ASSERT_NE(program_of(text), nullptr);
    EXPECT_EQ(program_of(text)->name, engine.name);
    std::vector<std::string> notes;
    const auto read = engine.read(text, "file", notes);
    ASSERT_TRUE(read);
    EXPECT_TRUE(notes.empty());
    expect_near(read->rayleigh_scattering, written.rayleigh_scattering, "rayleigh");
    expect_near(read->mie_scattering, written.mie_scattering, "mie");
    expect_near(read->mie_absorption, written.mie_absorption, "mie absorption");
    EXPECT_NEAR(read->rayleigh_scale_height_m, written.rayleigh_scale_height_m, 1e-3);
    EXPECT_NEAR(read->mie_scale_height_m, written.mie_scale_height_m, 1e-3);
    EXPECT_NEAR(read->g, written.g, 1e-5);
    EXPECT_EQ(read->lobe, written.lobe);
    expect_near(read->absorption, written.absorption, "absorption");
  }
}

std::vector<std::string_view> names() {
  std::vector<std::string_view> list;
  for (const Engine& engine : engines()) list.push_back(engine.name);
  return list;
}

INSTANTIATE_TEST_SUITE_P(All, Engines, ::testing::ValuesIn(names()));

TEST(Exchange, NothingIsLostWhereTheFormIsTheSame) {
  const Atmosphere<double> a = shipped("hillaire-2020");
  const Atmosphere<double> back = atmosphere_of(restricted(a, engine_named("bruneton")));
  const SkyLoss loss = sky_loss(kScalarTruth, spectra(), a, back);
  EXPECT_LT(std::abs(loss.worst_percent), 0.05);
  EXPECT_LT(loss.worst_uv, 1e-4);
}

TEST(Exchange, WhatAProgramCannotHoldIsRefitted) {
  const Atmosphere<double> a = shipped("earth-hazy");
  const Engine& engine = engine_named("unreal");
  const Atmosphere<double> start = atmosphere_of(restricted(a, engine));
  const Atmosphere<double> better =
      refitted(kScalarTruth, spectra(), a, start, engine.free(), [](double) {});
  const double before = sky_loss(kScalarTruth, spectra(), a, start).rms_percent,
               after = sky_loss(kScalarTruth, spectra(), a, better).rms_percent;
  std::printf("[   loss ] %.2f %% before, %.2f %% after\n", before, after);
  EXPECT_LT(after, 0.8 * before);
  EXPECT_EQ(engine_atmosphere(better).lobe, PhaseType::kHenyeyGreenstein);
}

TEST(Exchange, AirWithoutAerosolHasNone) {
  Atmosphere<double> air = shipped("earth-clear");
  std::erase_if(air.constituents, [](const auto& c) { return c.name == "mie"; });
  for (const Engine& engine : engines()) {
    const std::string text = engine.write(restricted(air, engine), {"air", "", 0.5, 1, {}});
    std::vector<std::string> notes;
    const Atmosphere<double> back = atmosphere_of(*engine.read(text, "file", notes));
    EXPECT_EQ(back.find("mie"), nullptr) << engine.name;
    validate(back);
  }
}

TEST(Exchange, UnrealsDefaultsAreHillaires) {
  std::vector<std::string> notes;
  const auto read = engine_named("unreal").read(
      R"({"SkyAtmosphere": {"MultiScatteringFactor": 0.5}})", "sky.json", notes);
  ASSERT_TRUE(read);
  expect_near(read->rayleigh_scattering, {5.802e-6, 13.558e-6, 33.1e-6}, "rayleigh");
  EXPECT_THAT(notes, ::testing::Contains(HasSubstr("MultiScatteringFactor")));
}

TEST(Exchange, StrangersFilesAreRefusedByField) {
  std::vector<std::string> notes;
  EXPECT_THAT(
      [&] {
        engine_named("unreal").read("{\"SkyAtmosphere\":\n{\"MieAnisotropy\": -2}}", "a.json",
                                    notes);
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("a.json:2: SkyAtmosphere.MieAnisotropy")));
  EXPECT_THAT(
      [&] {
        engine_named("unity").read(R"({"PhysicallyBasedSky": {"airDensityR": 1}})", "b.json",
                                   notes);
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("airDensityR")));
  EXPECT_THAT(
      [&] {
        engine_named("blender").read("air_density = 1\ndust_density = 11\nozone_density = 1\n",
                                     "c.py", notes);
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("c.py:2: dust_density = 11")));
  const auto blender = [&](const std::string& air) {
    return engine_named("blender").read(air + "\nsky.dust_density = 1\nsky.ozone_density = 1\n",
                                        "d.py", notes);
  };
  EXPECT_NEAR(blender("# sky.air_density = 9\nsky.air_density = 3\nsky.air_density = 2")
                  ->rayleigh_scattering[1],
              2 * 1.237e-5, 1e-9);
  for (const char* wrong : {"sky.air_density = 1+1", "sky.air_density = x", "other = 1"}) {
    EXPECT_THAT([&] { blender(wrong); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("air_density")))
        << wrong;
  }
  EXPECT_EQ(program_of("{\"skyfit_preset\": 2}"), nullptr);
  EXPECT_THAT([] { program_named("quake"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("unreal, unity")));
}

// A property of a .tres, or a channel of its colour.
double godot_value(const std::string& text, const std::string& name, std::size_t channel = 0) {
  const std::size_t at = text.find("\n" + name + " = ");
  EXPECT_NE(at, text.npos) << name;
  std::string value =
      text.substr(at + name.size() + 4, text.find('\n', at + 1) - at - name.size() - 4);
  if (!value.starts_with("Color(")) return std::stod(value);
  double rgb[3];
  EXPECT_EQ(std::sscanf(value.c_str(), "Color(%lf, %lf, %lf", &rgb[0], &rgb[1], &rgb[2]), 3);
  const double v = rgb[channel];  // sRGB (IEC 61966-2-1), which Godot makes linear
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// The engine's formula, from the numbers in the file, has the loss that the file states.
TEST(Godot, PropertiesGiveTheSkyWithinTheLoss) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  const double zenith = 0.7;
  const Exported written = exported(preset, "godot", zenith, 1);
  const std::string& text = written.files.at(0).text;
  const XyzRule rule = xyz_rule(spectra());
  const double beam =
      irradiance_color(scalar().irradiance(preset.atmosphere, rule.nodes, 0, zenith, {}),
                       kDirectNormal, rule, std::vector<double>(rule.nodes.size(), 1))[1];
  const std::vector<SkyPoint> points = six_skies();
  const double g = godot_value(text, "mie_eccentricity");
  std::vector<Xyz> shown;
  for (const SkyPoint& p : points) {
    Rgb rgb{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double r = 1e-4 * godot_value(text, "rayleigh_coefficient") *
                       godot_value(text, "rayleigh_color", k),
                   m = 4.34e-4 * godot_value(text, "turbidity") *
                       godot_value(text, "mie_coefficient") * godot_value(text, "mie_color", k);
      const double c = std::cos(p.view_zenith), nu = std::cos(angle_from_sun(p)),
                   mass = 1 / (c + 0.15 * std::pow(3.885 + 54.5 * c, -1.253)),
                   through = std::exp(-(r * 8.4e3 + m * 1.25e3) * mass),
                   energy = 0.757 * std::cos(p.sun_zenith);
      const double in =
          energy *
          (r * 3 / (16 * std::numbers::pi) * (1 + std::pow(nu / 2 + 0.5, 2)) +
           m * (1 - g * g) / (4 * std::numbers::pi) * std::pow(1 + g * g - 2 * g * nu, -1.5)) /
          (r + m);
      const double low = std::pow(1 - std::cos(p.sun_zenith), 5);
      const double light =
          std::pow(in * (1 - through), 1.5) * std::lerp(1.0, std::sqrt(in * through), low);
      rgb[k] = godot_value(text, "energy_multiplier") * std::pow(light, 1 / 2.4) * beam /
               std::numbers::pi;
    }
    shown.push_back(xyz_of_srgb(rgb));
  }
  const SkyLoss loss =
      color_loss(points, sky_colors(scalar(), rule, preset.atmosphere, points), shown);
  EXPECT_EQ(loss_text(loss), written.loss);
  EXPECT_LT(loss.rms_percent, 40);
}

// The uniform that a line of the .js sets.
double threejs_value(const std::string& text, const std::string& name) {
  const std::string before = "uniforms['" + name + "'].value = ";
  const std::size_t at = text.find(before);
  EXPECT_NE(at, text.npos) << name;
  return std::stod(text.substr(at + before.size()));
}

// Sky.js, from the uniforms in the file, has the loss that the file states.
TEST(Threejs, UniformsGiveTheSkyWithinTheLoss) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  const Exported written = exported(preset, "threejs", 0.7, 1);
  const std::string& text = written.files.at(0).text;
  const double rayleigh = threejs_value(text, "rayleigh"),
               mie = threejs_value(text, "turbidity") * threejs_value(text, "mieCoefficient"),
               g = threejs_value(text, "mieDirectionalG");
  const std::size_t unit = text.find("mapping, is ");
  ASSERT_NE(unit, text.npos);
  const double brightness = std::stod(text.substr(unit + 12));
  constexpr double kPi = std::numbers::pi, kLambda[] = {680e-9, 550e-9, 450e-9},
                   kRayleigh[] = {5.8045e-6, 1.35629e-5, 3.02659e-5}, kK[] = {0.686, 0.678, 0.666},
                   kNight[] = {0, 0.0003, 0.00075};
  const std::vector<SkyPoint> points = six_skies();
  std::vector<Xyz> shown;
  for (const SkyPoint& p : points) {
    const double zenith_deg = p.view_zenith * 180 / kPi, nu = std::cos(angle_from_sun(p)),
                 mass =
                     1 / (std::cos(p.view_zenith) + 0.15 * std::pow(93.885 - zenith_deg, -1.253)),
                 sun = 1000 * std::max(0.0, 1 - std::exp((p.sun_zenith - kPi / 1.95) / 1.5)),
                 low = std::pow(1 - std::cos(p.sun_zenith), 5);
    Rgb rgb{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double r = rayleigh * kRayleigh[k],
                   m = 0.434 * 0.2e-17 * mie * kPi * std::pow(2 * kPi / kLambda[k], 2) * kK[k],
                   through = std::exp(-(r * 8.4e3 + m * 1.25e3) * mass);
      const double in = sun *
                        (r * 3 / (16 * kPi) * (1 + std::pow(nu / 2 + 0.5, 2)) +
                         m * (1 - g * g) / (4 * kPi) * std::pow(1 + g * g - 2 * g * nu, -1.5)) /
                        (r + m);
      const double light =
          std::pow(in * (1 - through), 1.5) * std::lerp(1.0, std::sqrt(in * through), low);
      rgb[k] = brightness * std::pow((light + 0.1 * through) * 0.04 + kNight[k], 1 / 2.4);
    }
    shown.push_back(xyz_of_srgb(rgb));
  }
  const SkyLoss loss = color_loss(
      points, sky_colors(scalar(), xyz_rule(spectra()), preset.atmosphere, points), shown);
  double rms = 0;
  ASSERT_EQ(std::sscanf(written.loss.c_str(), "luminance RMS %lf %%", &rms), 1) << written.loss;
  EXPECT_NEAR(loss.rms_percent, rms, 0.05);
  EXPECT_LT(rms, 30);

  std::vector<std::string> notes;
  ASSERT_TRUE(read_threejs(text, "sky.js", notes));
  EXPECT_THAT(notes, ::testing::Contains(HasSubstr("another sky")));
}

}  // namespace
}  // namespace skyfit::fit
