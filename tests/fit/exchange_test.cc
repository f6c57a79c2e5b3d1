// SPDX-License-Identifier: Apache-2.0
// Parameters of other programs: what is written is read back, what a program can hold loses
// nothing, what it cannot hold is refitted and stated, and strangers' files are refused by name and
// field.
#include "tests/fit/exchange.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "fit/exchange/engines.h"
#include "fit/exchange/programs.h"
#include "fit/exchange/reduction.h"
#include "model/atmosphere/derived.h"
#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

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

// Of both versions' names; values of another kind of sky are not taken for this one's.
TEST(Exchange, BlendersSkiesAreToldByTheirType) {
  const auto densities = [](std::string_view type, std::string_view dust) {
    return fmt::format(
        "sky.sky_type = \"{}\"\nsky.air_density = 2\nsky.{} = 3\n"
        "sky.ozone_density = 1\n",
        type, dust);
  };
  struct Case {
    std::string text;
    std::string_view program;
    double dust;  // 1/m at 550 nm for a density of 1
  };
  for (const Case& c :
       {Case{densities("NISHITA", "dust_density"), "blender", 2e-5},
        {densities("SINGLE_SCATTERING", "aerosol_density"), "blender", 2e-5},
        {densities("MULTIPLE_SCATTERING", "aerosol_density"), "blender-multiple", 2.478e-5}}) {
    const Program* program = program_of(c.text);
    ASSERT_NE(program, nullptr) << c.text;
    EXPECT_EQ(program->name, c.program);
    std::vector<std::string> notes;
    EXPECT_NEAR(engine_named(c.program).read(c.text, "a.py", notes)->mie_scattering[1], 3 * c.dust,
                1e-9);
    EXPECT_TRUE(notes.empty());
  }
}

// As the editor copies it: what differs from the defaults, among other things of the actor.
TEST(Exchange, UnrealsCopiedTextIsRead) {
  const std::string text =
      "Begin Map\n"
      "   Begin Actor Class=/Script/Engine.SkyAtmosphere Name=SkyAtmosphere_0\n"
      "      Begin Object Name=\"SkyAtmosphereComponent\"\n"
      "         MieScatteringScale=0.008000\n"
      "         RayleighScattering=(R=0.200000,G=0.400000,B=1.000000,A=1.000000)\n"
      "         GroundAlbedo=(B=0,G=108,R=255,A=255)\n"
      "         OtherTentDistribution=(TipAltitude=20.0,TipValue=0.5,Width=10.0)\n"
      "         RelativeLocation=(X=0.000000,Y=0.000000,Z=150.000000)\n"
      "         MieAnisotropy=0.700000\n"
      "      End Object\n   End Actor\nEnd Map\n";
  ASSERT_NE(program_of(text), nullptr);
  EXPECT_EQ(program_of(text)->name, "unreal");
  std::vector<std::string> notes;
  const auto read = engine_named("unreal").read(text, "sky.t3d", notes);
  ASSERT_TRUE(read);
  EXPECT_TRUE(notes.empty());
  expect_near(read->rayleigh_scattering, {6.62e-6, 13.24e-6, 33.1e-6}, "rayleigh");
  expect_near(read->mie_scattering, {8e-6, 8e-6, 8e-6}, "mie");
  EXPECT_NEAR(read->ground_albedo[0], 1, 1e-12);
  EXPECT_NEAR(read->ground_albedo[1], 0.15, 1e-3);
  EXPECT_EQ(read->ground_albedo[2], 0);
  EXPECT_NEAR(read->absorption[1], 0.5 * 1.881e-6, 1e-12);
  EXPECT_EQ(read->tent_half_width_m, 10e3);
  EXPECT_EQ(read->g, 0.7);
  std::string wrong = text;
  wrong.replace(wrong.find("0.008000"), 8, "thick");
  EXPECT_THAT([&] { engine_named("unreal").read(wrong, "sky.t3d", notes); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("sky.t3d:4: SkyAtmosphere.MieScatteringScale = \"thick\"")));
}

// Model takes increasing wavelengths, of any number.
TEST(Exchange, BrunetonsSpectraAreInIncreasingOrder) {
  const Engine& engine = engine_named("bruneton");
  const EngineAtmosphere written = restricted(shipped("earth-clear"), engine);
  std::string text = engine.write(written, {"earth-clear", "", 0.5, 1, {}});
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json.at("wavelengths"), (std::vector<double>{440, 550, 680}));
  EXPECT_GT(json.at("rayleigh_scattering").at(0), json.at("rayleigh_scattering").at(2));
  const auto changed = [&](const char* field, const nlohmann::json& value) {
    auto other = json;
    other[field] = value;
    std::vector<std::string> notes;
    return engine.read(other.dump(), "a.json", notes);
  };
  auto more = json;
  more["wavelengths"] = {400, 500, 600, 700};
  for (const char* field : {"rayleigh_scattering", "mie_scattering", "mie_extinction",
                            "absorption_extinction", "ground_albedo"})
    more[field] = {4e-6, 3e-6, 2e-6, 1e-6};
  std::vector<std::string> notes;
  expect_near(engine.read(more.dump(), "a.json", notes)->rayleigh_scattering,
              {1.2e-6, 2.5e-6, 3.6e-6}, "four wavelengths");
  EXPECT_THAT(
      [&] {
        changed("wavelengths", {680, 550, 440});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("increasing numbers")));
  EXPECT_THAT(
      [&] {
        changed("mie_scattering", {1e-6, 1e-6});
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("3 numbers")));
  EXPECT_THAT([&] { changed("mie_densty", 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("mie_densty")));
  auto steep = json.at("absorption_density");
  steep[1]["linear_term"] = 2 * steep[1]["linear_term"].get<double>();
  EXPECT_THAT([&] { changed("absorption_density", steep); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("falls as steeply")));
  auto layers = json.at("mie_density");
  layers.insert(layers.begin(), layers[0]);
  layers[0]["width"] = 2000;
  EXPECT_THAT([&] { changed("mie_density", layers); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("one layer")));
}

// Of the types for the Earth the air is the program's own; ozone in a tent.
TEST(Exchange, UnitysTypesAreObeyed) {
  std::vector<std::string> notes;
  const auto read = [&](const std::string& fields) {
    notes.clear();
    return *engine_named("unity").read("{\"PhysicallyBasedSky\": {" + fields + "}}", "b.json",
                                       notes);
  };
  const EngineAtmosphere own = read(R"("type": "Custom", "airDensityG": 0.5)"),
                         earth = read(R"("type": "EarthAdvanced", "airDensityG": 0.5)");
  EXPECT_NEAR(own.rayleigh_scattering[1], std::log(2) / 8000, 1e-12);
  EXPECT_NEAR(earth.rayleigh_scattering[1], 13.5e-6, 1e-12);
  EXPECT_THAT(notes, ::testing::Contains(HasSubstr("EarthAdvanced")));
  EXPECT_EQ(own.tent_peak_m, 30e3);
  EXPECT_EQ(own.tent_half_width_m, 10e3);
  EXPECT_EQ(read(R"("ozoneMinimumAltitude": 10000, "ozoneLayerWidth": 30000)").tent_peak_m, 25e3);
  EXPECT_THAT([&] { read(R"("type": "Mars")"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("EarthSimple")));
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
  EXPECT_THAT([&] { blender("sky.sky_type = 'PREETHAM'\nsky.air_density = 1"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("d.py: sky_type = PREETHAM")));
  EXPECT_EQ(program_of("{\"skyfit_preset\": 2}"), nullptr);
  EXPECT_THAT([] { program_named("quake"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("unreal, unity")));
}

}  // namespace
}  // namespace skyfit::fit
