// SPDX-License-Identifier: Apache-2.0
// A preset that no sky has is refused in one line, or its radiance, irradiance and colour are
// finite and not negative.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>

#include "data_refs/spectra.h"
#include "model/atmosphere/preset.h"
#include "model/photometry/photometry.h"
#include "model/registry.h"
#include "model/sky_model.h"

namespace skyfit {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr double kDegree = std::numbers::pi / 180;

constexpr std::string_view kEarth = R"({
  "skyfit_preset": 2, "name": "absurd",
  "planet": {"bottom_radius_m": 6360000, "top_radius_m": 6460000},
  "star": {}, "ground": {"albedo": 0.1},
  "constituents": [
    {"name": "air", "scattering_per_m": {"wavelength_nm": 550, "value": 1.216e-5, "exponent": 4.08},
     "profile": {"type": "exponential", "scale_height_m": 8000}, "phase": {"type": "rayleigh"}},
    {"name": "mie", "scattering_per_m": {"wavelength_nm": 550, "value": 2.2e-5, "exponent": 1.3},
     "single_scattering_albedo": 0.9,
     "profile": {"type": "exponential", "scale_height_m": 1200},
     "phase": {"type": "cornette-shanks", "g": 0.76}},
    {"name": "ozone", "column_du": 300,
     "profile": {"type": "tent", "peak_m": 25000, "half_width_m": 15000}}]})";

enum class Outcome { kRefused, kSky };

struct Case {
  std::string_view name;
  Outcome outcome;
  std::function<void(json&)> edit;
};
void PrintTo(const Case& row, std::ostream* out) { *out << row.name; }

std::function<void(json&)> set(const char* pointer, const json& value) {
  return [=](json& preset) { preset[json::json_pointer(pointer)] = value; };
}
std::function<void(json&)> planet(double bottom, double top) {
  return set("/planet", {{"bottom_radius_m", bottom}, {"top_radius_m", top}});
}
// In the place of the aerosol.
std::function<void(json&)> cloud(double depth, double albedo, double g, const json& profile) {
  return set("/constituents/1",
             {{"name", "cloud"},
              {"optical_depth", {{"wavelength_nm", 550}, {"value", depth}, {"exponent", 0}}},
              {"single_scattering_albedo", albedo},
              {"profile", profile},
              {"phase", {{"type", "henyey-greenstein"}, {"g", g}}}});
}
json layer(double base, double top) {
  return {{"type", "layer"}, {"base_m", base}, {"top_m", top}};
}
json exponential(double scale_height) {
  return {{"type", "exponential"}, {"scale_height_m", scale_height}};
}
std::function<void(json&)> both(const std::function<void(json&)>& first,
                                const std::function<void(json&)>& second) {
  return [=](json& preset) {
    first(preset);
    second(preset);
  };
}

// Columns x: step i, y: y(i).
json table(const char* x, double step, const char* y, int rows,
           const std::function<double(int)>& value) {
  json xs = json::array(), ys = json::array();
  for (int i = 0; i < rows; ++i) {
    xs.push_back(step * i);
    ys.push_back(value(i));
  }
  return {{"type", "tabulated"}, {x, xs}, {y, ys}};
}
json profile_of_rows(int rows, double top) {
  return table("height_m", top / rows, "relative_density", rows,
               [](int i) { return 1 + 0.5 * (i % 2); });
}
// `share` of the light within an angle, the rest in all directions.
json delta_peak(double angle_deg, double share) {
  const double around = (1 - share) / (4 * std::numbers::pi),
               peak = share / (2 * std::numbers::pi * (1 - std::cos(angle_deg * kDegree)));
  return {{"type", "tabulated"},
          {"scattering_angle_deg", {0, angle_deg, angle_deg * 1.00001, 180}},
          {"phase_per_sr", {peak, peak, around, around}}};
}
json spectrum(const char* y, std::vector<double> values) {
  return {{"type", "tabulated"}, {"wavelength_nm", {350, 550, 850}}, {y, values}};
}

const char* const kAirValue = "/constituents/0/scattering_per_m/value";
const char* const kAirHeight = "/constituents/0/profile/scale_height_m";
const char* const kMieLaw = "/constituents/1/scattering_per_m";
const char* const kMieExponent = "/constituents/1/scattering_per_m/exponent";
const char* const kMieProfile = "/constituents/1/profile";
const char* const kMiePhase = "/constituents/1/phase";
const char* const kMieG = "/constituents/1/phase/g";
const char* const kMieAlbedo = "/constituents/1/single_scattering_albedo";
const char* const kOzone = "/constituents/2/column_du";

std::vector<Case> cases() {
  using enum Outcome;
  return {
      {"a radius of a nanometre", kRefused, planet(1e-9, 2e-9)},
      {"a radius of 10 km", kSky, planet(1e4, 1.1e4)},
      {"a radius of a million kilometres", kSky, planet(1e9, 1e9 + 1e5)},
      {"a radius of a tenth of a light year", kRefused, planet(1e15, 1e15 + 1e5)},
      {"a metre of atmosphere", kRefused, planet(6360e3, 6360001)},
      {"a hundred metres of atmosphere", kSky, planet(6360e3, 6360100)},
      {"a top at 0.3 radii", kSky, planet(6360e3, 8268e3)},
      {"a top at 2 radii", kRefused, planet(6360e3, 12720e3)},
      {"a scale height of 1e-300 m", kRefused, set(kAirHeight, 1e-300)},
      {"a scale height of a metre", kSky, set(kAirHeight, 1)},
      {"a scale height of 1e7 m", kSky, set(kAirHeight, 1e7)},
      {"a scale height of 1e9 m", kRefused, set(kAirHeight, 1e9)},
      {"10 /m over 8 km", kRefused, set(kAirValue, 10)},
      {"10 /m over a metre", kSky, both(set(kAirHeight, 1), set(kAirValue, 2))},
      {"g a hair below 1", kRefused, set(kMieG, 1 - 1e-16)},
      {"g 0.999 of a thin aerosol", kSky, set(kMieG, 0.999)},
      {"g 0.999 of a thick one", kRefused, cloud(10, 1, 0.999, exponential(1200))},
      {"g -0.999", kRefused, set(kMieG, -0.999)},
      {"g -0.8", kSky, set(kMieG, -0.8)},
      {"an exponent of a million", kRefused, set(kMieExponent, 1e6)},
      {"an exponent of 20", kSky, set(kMieExponent, 20)},
      {"an exponent of -20 from 1 nm", kSky,
       set(kMieLaw, {{"wavelength_nm", 1}, {"value", 1e-5}, {"exponent", 20}})},
      {"an exponent of 20 from 1 mm", kRefused,
       set(kMieLaw, {{"wavelength_nm", 1e6}, {"value", 1e-5}, {"exponent", 20}})},
      {"1e300 DU of ozone", kRefused, set(kOzone, 1e300)},
      {"1e5 DU of ozone", kSky, set(kOzone, 1e5)},
      {"a pressure of 1e9 hPa", kRefused, set("/constituents/0/site_pressure_hpa", 1e9)},
      {"a pressure of 1e6 hPa", kSky, set("/constituents/0/site_pressure_hpa", 1e6)},
      {"a pressure of 1e-300 hPa", kSky, set("/constituents/0/site_pressure_hpa", 1e-300)},
      {"a depolarisation of 1", kSky, set("/constituents/0/phase/depolarisation", 1)},
      {"a depolarisation of 2", kRefused, set("/constituents/0/phase/depolarisation", 2)},
      {"a layer of half a metre", kRefused, cloud(1, 1, 0.7, layer(100, 100.5))},
      {"a layer of a metre", kSky, cloud(1, 1, 0.7, layer(100, 101))},
      {"a layer of a metre on the ground", kSky, cloud(1, 1, 0.7, layer(0, 1))},
      {"a layer above the top", kRefused, cloud(1, 1, 0.7, layer(99e3, 101e3))},
      {"an optical depth of 1000 in a metre", kRefused, cloud(1000, 1, 0.7, layer(5000, 5001))},
      {"an optical depth of 1000", kSky, cloud(1000, 1, 0.7, layer(1000, 3000))},
      {"one everywhere over a white ground", kSky,
       both(cloud(1000, 1, 0.7, exponential(8000)), set("/ground/albedo", 1))},
      {"an optical depth of 1000 with a narrow lobe", kSky,
       cloud(1000, 1, 0.95, layer(1000, 3000))},
      {"an optical depth of 100 around a small planet", kRefused,
       both(planet(1e6, 1.2e6), cloud(100, 1, 0.7, exponential(2e4)))},
      {"an optical depth of 1e4", kRefused, cloud(1e4, 1, 0.7, layer(1000, 3000))},
      {"a single scattering albedo of 1e-12", kRefused, set(kMieAlbedo, 1e-12)},
      {"a single scattering albedo of 1e-3", kSky, set(kMieAlbedo, 1e-3)},
      {"99 % within a hundredth of a degree", kSky, set(kMiePhase, delta_peak(0.01, 0.99))},
      {"99 % within 1e-7 deg", kRefused, set(kMiePhase, delta_peak(1e-7, 0.99))},
      {"99 % within a hundredth of a degree, thick", kRefused,
       both(cloud(10, 1, 0.7, exponential(1200)), set(kMiePhase, delta_peak(0.01, 0.99)))},
      {"a wavelength of a picometre", kRefused,
       set("/constituents/1/scattering_per_m/wavelength_nm", 1e-3)},
      {"a profile of 1e5 rows", kRefused, set(kMieProfile, profile_of_rows(100'000, 9e4))},
      {"a profile of 2000 rows", kSky, set(kMieProfile, profile_of_rows(2000, 9e4))},
      {"a density of 1e300", kRefused,
       set(kMieProfile,
           table("height_m", 1e3, "relative_density", 2, [](int i) { return i ? 1 : 1e300; }))},
      {"a spectrum that rises by 1e300", kRefused,
       set(kMieLaw, {{"wavelength_nm", 550},
                     {"value", 1e-5},
                     {"spectrum", spectrum("relative_coefficient", {1e300, 1, 1})}})},
      {"a star of 1e9 K", kRefused,
       set("/star/spectrum", {{"type", "black-body"}, {"temperature_k", 1e9}})},
      {"a star of 1e5 K", kSky,
       set("/star/spectrum", {{"type", "black-body"}, {"temperature_k", 1e5}})},
      {"a star of 1000 K", kSky,
       set("/star/spectrum", {{"type", "black-body"}, {"temperature_k", 1000}})},
      {"a star of 1e300 W", kRefused,
       set("/star/spectrum", spectrum("irradiance_w_m2_nm", {1e300, 1e300, 1e300}))},
      {"no star", kSky, set("/star/spectrum", spectrum("irradiance_w_m2_nm", {0, 0, 0}))},
      {"a star of 10 deg", kSky, set("/star/angular_diameter_deg", 10)},
      {"a ground of 1e300 in the blue", kSky,
       set("/ground/spectrum", spectrum("relative_albedo", {1e300, 1, 1}))},
      {"a tent beyond the moon", kSky,
       set("/constituents/2/profile", {{"type", "tent"}, {"peak_m", 1e9}, {"half_width_m", 1}})},
      {"nothing", kSky, set("/constituents", json::array())},
  };
}

void expect_light(std::span<const double> values, std::string_view what) {
  for (const double value : values)
    ASSERT_TRUE(std::isfinite(value) && value >= 0) << what << " " << value;
}

class AbsurdPreset : public testing::TestWithParam<Case> {};

TEST_P(AbsurdPreset, IsRefusedInALineOrHasASky) {
  json preset = json::parse(kEarth);
  GetParam().edit(preset);
  Atmosphere<double> atmosphere;
  try {
    atmosphere = parse_preset(preset.dump(), "absurd").atmosphere;
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(GetParam().outcome, Outcome::kRefused) << error.what();
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    EXPECT_LT(std::string_view(error.what()).size(), 400u) << error.what();
    return;
  }
  ASSERT_EQ(GetParam().outcome, Outcome::kSky);
  const SpectralData spectra = refs::spectral_data_of(atmosphere);
  const auto model = make_sky_model("reference", spectra, 2);
  std::vector<SkyPoint> points;
  for (const double sun : {0.0, 60.0, 88.0, 95.0}) {
    for (const double view : {0.0, 60.0, 89.0, 120.0}) {
      for (const double azimuth : {0.0, 90.0, 180.0}) {
        for (const double altitude : {0.0, 20e3})
          points.push_back({altitude, sun * kDegree, view * kDegree, azimuth * kDegree});
      }
    }
  }
  const XyzRule rule = xyz_rule(spectra);
  const SkyValues sky = model->radiance(atmosphere, rule.nodes, points, {});
  expect_light(sky.value, "radiance");
  // X and Z have negative weights by their nature; luminance is Y.
  for (int i = 0; i < sky.points; ++i) {
    double luminance = 0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k)
      luminance += rule.weight[1][k] * sky.at(i, static_cast<int>(k));
    expect_light({&luminance, 1}, "luminance");
  }
  for (const double sun : {0.0, 80.0})  // of the weights of what is checked above
    expect_light(model->irradiance(atmosphere, rule.nodes, 0, sun * kDegree, {}).value,
                 "irradiance");
}

INSTANTIATE_TEST_SUITE_P(Table, AbsurdPreset, testing::ValuesIn(cases()), [](const auto& row) {
  std::string name(row.param.name);
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

}  // namespace
}  // namespace skyfit
