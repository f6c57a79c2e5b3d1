// SPDX-License-Identifier: Apache-2.0
// `skyfit sky --color` is the sum over the spectrum that `skyfit sky --wavelength-nm` prints, and
// `--sigma` is what a covariance of the parameters makes of numerical derivatives of the values,
// and
// `--orders` splits them. `--stokes` gives the same light with its polarisation, which
// `skyfit plot` draws.
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "tests/cli/program.h"

namespace skyfit::cli {
namespace {

using nlohmann::json;

// The columns of a CSV by their names.
using Columns = std::map<std::string, std::vector<double>>;

class SkyTest : public ProgramTest {
 protected:
  Columns sky(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "sky");
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const auto rows = lines(outcome.out);
    const auto names = fields(rows.at(0));
    Columns columns;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const auto row = fields(rows[i]);
      EXPECT_EQ(row.size(), names.size());
      for (std::size_t k = 0; k < row.size(); ++k) columns[names[k]].push_back(std::stod(row[k]));
    }
    return columns;
  }

  // earth-clear with two fields replaced, and a fit section with the covariance of the two.
  void write_preset(const std::string& name, double scattering, double albedo,
                    const json& matrix) const {
    json preset = json::parse(refs::shipped_preset_json("earth-clear"));
    preset["mie"]["scattering_per_m"]["value"] = scattering;
    preset["ground"]["albedo"] = albedo;
    preset["fit"]["covariance"] = {{"parameters", {"ground.albedo", "mie.scattering"}},
                                   {"matrix", matrix}};
    write(name, preset.dump());
  }
};

// Of light that is red alone, the rule's few nodes leave a Z below 0.
TEST_F(SkyTest, TristimulusValuesAreNotNegative) {
  json preset = json::parse(refs::shipped_preset_json("earth-clear"));
  preset["mie"]["single_scattering_albedo"] = 1e-3;
  write("soot.json", preset.dump());
  const Columns found = sky({"--preset", "soot.json", "--sun-zenith-deg", "0,60,88",
                             "--view-zenith-deg", "0,80,89", "--color"});
  for (const char* column : {"X_cd_m2", "Y_cd_m2", "Z_cd_m2"}) {
    for (const double value : found.at(column)) EXPECT_GE(value, 0) << column;
  }
}

// Of a sun at the nadir the apparent one is beyond it.
TEST_F(SkyTest, ASunAtTheNadirMayBeApparent) {
  const Columns found = sky({"--preset", "earth-clear", "--sun-zenith-deg", "180",
                             "--view-zenith-deg", "0", "--refraction", "--apparent-sun"});
  EXPECT_LT(found.at("luminance_cd_m2").at(0), 1e-9);
}

TEST_F(SkyTest, IrradiancesSayThatTheyHaveNoDirection) {
  const Outcome outcome = run({"sky", "--preset", "earth-clear", "--sun-zenith-deg", "40",
                               "--irradiance", "--view-zenith-deg", "10"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.err, ::testing::HasSubstr("--view-zenith-deg is not used"));
}

// I is the radiance without --stokes; degree and angle follow from Q and U; the sign of the IAU.
TEST_F(SkyTest, StokesParametersBelongTogether) {
  const std::vector<std::string> where = {
      "--preset",      "earth-clear", "--sun-zenith-deg", "60",     "--view-zenith-deg", "0,60",
      "--azimuth-deg", "0,90",        "--wavelength-nm",  "440,650"};
  auto stokes = where, iau = where;
  stokes.emplace_back("--stokes");
  iau.insert(iau.end(), {"--stokes", "--iau"});
  const Columns radiance = sky(where), found = sky(stokes), turned = sky(iau);
  const auto &i = found.at("radiance_per_irradiance_sr"), &q = found.at("q_per_irradiance_sr"),
             &u = found.at("u_per_irradiance_sr");
  EXPECT_EQ(i, radiance.at("radiance_per_irradiance_sr"));
  ASSERT_EQ(i.size(), 8u);
  constexpr double kRounding = 1e-8;  // nine printed digits
  for (std::size_t k = 0; k < i.size(); ++k) {
    EXPECT_NEAR(found.at("degree_of_linear_polarisation")[k], std::hypot(q[k], u[k]) / i[k],
                kRounding);
    const double twice = found.at("angle_of_linear_polarisation_deg")[k] * std::acos(-1.0) / 90;
    EXPECT_NEAR(std::hypot(q[k], u[k]) * std::cos(twice), q[k], kRounding);
    EXPECT_NEAR(std::hypot(q[k], u[k]) * std::sin(twice), u[k], kRounding);
    EXPECT_EQ(turned.at("u_per_irradiance_sr")[k], -u[k]);
    EXPECT_EQ(turned.at("q_per_irradiance_sr")[k], q[k]);
  }
  // The zenith at a right angle to a low sun is polarised strongly, across the sun's vertical.
  EXPECT_LT(q[0], -0.2 * i[0]);
}

TEST_F(SkyTest, StokesNeedsWavelengthsAndAModelOfPolarisedLight) {
  const std::vector<std::string> where = {
      "sky", "--preset", "earth-clear", "--stokes", "--sun-zenith-deg", "60", "--view-zenith-deg",
      "0"};
  expect_refusal(where, {"--wavelength-nm"});
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--scalar"}, {"--model", "nielsen"}}) {
    auto arguments = where;
    arguments.insert(arguments.end(), {"--wavelength-nm", "550"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refusal(arguments, {"Stokes", "scalar"});
  }
}

TEST_F(SkyTest, PolarisationIsDrawn) {
  const std::vector<std::string> plot = {"plot", "earth-clear", "--out", "p.svg"};
  const auto with = [&](const std::vector<std::string>& more) {
    auto arguments = plot;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const Outcome drawn = run(with({"--figure", "polarisation", "--sun-zenith-deg", "70"}));
  EXPECT_EQ(drawn.status, 0) << drawn.err;
  EXPECT_NE(read("p.svg").find("Babinet"), std::string::npos);
  expect_refusal(with({"--figure", "polarisation"}), {"--sun-zenith-deg"});
  expect_refusal(with({"--sun-zenith-deg", "70"}), {"--figure polarisation"});
  expect_refusal(with({"--figure", "polarisation", "--sun-zenith-deg", "70", "--model", "nielsen"}),
                 {"Stokes", "scalar"});
}

// Opposite a low sun, scalar light of the horizon is too dark in the blue.
TEST_F(SkyTest, ScalarLightIsAnother) {
  std::vector<std::string> where = {"--preset",          "earth-clear", "--sun-zenith-deg", "80",
                                    "--view-zenith-deg", "85",          "--azimuth-deg",    "180",
                                    "--wavelength-nm",   "400"};
  const double vector = sky(where).at("radiance_per_irradiance_sr")[0];
  where.emplace_back("--scalar");
  const double scalar = sky(where).at("radiance_per_irradiance_sr")[0];
  EXPECT_LT(scalar, 0.97 * vector);
  EXPECT_GT(scalar, 0.85 * vector);
}

TEST_F(SkyTest, ColorIsTheSumOverTheSpectrum) {
  const std::vector<std::string> where = {"--preset", "earth-clear",       "--sun-zenith-deg",
                                          "88",       "--view-zenith-deg", "85"};
  auto spectral = where, color = where;
  spectral.insert(spectral.end(), {"--wavelength-nm", "380:780:5"});
  color.emplace_back("--color");
  const Columns spectrum = sky(spectral), found = sky(color), luminance = sky(where);
  const SpectralData& data = refs::standard_spectral_data();
  std::array<double, 3> xyz{};
  for (std::size_t i = 0; i < spectrum.at("wavelength_nm").size(); ++i) {
    const double nm = spectrum.at("wavelength_nm")[i];
    const double power =
        683.002 * 5 * data.solar_irradiance.at(nm) * spectrum.at("radiance_per_irradiance_sr")[i];
    xyz[0] += power * data.x_bar.at(nm);
    xyz[1] += power * data.y_bar.at(nm);
    xyz[2] += power * data.z_bar.at(nm);
  }
  constexpr double kRule = 1.5e-3;  // model/photometry/photometry.h
  const std::array<double, 3> printed = {found.at("X_cd_m2")[0], found.at("Y_cd_m2")[0],
                                         found.at("Z_cd_m2")[0]};
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(printed[c] / xyz[c], 1, kRule) << c;
  EXPECT_NEAR(printed[1] / luminance.at("luminance_cd_m2")[0], 1, kRule);
  // Red of IEC 61966-2-1.
  EXPECT_NEAR(found.at("R_cd_m2")[0],
              3.2404542 * printed[0] - 1.5371385 * printed[1] - 0.4985314 * printed[2],
              1e-7 * printed[1]);
}

// Values at parameters one step up and down give the gradient g; sigma^2 = g C g.
TEST_F(SkyTest, SigmaIsThatOfANumericalPropagation) {
  constexpr double kScattering = 3e-5, kAlbedo = 0.2, kStep = 1e-3;
  constexpr double kDifference = 1e-4;  // nine digits over the step, and the step's square
  const double variance_albedo = 0.0025, variance_scattering = 1e-10, covariance = -2.5e-7;
  const json matrix = {{variance_albedo, covariance}, {covariance, variance_scattering}};
  write_preset("fitted.json", kScattering, kAlbedo, matrix);
  write_preset("more-aerosol.json", kScattering * (1 + kStep), kAlbedo, matrix);
  write_preset("less-aerosol.json", kScattering * (1 - kStep), kAlbedo, matrix);
  write_preset("more-albedo.json", kScattering, kAlbedo * (1 + kStep), matrix);
  write_preset("less-albedo.json", kScattering, kAlbedo * (1 - kStep), matrix);
  for (const std::vector<std::string>& what :
       std::vector<std::vector<std::string>>{{"--luminance"},
                                             {"--color"},
                                             {"--wavelength-nm", "450,600"},
                                             {"--irradiance"},
                                             {"--irradiance", "--wavelength-nm", "550"}}) {
    const auto values = [&](const std::string& preset, bool sigma) {
      std::vector<std::string> arguments = {
          "--preset",          preset, "--sun-zenith-deg", "40,70",
          "--view-zenith-deg", "30",   "--azimuth-deg",    "20"};
      arguments.insert(arguments.end(), what.begin(), what.end());
      if (sigma) arguments.emplace_back("--sigma");
      return sky(arguments);
    };
    const Columns with = values("fitted.json", true), plain = values("fitted.json", false);
    const Columns up_m = values("more-aerosol.json", false),
                  down_m = values("less-aerosol.json", false),
                  up_a = values("more-albedo.json", false),
                  down_a = values("less-albedo.json", false);
    int checked = 0;
    for (const auto& [name, value] : plain) {
      EXPECT_EQ(with.at(name).size(), value.size());
      if (!with.contains("sigma_" + name)) continue;
      for (std::size_t i = 0; i < value.size(); ++i) {
        const double by_m = (up_m.at(name)[i] - down_m.at(name)[i]) / (2 * kStep * kScattering);
        const double by_a = (up_a.at(name)[i] - down_a.at(name)[i]) / (2 * kStep * kAlbedo);
        const double sigma =
            std::sqrt(by_a * by_a * variance_albedo + by_m * by_m * variance_scattering +
                      2 * by_a * by_m * covariance);
        EXPECT_NEAR(with.at("sigma_" + name)[i], sigma, kDifference * value[i]) << name;
        EXPECT_GT(sigma, 10 * kDifference * value[i]) << name;
        ++checked;
      }
    }
    EXPECT_EQ(static_cast<std::size_t>(checked) / plain.begin()->second.size(),
              with.size() - plain.size());
    EXPECT_GT(checked, 0);
  }
}

TEST_F(SkyTest, NoCovarianceNoSigma) {
  write_preset("fitted.json", 3e-5, 0.2, {{0, 0}, {0, 0}});
  const Columns columns =
      sky({"--preset", "fitted.json", "--sun-zenith-deg", "40", "--irradiance", "--sigma"});
  EXPECT_EQ(columns.size(), 2u + 2 * 4);
  for (const auto& [name, value] : columns) {
    if (name.starts_with("sigma_")) {
      EXPECT_EQ(value[0], 0) << name;
    }
  }
}

TEST_F(SkyTest, SigmaNeedsACovariance) {
  const auto refuse = [&](const std::string& preset, const std::vector<std::string>& texts) {
    expect_refusal({"sky", "--preset", preset, "--sun-zenith-deg", "40", "--irradiance", "--sigma"},
                   texts);
  };
  refuse("earth-clear", {"earth-clear", "fit.covariance is missing", "skyfit fit"});
  write_preset("null.json", 3e-5, 0.2, nullptr);
  refuse("null.json", {"null.json", "fit.covariance.matrix", "expected 2 rows of 2 numbers"});
  write_preset("narrow.json", 3e-5, 0.2, {{1, 2}, {3}});
  refuse("narrow.json", {"narrow.json", "fit.covariance.matrix", "expected 2 rows of 2 numbers"});
  write_preset("endless.json", 3e-5, 0.2, {{nullptr, 0}, {0, 1}});
  refuse("endless.json", {"fit.covariance.matrix[0][0] = null", "ground.albedo", "prior"});
  write_preset("negative.json", 3e-5, 0.2, {{1, 0}, {0, -1}});
  refuse("negative.json", {"fit.covariance.matrix[1][1] = -1", ">= 0"});
  json preset = json::parse(read("negative.json"));
  preset["fit"]["covariance"]["parameters"] = {"mie.phase.g1", "mie.beta"};
  write("names.json", preset.dump());
  refuse("names.json", {"fit.covariance.parameters", "mie.phase.g1"});
}

TEST_F(SkyTest, OrdersAddUpToTheValueAndFallOff) {
  for (const auto& [what, name] :
       {std::pair<std::vector<std::string>, std::string>{{"--luminance"}, "luminance_cd_m2"},
        {{"--wavelength-nm", "450,600"}, "radiance_per_irradiance_sr"}}) {
    std::vector<std::string> arguments = {
        "--preset", "earth-clear",  "--sun-zenith-deg", "20,60,90", "--view-zenith-deg",
        "0,70,120", "--altitude-m", "1,5000",           "--orders", "3"};
    arguments.insert(arguments.end(), what.begin(), what.end());
    const Columns columns = sky(arguments);
    const std::vector<double>& value = columns.at(name);
    const std::vector<double>&first = columns.at("order_1"), &second = columns.at("order_2"),
          &third = columns.at("order_3"), &higher = columns.at("order_higher");
    EXPECT_FALSE(columns.contains("order_4"));
    for (std::size_t i = 0; i < value.size(); ++i) {
      EXPECT_NEAR(first[i] + second[i] + third[i] + higher[i], value[i], 1e-8 * value[i]) << i;
      if (columns.at("sun_zenith_deg")[i] > 86) continue;
      EXPECT_GT(first[i], second[i]) << i;
      EXPECT_GT(second[i], third[i]) << i;
      EXPECT_GT(third[i], higher[i]) << i;
      EXPECT_GT(higher[i], 0) << i;
    }
  }
}

TEST_F(SkyTest, OrdersAreOfRadianceAndLuminanceOnly) {
  const auto refuse = [&](const std::string& orders, std::vector<std::string> extra,
                          const std::vector<std::string>& texts) {
    extra.insert(extra.begin(), {"sky", "--preset", "earth-clear", "--sun-zenith-deg", "40",
                                 "--view-zenith-deg", "0", "--orders", orders});
    expect_refusal(extra, texts);
  };
  for (const char* orders : {"0", "-1", "21", "1.5", "many"})
    refuse(orders, {}, {"--orders", orders, "1 to 20"});
  for (const char* kind : {"--color", "--irradiance", "--sigma"})
    refuse("2", {kind}, {"--orders", kind});
  refuse("2", {"--model", "other"}, {"--model \"other\"", "expected reference with --orders"});
}

}  // namespace
}  // namespace skyfit::cli
