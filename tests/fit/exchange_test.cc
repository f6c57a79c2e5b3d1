// SPDX-License-Identifier: Apache-2.0
// Parameters of other programs: what is written is read back, what a program can hold loses
// nothing, what it cannot hold is refitted and stated, and strangers' files are refused by name and
// field.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <numbers>
#include <pugixml.hpp>
#include <sstream>

#include "data_refs/references.h"
#include "data_refs/sky_image.h"
#include "data_refs/spectra.h"
#include "fit/exchange/engines.h"
#include "fit/exchange/programs.h"
#include "fit/exchange/reduction.h"
#include "fit/exchange/srgb.h"
#include "model/atmosphere/derived.h"
#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"
#include "model/atmosphere/preset.h"
#include "model/numerics/angles.h"
#include "model/registry.h"
#include "render/sky_map/sky_map.h"

namespace skyfit::fit {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const SpectralData& spectra() { return refs::standard_spectral_data(); }

const SkyModel& scalar() {
  static const auto made = make_sky_model("reference", spectra(), 2, Transfer::kScalar);
  return *made;
}
const Models kScalarTruth{scalar(), scalar()};

Atmosphere<double> shipped(const std::string& name) {
  return parse_preset(refs::shipped_preset_json(name), name).atmosphere;
}

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

Exported exported(const Preset& preset, std::string_view to, double zenith, double azimuth) {
  return program_named(to).write({.preset = preset,
                                  .spectra = spectra(),
                                  .models = kScalarTruth,
                                  .sun_zenith = zenith,
                                  .sun_azimuth = azimuth,
                                  .file = "folder/sky.x",
                                  .write_sky_map = {}});
}

// A file of data of Radiance: two dimensions with irregular positions, the second one fastest.
struct RadianceData {
  std::vector<double> first, second, values;

  explicit RadianceData(const std::string& text) {
    std::istringstream in(text);
    int dimensions = 0;
    in >> dimensions;
    EXPECT_EQ(dimensions, 2);
    for (std::vector<double>* positions : {&first, &second}) {
      double begin = -1, end = -1;
      std::size_t count = 0;
      in >> begin >> end >> count;
      EXPECT_EQ(begin, 0);
      EXPECT_EQ(end, 0);
      positions->resize(count);
      for (double& p : *positions) in >> p;
      EXPECT_TRUE(std::ranges::is_sorted(*positions, std::less_equal()));
    }
    values.resize(first.size() * second.size());
    for (double& v : values) in >> v;
    EXPECT_TRUE(in);
    std::string rest;
    EXPECT_FALSE(in >> rest);
  }

  double at(double x, double y) const {
    const auto below = [](const std::vector<double>& p, double at) {
      std::size_t i = 0;
      while (i + 2 < p.size() && p[i + 1] <= at) ++i;
      return i;
    };
    const std::size_t i = below(first, x), k = below(second, y);
    const double u = (x - first[i]) / (first[i + 1] - first[i]),
                 v = (y - second[k]) / (second[k + 1] - second[k]);
    const auto value = [&](std::size_t a, std::size_t b) { return values[a * second.size() + b]; };
    return (1 - u) * ((1 - v) * value(i, k) + v * value(i, k + 1)) +
           u * ((1 - v) * value(i + 1, k) + v * value(i + 1, k + 1));
  }
};

TEST(Radiance, ReadsTheSkyThatIsWritten) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  const double zenith = 50 * kRadiansPerDegree, azimuth = 110 * kRadiansPerDegree;
  const Exported sky = exported(preset, "radiance", zenith, azimuth);
  ASSERT_EQ(sky.files.size(), 4U);
  const std::string& scene = sky.files[0].text;
  // What Radiance would evaluate for a direction: Atan2(abs(Dx*a-Dy*b),Dx*c+Dy*d).
  double a, b, c, d;
  const std::size_t at = scene.find("Atan2(");
  ASSERT_NE(at, scene.npos);
  ASSERT_EQ(
      std::sscanf(scene.c_str() + at, "Atan2(abs(Dx*%lf-Dy*%lf),Dx*%lf+Dy*%lf)", &a, &b, &c, &d),
      4);
  std::vector<RadianceData> channels;
  for (std::size_t k = 1; k < 4; ++k) {
    channels.emplace_back(sky.files[k].text);
    EXPECT_THAT(scene, HasSubstr(" " + sky.files[k].path.filename().string() + " "));
  }
  const XyzRule rule = xyz_rule(spectra());
  for (const auto& [view_deg, north_deg] :
       {std::pair{20.4, 33.0}, {61.3, 250.0}, {47.1, 117.0}, {88.7, 10.0}}) {
    const double view = view_deg * kRadiansPerDegree, north = north_deg * kRadiansPerDegree;
    const double x = std::sin(view) * std::sin(north), y = std::sin(view) * std::cos(north);
    const double column = std::atan2(std::abs(x * a - y * b), x * c + y * d) * kDegreesPerRadian;
    double luminance = 0;
    constexpr std::array kShare = {0.265, 0.670, 0.065};  // of Radiance's reference manual
    for (std::size_t k = 0; k < 3; ++k)
      luminance += 179 * kShare[k] * channels[k].at(view_deg, column);
    const double expected =
        sky_colors(scalar(), rule, preset.atmosphere, {{0, zenith, view, north - azimuth}})[0][1];
    EXPECT_NEAR(luminance, expected, 0.005 * expected) << view_deg << " " << north_deg;
  }
}

TEST(Radiance, SunGivesTheBeam) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  const double zenith = 50 * kRadiansPerDegree;
  const std::string scene =
      exported(preset, "radiance", zenith, 0.5 * std::numbers::pi).files[0].text;
  double red, green, blue, x, y, z, diameter;
  ASSERT_EQ(std::sscanf(scene.c_str() + scene.find("light solar") + 11, "%*f%*f%*f%lf%lf%lf", &red,
                        &green, &blue),
            3);
  ASSERT_EQ(std::sscanf(scene.c_str() + scene.find("source sun") + 10, "%*f%*f%*f%lf%lf%lf%lf", &x,
                        &y, &z, &diameter),
            4);
  EXPECT_NEAR(x, std::sin(zenith), 1e-8);  // the sun is in the east
  EXPECT_NEAR(y, 0, 1e-8);
  EXPECT_NEAR(z, std::cos(zenith), 1e-8);
  EXPECT_NEAR(diameter, preset.atmosphere.star.angular_diameter_deg, 1e-4);
  const XyzRule rule = xyz_rule(spectra());
  const SkyValues light = scalar().irradiance(preset.atmosphere, rule.nodes, 0, zenith, {});
  double lux = 0;
  for (std::size_t k = 0; k < rule.nodes.size(); ++k)
    lux += rule.weight[1][k] * light.at(kDirectNormal, static_cast<int>(k));
  const double radius = 0.5 * diameter * kRadiansPerDegree;
  EXPECT_NEAR(
      179 * (0.265 * red + 0.670 * green + 0.065 * blue) * std::numbers::pi * radius * radius, lux,
      0.002 * lux);
}

// A sky that costs nothing, where only the text of an export matters.
class EvenSky : public SkyModel {
 public:
  std::string_view name() const override { return "even"; }
  SkyValues radiance(const Atmosphere<double>&, std::span<const WavelengthNode> wavelengths,
                     std::span<const SkyPoint> points, std::span<const Parameter>) const override {
    SkyValues sky{static_cast<int>(points.size()), static_cast<int>(wavelengths.size()), 0, {}, {}};
    sky.value.assign(points.size() * wavelengths.size(), 1.0);
    return sky;
  }
};

double depth_at(const Atmosphere<double>& a, const std::string& name, double nm) {
  return vertical_optical_depth(a, a.at(name), node_at(spectra(), nm));
}

// At wavelengths of its list; what lies between is interpolated.
constexpr std::array kListed_nm = {360 + 2 * 470 / 15.0, 360 + 6 * 470 / 15.0,
                                   360 + 10 * 470 / 15.0};

TEST(CalcMySky, ReadsWhatItWrites) {
  for (const char* name : {"thin-cloud", "titan"}) {
    const Preset preset{name, shipped(name), nullptr};
    const EvenSky even;
    const Exported written = program_named("calcmysky")
                                 .write({.preset = preset,
                                         .spectra = spectra(),
                                         .models = {even, even},
                                         .file = "sky.atmo",
                                         .write_sky_map = {}});
    const std::string& text = written.files.at(0).text;
    EXPECT_EQ(program_of(text)->name, "calcmysky");
    std::vector<std::string> notes;
    const Atmosphere<double> back = *read_calcmysky(text, "file", notes);
    EXPECT_NO_THROW(validate(back)) << name;
    EXPECT_EQ(notes.size(), 1U);
    EXPECT_NEAR(back.bottom_radius_m, preset.atmosphere.bottom_radius_m, 1e-6);
    EXPECT_NEAR(back.top_radius_m, preset.atmosphere.top_radius_m, 1e-6);
    EXPECT_NEAR(back.star.angular_diameter_deg, preset.atmosphere.star.angular_diameter_deg, 1e-6);
    EXPECT_EQ(back.constituents.size(), preset.atmosphere.constituents.size()) << name;
    for (const Constituent<double>& c : preset.atmosphere.constituents) {
      EXPECT_EQ(back.at(c.name).profile.type, c.profile.type) << name << " " << c.name;
      const double depth = depth_at(preset.atmosphere, c.name, kListed_nm[1]);
      // Tables of spectra become power laws.
      EXPECT_NEAR(depth_at(back, c.name, kListed_nm[1]), depth, 0.03 * depth)
          << name << " " << c.name;
    }
  }
}

TEST(CalcMySky, LosesNothingOfPowerLawsAndLobes) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  std::vector<std::string> notes;
  const Atmosphere<double>& a = preset.atmosphere;
  const Atmosphere<double> back =
      *read_calcmysky(exported(preset, "calcmysky", 0.5, 1).files.at(0).text, "file", notes);
  for (const Constituent<double>& c : a.constituents) {
    for (const double nm : kListed_nm)
      EXPECT_NEAR(depth_at(back, c.name, nm), depth_at(a, c.name, nm),
                  2e-5 * depth_at(a, c.name, nm))
          << c.name << " " << nm;
    if (!scatters(c)) continue;
    for (const double nu : {-1.0, 0.2, 0.9, 1.0})
      EXPECT_NEAR(phase_value(back.at(c.name).phase, nu), phase_value(c.phase, nu), 1e-6) << c.name;
  }
  EXPECT_NEAR(single_scattering_albedo_at(with_scalar<Dual<0>>(back.at("mie")), kListed_nm[1]).v,
              a.at("mie").single_scattering_albedo, 1e-6);
  EXPECT_NEAR(back.ground_albedo, a.ground_albedo, 1e-6);
}

TEST(CalcMySky, ForeignCodeIsRefusedByKey) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  const std::string text = exported(preset, "calcmysky", 0.5, 1).files.at(0).text;
  std::vector<std::string> notes;
  const auto with = [&](const std::string& old, const std::string& other) {
    std::string changed = text;
    const std::size_t at = changed.find(old);
    EXPECT_NE(at, changed.npos) << old;
    changed.replace(at, old.size(), other);
    return [&notes, changed] { read_calcmysky(changed, "a.atmo", notes); };
  };
  EXPECT_THAT(
      with("exp(-altitude/1200.0)", "exp(-altitude/1200.0)*2.0"),
      ThrowsMessage<std::invalid_argument>(HasSubstr("a.atmo: Scatterer \"mie\": number density")));
  EXPECT_THAT(with("CONST float g1=", "CONST float h="),
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("a.atmo: Scatterer \"mie\": phase function = g1")));
  EXPECT_THAT(with("Earth radius: 6360000.000000000 m", "Earth radius: 6360 miles"),
              ThrowsMessage<std::invalid_argument>(HasSubstr("Earth radius = 6360 miles")));
  EXPECT_THAT(with("count=16", "count=20"),
              ThrowsMessage<std::invalid_argument>(HasSubstr("16 values, expected 20")));
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

// What Mitsuba would look up in the picture for directions of the world.
TEST(Mitsuba, MapShowsTheSkyWhereItIs) {
  const Preset preset{"earth-clear", shipped("earth-clear"), nullptr};
  const double zenith = 50 * kRadiansPerDegree, azimuth = 110 * kRadiansPerDegree;
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("skyfit_mitsuba_{}.xml", getpid());
  const auto write_map = [&](const std::filesystem::path& to) {
    SkyMapOptions options;
    options.sun_zenith = zenith;
    options.sun_azimuth = azimuth;
    options.sun_disc = false;
    write_sky_map(sky_map(scalar(), preset.atmosphere, xyz_channels(spectra()),
                          *make_map_projection("equirectangular", 90), options),
                  Primaries::kRec709, to);
  };
  const Exported written = program_named("mitsuba").write({.preset = preset,
                                                           .spectra = spectra(),
                                                           .models = kScalarTruth,
                                                           .sun_zenith = zenith,
                                                           .sun_azimuth = azimuth,
                                                           .file = file,
                                                           .write_sky_map = write_map});
  ASSERT_EQ(written.pictures.size(), 1U);
  const refs::Image image = refs::pixels_of(written.pictures[0]);
  std::filesystem::remove(written.pictures[0]);
  pugi::xml_document scene;
  ASSERT_TRUE(scene.load_string(written.files.at(0).text.c_str()));
  const auto emitter = [&](const char* type) {
    return scene.child("scene").find_child_by_attribute("emitter", "type", type);
  };
  EXPECT_EQ(
      emitter("envmap").find_child_by_attribute("name", "filename").attribute("value").value(),
      written.pictures[0].filename().string());
  std::istringstream numbers(
      emitter("envmap").child("transform").child("matrix").attribute("value").value());
  double to_world[4][4];
  for (auto& row : to_world) {
    for (double& v : row) numbers >> v;
  }
  ASSERT_TRUE(numbers);
  const XyzRule rule = xyz_rule(spectra());
  for (const auto& [view_deg, north_deg] :
       {std::pair{21.0, 33.0}, {61.0, 251.0}, {47.0, 131.0}, {81.0, 11.0}}) {
    const double view = view_deg * kRadiansPerDegree, north = north_deg * kRadiansPerDegree;
    const double d[] = {std::sin(view) * std::sin(north), std::sin(view) * std::cos(north),
                        std::cos(view)};
    double local[3] = {};
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) local[i] += to_world[k][i] * d[k];  // the inverse of a rotation
    }
    const double u = std::atan2(local[0], -local[2]) / (2 * std::numbers::pi),
                 v = std::acos(local[1]) / std::numbers::pi;
    const int x = static_cast<int>((u - std::floor(u)) * image.width),
              y = static_cast<int>(std::lround(v * (image.height - 1)));
    const float* pixel = image.pixel(x, y);
    const double expected =
        sky_colors(scalar(), rule, preset.atmosphere, {{0, zenith, view, north - azimuth}})[0][1];
    EXPECT_NEAR(xyz_of_srgb({pixel[0], pixel[1], pixel[2]})[1], expected, 0.04 * expected)
        << view_deg << " " << north_deg;
  }
  std::istringstream direction(emitter("directional").child("vector").attribute("value").value()),
      irradiance(emitter("directional").child("rgb").attribute("value").value());
  double x, y, z;
  Rgb rgb;
  direction >> x >> y >> z;
  irradiance >> rgb[0] >> rgb[1] >> rgb[2];
  EXPECT_NEAR(x, -std::sin(zenith) * std::sin(azimuth), 1e-8);
  EXPECT_NEAR(y, -std::sin(zenith) * std::cos(azimuth), 1e-8);
  EXPECT_NEAR(z, -std::cos(zenith), 1e-8);
  const double lux =
      irradiance_color(scalar().irradiance(preset.atmosphere, rule.nodes, 0, zenith, {}),
                       kDirectNormal, rule, std::vector<double>(rule.nodes.size(), 1))[1];
  EXPECT_NEAR(xyz_of_srgb(rgb)[1], lux, 1e-5 * lux);
}

}  // namespace
}  // namespace skyfit::fit
