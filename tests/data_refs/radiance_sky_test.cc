// SPDX-License-Identifier: Apache-2.0
// Scenes of gendaylit and gensky: our own Perez sky in gendaylit's numbers is that sky, CIE skies
// are those of their formulas, and what contradicts itself is said by line.
#include "data_refs/radiance_sky.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "complaint.h"
#include "data_refs/cie_sky.h"
#include "data_refs/perez_sky.h"
#include "data_refs/references.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

using ::testing::HasSubstr;

constexpr double kRounding = 1e-12;
constexpr double kPrinted = 1e-5;     // six digits of a direction
constexpr double kNineDigits = 1e-9;  // of a direction of these tests
constexpr double kLumenPerWatt = 179;
constexpr double kSun = 35 * kRadiansPerDegree, kAzimuth = 120 * kRadiansPerDegree;

std::string direction_of(double zenith, double azimuth) {
  return fmt::format("{:.9f} {:.9f} {:.9f}", std::sin(zenith) * std::sin(azimuth),
                     std::sin(zenith) * std::cos(azimuth), std::cos(zenith));
}

std::string sun_of(double zenith, double azimuth) {
  return "void light solar\n0\n0\n3 6e6 6e6 6e6\nsolar source sun\n0\n0\n4 " +
         direction_of(zenith, azimuth) + " 0.533\n";
}

// As gendaylit writes it.
std::string perez_scene(const PerezCoefficients& p, double brightness) {
  return "# gendaylit 6 21 12 -P 6.3 0.12\n# Ground ambient level: 9.2\n" + sun_of(kSun, kAzimuth) +
         fmt::format(
             "void brightfunc skyfunc\n2 skybright perezlum.cal\n0\n10 {} 4.2 {} {} {} {} {} ",
             brightness, p.a, p.b, p.c, p.d, p.e) +
         direction_of(kSun, kAzimuth) + "\n";
}

constexpr double kGround = 3.1;  // A3 of skybright.cal

std::string cie_scene(int kind, double zenith_radiance, double divisor) {
  return fmt::format(
             "# gensky 6 21 12\nvoid brightfunc skyfunc\n2 skybr skybright.cal\n0\n"
             "7 {} {} {} {} ",
             kind, zenith_radiance, kGround, divisor) +
         direction_of(kSun, kAzimuth) + "\n";
}

TEST(RadianceSky, OurPerezSkyInItsNumbersIsThatSky) {
  const PerezSky perez{6.3, 0.12};
  const RadianceSky sky = parse_radiance_sky(perez_scene(perez_coefficients(perez, kSun), 20), "x");
  EXPECT_NEAR(sky.sun->zenith, kSun, kPrinted);
  EXPECT_NEAR(sky.sun->azimuth, kAzimuth, kPrinted);
  const double zenith = radiance_sky_luminance(sky, 0, kSun);
  for (const double view : {10, 45, 80}) {
    for (const double angle : {5, 60, 110}) {
      const double v = view * kRadiansPerDegree, g = angle * kRadiansPerDegree;
      EXPECT_NEAR(radiance_sky_luminance(sky, v, g) / zenith,
                  perez_relative_luminance(perez, kSun, v, g), kRounding);
    }
  }
  const PerezCoefficients p = perez_coefficients(perez, kSun);
  EXPECT_NEAR(zenith,
              kLumenPerWatt * 20 * (1 + p.a * std::exp(p.b)) *
                  (1 + p.c * std::exp(p.d * kSun) + p.e * std::pow(std::cos(kSun), 2)),
              kRounding * zenith);
}

// What skybright.cal makes of a sky by the ground, of Dz the cosine of the view's zenith angle:
// wmean((Dz + 1.01)^10, sky, (Dz + 1.01)^-10, A3), wmean(a, x, b, y) = (a x + b y) / (a + b).
double above_ground(double sky, double view) {
  const double w = std::pow(std::cos(view) + 1.01, 10);
  return (w * sky + kGround / w) / (w + 1 / w);
}

TEST(RadianceSky, SkiesOfTheCieAboveTheGround) {
  const auto luminance = [](int kind, double divisor, double view, double angle) {
    return radiance_sky_luminance(parse_radiance_sky(cie_scene(kind, 30, divisor), "x"), view,
                                  angle) /
           kLumenPerWatt;
  };
  for (const double view : {0.0, 1.0, 1.5}) {
    EXPECT_NEAR(luminance(2, 1, view, 0.5),
                above_ground(30 * traditional_overcast_relative_luminance(view), view),
                30 * kRounding);
    EXPECT_NEAR(luminance(3, 1, view, 0.5), above_ground(30, view), 30 * kRounding);
  }
  // Over the formula's value at the zenith, by which gensky divides, the zenith has its radiance.
  const double clear = (0.91 + 10 * std::exp(-3 * kSun) + 0.45 * std::pow(std::cos(kSun), 2)) *
                       (1 - std::exp(-0.32));
  EXPECT_NEAR(luminance(1, clear, 0, kSun), above_ground(30, 0), 30 * kRounding);
  // Into the sun at the zenith: (0.91 + 10 + 0.45) (1 - exp(-0.32)).
  EXPECT_NEAR(luminance(1, 1, 0, 0), above_ground(30 * 11.36 * (1 - std::exp(-0.32)), 0),
              30 * 11 * kRounding);
  // The ratio of an intermediate sky in two angles g is that of
  // exp(-0.563 g ((2.629 - n) (1.562 - t) + 0.812)).
  const auto without_ground = [&](double view, double angle) {
    return luminance(4, 1, view, angle) - above_ground(0, view);
  };
  const double view = 0.8;
  EXPECT_NEAR(without_ground(view, 1.5) / without_ground(view, 0.5),
              std::exp(-0.563 * ((2.629 - view) * (1.562 - kSun) + 0.812)), kNineDigits);
}

TEST(RadianceSky, OvercastAndUniformSkiesNeedNoSun) {
  const std::string function = "void brightfunc skyfunc\n2 skybr skybright.cal\n0\n3 2 30 3.1\n";
  const RadianceSky dark = parse_radiance_sky(function, "x");
  EXPECT_FALSE(dark.sun.has_value());
  EXPECT_NEAR(radiance_sky_luminance(dark, 1.0, 0) / kLumenPerWatt,
              above_ground(30 * traditional_overcast_relative_luminance(1.0), 1.0), 30 * kRounding);
  // Azimuths count from south to west.
  const RadianceSky computed =
      parse_radiance_sky("# Solar altitude and azimuth: 55.0 -60.0\n" + function, "x");
  EXPECT_NEAR(computed.sun->zenith, kSun, kRounding);
  EXPECT_NEAR(computed.sun->azimuth, kAzimuth, kRounding);
  EXPECT_NEAR(parse_radiance_sky("# gensky -ang 40 10 -c\n" + function, "x").sun->azimuth,
              190 * kRadiansPerDegree, kRounding);
  EXPECT_THAT(complaint_of([&] {
                parse_radiance_sky("# Solar altitude and azimuth: -5.0 10.0\n" + function, "x");
              }),
              HasSubstr("x:1: sun zenith 95.00 deg"));
  const TemporaryDirectory directory;
  const auto file = directory.path() / "overcast.rad";
  write_whole_file(file, function);
  const auto load = [&](const std::vector<double>& suns) {
    return load_reference(file.string(), suns, Sampling::kTregenza);
  };
  EXPECT_NEAR(load({kSun}).samples[0].sun_zenith, kSun, kRounding);
  EXPECT_THAT(complaint_of([&] { load({}); }), HasSubstr("expected one sun_zenith_deg, got 0"));
}

TEST(RadianceSky, ASunNearTheZenithIsLowered) {
  const auto scene = [](double zenith_deg) {
    return "# Solar altitude and azimuth: 89.9 0.0\n# warning - sun too close to zenith, reducing "
           "altitude to 87 degrees\nvoid brightfunc f\n2 skybr skybright.cal\n0\n7 1 13 25 0.87 " +
           direction_of(zenith_deg * kRadiansPerDegree, std::numbers::pi) + "\n";
  };
  EXPECT_NEAR(parse_radiance_sky(scene(3), "x").sun->zenith, 3 * kRadiansPerDegree, kPrinted);
  EXPECT_THAT(complaint_of([&] { parse_radiance_sky(scene(4), "x"); }),
              HasSubstr("x:1: solar altitude and azimuth"));
}

TEST(RadianceSky, AGlowColoursTheSkyAndOutputTwoIsLuminance) {
  const std::string scene = cie_scene(3, 30, 1);
  const auto luminance = [](const std::string& text) {
    return radiance_sky_luminance(parse_radiance_sky(text, "x"), 0, kSun);
  };
  const double plain = luminance(scene);
  const std::string sky =
                        "skyfunc glow sky\n0\n0\n4 0.5 0.5 0.5 0\nsky source dome\n0\n0\n"
                        "4 0 0 1 180\n",
                    ground =
                        "skyfunc glow soil\n0\n0\n4 1.4 0.9 0.6 0\nsoil source ground\n0\n0\n"
                        "4 0 0 -1 180\n";
  const std::string by_alias = "void alias air skyfunc\nair glow" + sky.substr(sky.find(" sky\n"));
  for (const std::string& lights : {sky, sky + ground, ground + sky, by_alias})
    EXPECT_NEAR(luminance(scene + lights), 0.5 * plain, kRounding * plain) << lights;
  EXPECT_NEAR(luminance(scene + ground), plain, kRounding * plain);
  EXPECT_NEAR(luminance("# gendaylit -ang 55 -60 -W 800 100 -O 2\n" + scene) * kLumenPerWatt, plain,
              kRounding * plain);
}

TEST(RadianceSky, IsAReferenceWithItsOwnSun) {
  const TemporaryDirectory directory;
  const auto file = directory.path() / "sky.rad";
  write_whole_file(file, perez_scene(perez_coefficients({6.3, 0.12}, kSun), 20));
  EXPECT_TRUE(is_radiance_sky_file(file.string()));
  const Reference sky = load_reference(file.string(), {}, Sampling::kTregenza);
  EXPECT_EQ(sky.quantity, Quantity::kLuminance);
  ASSERT_EQ(sky.samples.size(), 145u);
  EXPECT_NEAR(sky.samples[0].sun_zenith, kSun, kPrinted);
  ASSERT_EQ(sky.scans.size(), 1u);
  EXPECT_NEAR(*sky.scans[0].sun_azimuth, kAzimuth, kPrinted);
  EXPECT_FALSE(is_radiance_sky_file((directory.path() / "none.rad").string()));
}

TEST(RadianceSky, TheExampleIsThePerezSkyThatItSays) {
  constexpr double kSixDigits = 2e-5;
  const Reference scene = load_reference(SKYFIT_EXAMPLES "gendaylit.rad", {}, Sampling::kTregenza),
                  perez = load_reference("perez:6.3,0.12", {kSun}, Sampling::kTregenza);
  const double scale = scene.samples[144].value / perez.samples[144].value;
  for (std::size_t i = 0; i < 145; ++i)
    EXPECT_NEAR(scene.samples[i].value / perez.samples[i].value / scale, 1, kSixDigits) << i;
}

TEST(RadianceSky, WhatIsWrongIsNamedByLine) {
  const auto message = [](const std::string& text) {
    return complaint_of([&] { parse_radiance_sky(text, "sky.rad"); });
  };
  const std::string good = perez_scene(perez_coefficients({6.3, 0.12}, kSun), 20);
  EXPECT_EQ(message(good), "accepted");
  EXPECT_THAT(message(sun_of(kSun, kAzimuth + 0.1) + cie_scene(3, 30, 1)),
              HasSubstr("sky.rad:5: source sun: zenith 35.00 deg"));
  EXPECT_THAT(message("# Solar altitude and azimuth: 55.0 60.0\n" + good),
              HasSubstr("sky.rad:1: solar altitude and azimuth"));
  EXPECT_EQ(message("# Solar altitude and azimuth: 55.0 -60.0\n" + good), "accepted");
  EXPECT_THAT(message("# gendaylit 6 21 12 -W 800 100 -O 1\n" + cie_scene(3, 30, 1)),
              HasSubstr("sky.rad:1: gendaylit -O 1: radiances of all wavelengths"));
  EXPECT_THAT(message(cie_scene(7, 30, 1)), HasSubstr("A1 = 7: expected 1 (clear)"));
  EXPECT_THAT(message(good.substr(0, good.size() - 12)), HasSubstr("expected a number"));
  EXPECT_THAT(message("void brightfunc f\n2 skybr skybright.cal\n0\n3 1 2 3\n"),
              HasSubstr("sky.rad:1: 3 numbers: expected the 7 of skybright.cal"));
  EXPECT_THAT(message("void brightfunc f\n2 skybr skybright.cal\n0\n7 3 1 1 1 0 0 -1\n"),
              HasSubstr("expected a sun above the horizon"));
  EXPECT_THAT(message("void brightfunc f\n2 skybr skybright.cal\n0\n7 3 1 1 1 0 0 9\n"),
              HasSubstr("expected a length of 1"));
  EXPECT_THAT(message("!gensky 6 21 12\n"), HasSubstr("sky.rad:1: a command"));
}

}  // namespace
}  // namespace skyfit::refs
