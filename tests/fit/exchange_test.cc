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

#include "fit/exchange/bruneton_textures.h"
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

// How the shaders of Bruneton 2017 read the textures (functions.glsl), in C++.
class BrunetonShader {
 public:
  BrunetonShader(const BrunetonTextures& textures, const EngineAtmosphere& engine,
                 double highest_sun)
      : textures_(textures),
        engine_(engine),
        bottom_(engine.bottom_radius_m),
        top_(engine.top_radius_m),
        horizon_(std::sqrt(top_ * top_ - bottom_ * bottom_)),
        mu_s_min_(std::cos(highest_sun)) {}

  Rgb sky(double r, double mu, double mu_s, double nu) const {
    const Rgb scattering = at(textures_.scattering, r, mu, mu_s, nu),
              mie = at(textures_.single_mie, r, mu, mu_s, nu);
    const double g = engine_.g, k = 3 / (8 * std::numbers::pi) * (1 - g * g) / (2 + g * g),
                 mie_phase = k * (1 + nu * nu) / std::pow(1 + g * g - 2 * g * nu, 1.5);
    Rgb sum;
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] = scattering[c] * 3 / (16 * std::numbers::pi) * (1 + nu * nu) + mie[c] * mie_phase;
    return sum;
  }

  Rgb transmittance(double r, double mu) const {
    const double rho = std::sqrt(r * r - bottom_ * bottom_), d = to_top(r, mu),
                 x = (d - (top_ - r)) / (rho + horizon_ - (top_ - r));
    return filtered(textures_.transmittance, {texture(x, 256), texture(rho / horizon_, 64), 0.5},
                    {256, 64, 1});
  }

  Rgb irradiance(double r, double mu_s) const {
    return filtered(
        textures_.irradiance,
        {texture(0.5 + 0.5 * mu_s, 64), texture((r - bottom_) / (top_ - bottom_), 16), 0.5},
        {64, 16, 1});
  }

 private:
  static double texture(double x, int size) { return 0.5 / size + x * (1 - 1.0 / size); }
  double to_top(double r, double mu) const {
    return -r * mu + std::sqrt(r * r * (mu * mu - 1) + top_ * top_);
  }
  static Rgb filtered(const std::vector<float>& texels, const std::array<double, 3>& u,
                      const std::array<int, 3>& size) {
    Rgb sum{};
    std::array<int, 3> low{};
    std::array<double, 3> part{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = std::clamp(u[k] * size[k] - 0.5, 0.0, size[k] - 1.0);
      low[k] = static_cast<int>(x);
      part[k] = x - low[k];
    }
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1;
      std::array<int, 3> i{};
      for (std::size_t k = 0; k < 3; ++k) {
        const bool high = (corner >> k & 1) != 0;
        weight *= high ? part[k] : 1 - part[k];
        i[k] = std::min(low[k] + (high ? 1 : 0), size[k] - 1);
      }
      const auto texel = static_cast<std::size_t>((i[2] * size[1] + i[1]) * size[0] + i[0]);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * double{texels[4 * texel + c]};
    }
    return sum;
  }
  Rgb at(const std::vector<float>& texels, double r, double mu, double mu_s, double nu) const {
    const double rho = std::sqrt(std::max(r * r - bottom_ * bottom_, 0.0)), r_mu = r * mu,
                 discriminant = r_mu * r_mu - r * r + bottom_ * bottom_;
    const bool ground = mu < 0 && discriminant >= 0;
    double u_mu = 0;
    if (ground) {
      const double d = -r_mu - std::sqrt(discriminant), least = r - bottom_;
      u_mu = 0.5 - 0.5 * texture(rho == least ? 0 : (d - least) / (rho - least), 64);
    } else {
      const double d = -r_mu + std::sqrt(discriminant + horizon_ * horizon_), least = top_ - r;
      u_mu = 0.5 + 0.5 * texture((d - least) / (rho + horizon_ - least), 64);
    }
    const auto a = [&](double cosine) {
      return (to_top(bottom_, cosine) - (top_ - bottom_)) / (horizon_ - (top_ - bottom_));
    };
    const double u_mu_s = texture(std::max(1 - a(mu_s) / a(mu_s_min_), 0.0) / (1 + a(mu_s)), 32);
    const double x = (nu + 1) / 2 * 7, first = std::floor(x);
    Rgb sum{};
    for (const double n : {first, first + 1}) {
      const Rgb part =
          filtered(texels, {(n + u_mu_s) / 8, u_mu, texture(rho / horizon_, 32)}, {256, 128, 32});
      for (std::size_t c = 0; c < 3; ++c) sum[c] += (1 - std::abs(x - n)) * part[c];
    }
    return sum;
  }

  const BrunetonTextures& textures_;
  const EngineAtmosphere& engine_;
  double bottom_, top_, horizon_, mu_s_min_;
};

TEST(Bruneton2017, TexturesGiveTheSkyOfTheReference) {
  constexpr double kHighestSun = 1.885, kDegree = std::numbers::pi / 180;
  const EngineAtmosphere engine = restricted(shipped("earth-clear"), engine_named("bruneton"));
  const Atmosphere<double> a = atmosphere_of(engine);
  const BrunetonTextures textures =
      bruneton_textures(engine, a.star, spectra(), kHighestSun, {}, 2, {});
  const BrunetonShader shader(textures, engine, kHighestSun);
  const std::vector<double> nm(kEngineWavelengths_nm.begin(), kEngineWavelengths_nm.end());
  const std::vector<WavelengthNode> nodes = spectral_nodes(spectra(), nm);
  const Rgb sun = engine_solar_irradiance(spectra());
  std::vector<SkyPoint> points;
  for (const double height : {2.0, 9000.0}) {
    for (const double zenith : {20.0, 50.0, 75.0, 87.0}) {
      for (const double view : {5.0, 30.0, 55.0, 75.0, 86.0}) {
        for (const double azimuth : {0.0, 40.0, 110.0, 180.0})
          points.push_back({height, zenith * kDegree, view * kDegree, azimuth * kDegree});
      }
    }
  }
  const SkyValues light = scalar().radiance(a, nodes, points, {});
  double squares = 0, worst = 0;
  int count = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (angle_from_sun(points[p]) < 8 * kDegree) continue;  // eight steps of nu hold no aureole
    const Rgb seen =
        shader.sky(engine.bottom_radius_m + points[p].altitude_m, std::cos(points[p].view_zenith),
                   std::cos(points[p].sun_zenith), std::cos(angle_from_sun(points[p])));
    for (std::size_t k = 0; k < 3; ++k) {
      const double expected = sun[k] * light.at(static_cast<int>(p), static_cast<int>(k)),
                   error = seen[k] / expected - 1;
      squares += error * error;
      worst = std::max(worst, std::abs(error));
      ++count;
    }
  }
  std::printf("[bruneton] sky: %.2f %% rms, worst %.2f %%\n", 100 * std::sqrt(squares / count),
              100 * worst);
  EXPECT_LT(std::sqrt(squares / count), 0.02);
  EXPECT_LT(worst, 0.08);

  const SkyValues ground = scalar().irradiance(a, nodes, 2, 50 * kDegree, {});
  const Rgb diffuse = shader.irradiance(engine.bottom_radius_m + 2, std::cos(50 * kDegree));
  for (std::size_t k = 0; k < 3; ++k) {
    const auto node = static_cast<int>(k);
    EXPECT_NEAR(diffuse[k] / (sun[k] * ground.at(kDiffuseHorizontal, node)), 1, 0.03);
    EXPECT_NEAR(shader.transmittance(engine.bottom_radius_m + 2, std::cos(50 * kDegree))[k] /
                    ground.at(kDirectNormal, node),
                1, 0.01);
  }
}

}  // namespace
}  // namespace skyfit::fit
