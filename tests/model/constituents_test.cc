// SPDX-License-Identifier: Apache-2.0
// An atmosphere is a list: a constituent split into two of half the amount and the order of the
// list change nothing, a constituent that only a preset knows has exact derivatives, and a
// homogeneous layer is as bright as adding-doubling says.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <numbers>
#include <sstream>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/parameters.h"
#include "model/atmosphere/preset.h"
#include "model/registry.h"
#include "model/solver/reference_model.h"
#include "tests/atmospheres.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Dust at 3 km that absorbs in the blue and has its own phase function at each wavelength.
Constituent<double> dust() {
  const auto phase = [](double g) {
    TwoColumns table;
    for (int i = 0; i <= 360; ++i) {
      const double nu = std::cos(0.5 * kDegree * i), d = 1 + g * g - 2 * g * nu;
      table.x.push_back(0.5 * i);
      table.y.push_back((1 - g * g) / (4 * std::numbers::pi * d * std::sqrt(d)));
    }
    return std::make_shared<const TabulatedPhase>(std::move(table));
  };
  Constituent<double> c;
  c.name = "dust";
  c.amount_type = AmountType::kOpticalDepth;
  c.amount = 0.3;
  c.angstrom_exponent = 0.2;
  c.albedo_spectrum =
      std::make_shared<const SpectrumTable>(TwoColumns{{400, 700}, {0.75, 0.97}}, kAlbedoFormat);
  c.profile.type = ProfileType::kLayer;
  c.profile.base_m = 3000;
  c.profile.top_m = 4500;
  c.phase.type = PhaseType::kByWavelength;
  c.phase.by_wavelength = std::make_shared<const SpectralPhase>(
      std::vector<double>{400, 700},
      std::vector<std::shared_ptr<const TabulatedPhase>>{phase(0.75), phase(0.6)});
  return c;
}

Atmosphere<double> dusty() {
  Atmosphere<double> a;
  a.constituents.push_back(dust());
  return a;
}

std::vector<SkyPoint> points() {
  std::vector<SkyPoint> list;
  for (const double sun : {35.0, 75.0, 87.0}) {
    for (const double view : {5.0, 60.0, 84.0, 130.0}) {
      for (const double azimuth : {10.0, 120.0})
        list.push_back({view > 90 ? 9e3 : 0.0, sun * kDegree, view * kDegree, azimuth * kDegree});
    }
  }
  return list;
}

SkyValues sky_of(const Atmosphere<double>& a, std::span<const Parameter> derivatives = {}) {
  static const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  static const std::vector<WavelengthNode> nodes =
      spectral_nodes(refs::standard_spectral_data(), {460, 600});
  return model->radiance(a, nodes, points(), derivatives);
}

// `a` with the constituent as two, each of half of it.
Atmosphere<double> split(Atmosphere<double> a, std::string_view name) {
  Constituent<double> half = a.at(name);
  half.amount /= 2;
  a.at(name) = half;
  half.name += "_too";
  a.constituents.push_back(half);
  return a;
}

TEST(Constituents, SplitInTwoTheyAreTheSameSky) {
  constexpr double kRounding = 1e-9;
  const SkyValues whole = sky_of(dusty());
  for (const char* name : {"rayleigh", "mie", "ozone", "dust"}) {
    const SkyValues halves = sky_of(split(dusty(), name));
    for (std::size_t i = 0; i < whole.value.size(); ++i)
      EXPECT_NEAR(halves.value[i] / whole.value[i], 1, kRounding) << name << ' ' << i;
  }
}

TEST(Constituents, SplitInTwoTheirDerivativesAddUp) {
  constexpr double kRounding = 1e-9;
  const Parameter depth("dust", Quantity::kOpticalDepth);
  const std::vector<Parameter> both = {depth, {"dust_too", Quantity::kOpticalDepth}};
  const SkyValues whole = sky_of(dusty(), {&depth, 1}),
                  halves = sky_of(split(dusty(), "dust"), both);
  for (std::size_t i = 0; i < whole.value.size(); ++i) {
    const double mean = 0.5 * (halves.derivative[i] + halves.derivative[whole.value.size() + i]);
    EXPECT_NEAR(mean, whole.derivative[i], kRounding * (std::abs(mean) + whole.value[i])) << i;
  }
}

TEST(Constituents, TheirOrderDoesNotMatter) {
  constexpr double kRounding = 1e-10;
  Atmosphere<double> turned = dusty();
  std::ranges::reverse(turned.constituents);
  const SkyValues one = sky_of(dusty()), other = sky_of(turned);
  for (std::size_t i = 0; i < one.value.size(); ++i)
    EXPECT_NEAR(other.value[i] / one.value[i], 1, kRounding) << i;
}

// More parameters than are carried at once, among them the edges of a layer.
TEST(Constituents, EveryDerivativeIsThatOfADifference) {
  constexpr double kDifference = 1e-5;
  Atmosphere<double> a = dusty();
  Constituent<double> smoke = standard_mie<double>();
  smoke.name = "smoke";
  smoke.amount_type = AmountType::kExtinction;
  smoke.amount = 5e-5;
  smoke.profile.type = ProfileType::kLayer;
  smoke.profile.base_m = 0;
  smoke.profile.top_m = 900;
  a.constituents.push_back(smoke);
  const std::vector<Parameter> parameters = parameters_of(a);
  EXPECT_GT(parameters.size(), 12u);
  const SkyValues exact = sky_of(a, parameters);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const double middle = get_parameter(a, parameters[p]), step = 2e-5 * std::abs(middle);
    const auto at = [&](double value) {
      Atmosphere<double> b = a;
      set_parameter(b, parameters[p], value);
      return sky_of(b);
    };
    const SkyValues high = at(middle + step), low = at(middle - step);
    double worst = 0;
    for (std::size_t i = 0; i < high.value.size(); ++i) {
      const double difference = (high.value[i] - low.value[i]) / (2 * step);
      const double scale = std::max(std::abs(difference), exact.value[i] / std::abs(middle));
      worst =
          std::max(worst, std::abs(exact.derivative_at(static_cast<int>(p), static_cast<int>(i / 2),
                                                       static_cast<int>(i % 2)) -
                                   difference) /
                              scale);
    }
    std::printf("[derivative] %-32s %.1e\n", parameters[p].name().c_str(), worst);
    EXPECT_LT(worst, kDifference) << parameters[p].name();
  }
}

// Rows of tests/model/data/cloud_layer.csv with one layer.
struct Layer {
  double optical_depth, base_m, top_m;
};
struct LayerRow {
  SkyPoint point;
  double radiance;
};
std::vector<LayerRow> rows_of(const Layer& layer) {
  std::ifstream in(SKYFIT_TEST_DATA "/cloud_layer.csv");
  std::vector<LayerRow> rows;
  for (std::string line; std::getline(in, line);) {
    double depth, base, top, sun, view, azimuth, radiance;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &depth, &base, &top, &sun, &view,
                    &azimuth, &radiance) != 7)
      continue;
    if (depth != layer.optical_depth || base != layer.base_m || top != layer.top_m) continue;
    rows.push_back({{0, sun * kDegree, view * kDegree, azimuth * kDegree}, radiance});
  }
  return rows;
}

void expect_within(const Layer& layer, double rms_limit) {
  Atmosphere<double> a;
  a.bottom_radius_m = 9e8;  // plane-parallel
  a.top_radius_m = 9e8 + 100e3;
  a.ground_albedo = 0.2;
  Constituent<double> air = standard_rayleigh<double>(), cloud = standard_mie<double>();
  air.amount = 0.0973 / 8000;
  cloud.name = "cloud";
  cloud.amount_type = AmountType::kOpticalDepth;
  cloud.amount = layer.optical_depth;
  cloud.single_scattering_albedo = 1;
  cloud.phase.g = 0.85;
  cloud.profile.type = ProfileType::kLayer;
  cloud.profile.base_m = layer.base_m;
  cloud.profile.top_m = layer.top_m;
  a.constituents = {air, cloud};
  std::vector<SkyPoint> list;
  const std::vector<LayerRow> rows = rows_of(layer);
  ASSERT_GT(rows.size(), 50u);
  for (const LayerRow& row : rows) list.push_back(row.point);
  // As the truth: cloud and air of one extinction, without polarisation.
  const auto model =
      make_sky_model("reference", refs::standard_spectral_data(), 2, Transfer::kScalar);
  const WavelengthNode green{550, 0};
  const SkyValues sky = model->radiance(a, {&green, 1}, list, {});
  double sum = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    sum += std::pow(sky.value[i] / rows[i].radiance - 1, 2);
  const double rms = std::sqrt(sum / static_cast<double>(rows.size()));
  std::printf("[layer] optical depth %g, %g to %g m: rms %.2f %%\n", layer.optical_depth,
              layer.base_m, layer.top_m, 100 * rms);
  EXPECT_LT(rms, rms_limit);
}

TEST(Layers, OfCloudAndCirrusAreAsAddingDoublingHasThem) {
  expect_within({2, 500, 2000}, 0.006);
  expect_within({10, 500, 700}, 0.007);
  expect_within({0.5, 8000, 9000}, 0.008);
}

// The corners of a layer's edges, as kLayerEdge has them.
TEST(Layers, AsATableTheyAreAsBright) {
  Atmosphere<double> layered;
  Constituent<double> cloud;
  cloud.name = "cloud";
  cloud.amount_type = AmountType::kOpticalDepth;
  cloud.amount = 20;
  cloud.profile.type = ProfileType::kLayer;
  cloud.profile.base_m = 1000;
  cloud.profile.top_m = 3000;
  cloud.phase = {PhaseType::kHenyeyGreenstein, 0.85, 0, 0, 0};
  layered.constituents.push_back(cloud);
  Atmosphere<double> tabulated = layered;
  const double edge = 0.5 * kLayerEdge * 2000;
  tabulated.at("cloud").profile = tabulated_profile(std::make_shared<const LinearProfile>(
      TwoColumns{{0, 1000 - edge, 1000 + edge, 3000 - edge, 3000 + edge}, {0, 0, 1, 1, 0}}));
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  const auto nodes = spectral_nodes(refs::standard_spectral_data(), {550});
  const std::vector<SkyPoint> points = {{0, 40 * kDegree, 0, 0},
                                        {0, 40 * kDegree, 70 * kDegree, 1}};
  const SkyValues a = model->radiance(layered, nodes, points, {}),
                  b = model->radiance(tabulated, nodes, points, {});
  for (std::size_t i = 0; i < a.value.size(); ++i) EXPECT_NEAR(b.value[i] / a.value[i], 1, 5e-3);
}

TEST(Layers, InTwoHalvesTheyAreTheSameSky) {
  constexpr double kRounding = 1e-9;
  for (const char* name : {"overcast", "thin-cloud"}) {
    const Atmosphere<double> a = parse_preset(refs::shipped_preset_json(name), name).atmosphere;
    const SkyValues whole = sky_of(a), halves = sky_of(split(a, "cloud"));
    for (std::size_t i = 0; i < whole.value.size(); ++i)
      EXPECT_NEAR(halves.value[i] / whole.value[i], 1, kRounding) << name << ' ' << i;
  }
}

// Aerosol of an optical depth of 5 alone, with a profile.
Atmosphere<double> thick_aerosol(const std::string& profile) {
  const std::string text = R"({"skyfit_preset": 2, "name": "thick", "ground": {"albedo": 0.2},
      "planet": {"bottom_radius_m": 6360000, "top_radius_m": 6460000},
      "constituents": [{"name": "mie", "profile": )" +
                           profile +
                           R"(, "optical_depth": {"wavelength_nm": 550, "value": 5, "exponent": 0},
      "phase": {"type": "henyey-greenstein", "g": 0.7}}]})";
  return parse_preset(text, "thick").atmosphere;
}

// Where the levels of clear air are too few: the sky was too dark by 4, 18 and 26 %.
TEST(Levels, FollowThickAerosolOfEveryProfile) {
  ReferenceOptions options, fine;
  options.transfer = fine.transfer = Transfer::kScalar;
  fine.levels = 5 * kDefaultLevels;
  const auto nodes = spectral_nodes(refs::standard_spectral_data(), {550});
  std::vector<SkyPoint> directions;
  for (const double sun : {20.0, 60.0}) {
    for (const double view : {0.0, 40.0, 75.0})
      directions.push_back({0, sun * kDegree, view * kDegree, 2});
  }
  for (const char* profile : {R"({"type": "exponential", "scale_height_m": 2000})",
                              R"({"type": "mixed-layer", "mixed_m": 1500, "end_m": 2500})",
                              R"({"type": "tent", "peak_m": 2000, "half_width_m": 1500})"}) {
    const Atmosphere<double> a = thick_aerosol(profile);
    const SkyValues found = ReferenceModel(options).radiance(a, nodes, directions, {}),
                    expected = ReferenceModel(fine).radiance(a, nodes, directions, {});
    double worst = 0;
    for (std::size_t i = 0; i < directions.size(); ++i)
      worst = std::max(worst, std::abs(found.value[i] / expected.value[i] - 1));
    std::cout << "[ worst ] " << profile << ' ' << 100 * worst << " %\n";
    EXPECT_LT(worst, 0.012) << profile;  // 1.1 % of the mixed layer, 0.5 of the others
  }
}

// The diffuse field has a kink at a cloud's top. What an eye in the clear air above, short of the
// next level, sees of the cloud is what it sees with three times the levels.
TEST(Layers, SeenFromAboveAreAsWithThreeTimesTheLevels) {
  const Atmosphere<double> a =
      parse_preset(refs::shipped_preset_json("overcast"), "overcast").atmosphere;
  const auto nodes = spectral_nodes(refs::standard_spectral_data(), {550});
  std::vector<SkyPoint> points;
  for (const double altitude : {3400.0, 3800.0}) {
    for (const double view : {80.0, 94.0, 100.0}) {
      for (const double azimuth : {0.0, 180.0})
        points.push_back({altitude, 84 * kDegree, view * kDegree, azimuth * kDegree});
    }
  }
  ReferenceOptions options;
  options.threads = 2;
  options.transfer = Transfer::kScalar;
  const SkyValues found = ReferenceModel(options).radiance(a, nodes, points, {});
  options.levels = 3 * kDefaultLevels;
  const SkyValues fine = ReferenceModel(options).radiance(a, nodes, points, {});
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    worst = std::max(worst, std::abs(found.value[i] / fine.value[i] - 1));
  std::cout << "[ worst ] " << 100 * worst << " %\n";
  EXPECT_LT(worst, 0.08);  // 6.7 % toward the sun
}

}  // namespace
}  // namespace skyfit
