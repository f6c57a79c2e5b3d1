// SPDX-License-Identifier: Apache-2.0
// Look-ups between the texels of the tables give what was computed: closed columns, finer tables,
// the sky's integral.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/preset.h"
#include "model/atmosphere/slant_column.h"
#include "model/solver/reference_model.h"
#include "model/tables/table_lookup.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

AtmosphereTables tables_of(const char* name, const TableSizes& sizes) {
  const Preset preset = parse_preset(refs::shipped_preset_json(name), name);
  return compute_tables(preset.atmosphere, color_rule(refs::standard_spectral_data()), sizes, 2,
                        {});
}

TEST(Tables, OpticalDepthIsThatOfTheColumns) {
  const AtmosphereTables tables =
      tables_of("bruneton-2008", {256, 128, 8, 4, 4, 4, 4, 8, 4, 4, 8, 4});  // no ozone
  const Atmosphere<double>& a = tables.atmosphere;
  constexpr double kInterpolation = 0.004;  // of exponentials between 128 heights
  for (const double height : {0.5, 170.0, 1234.0, 5e3, 21e3}) {
    for (const double zenith : {3.0, 40.0, 71.0, 84.0, 89.2}) {
      const double mu = std::cos(zenith * kDegree), top = a.top_radius_m - a.bottom_radius_m;
      const double air = exponential_column(a.bottom_radius_m, height, mu, top,
                                            a.at("rayleigh").profile.scale_height_m)
                             .value;
      const double aerosol =
          exponential_column(a.bottom_radius_m, height, mu, top, a.at("mie").profile.scale_height_m)
              .value;
      const NodeValues tau = lookup_optical_depth(tables, height, mu);
      for (std::size_t k = 0; k < 4; ++k) {
        const double ratio = tables.color.nodes[k].wavelength_nm / 550;
        const auto at = [ratio](const Constituent<double>& c) {
          return c.amount * std::pow(ratio, -c.angstrom_exponent);
        };
        const double expected = at(a.at("rayleigh")) * air +
                                at(a.at("mie")) / a.at("mie").single_scattering_albedo * aerosol;
        EXPECT_NEAR(tau[k] / expected, 1, kInterpolation)
            << "height " << height << ", zenith " << zenith;
      }
    }
  }
}

double luminance(const AtmosphereTables& tables, const NodeValues& nodes) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += tables.color.xyz_from_nodes[1][k] * nodes[k];
  return sum;
}

TEST(SlowTables, FinerTablesSayTheSame) {
  const AtmosphereTables usual = tables_of("earth-clear", TableSizes{});
  const AtmosphereTables fine =
      tables_of("earth-clear", {512, 256, 64, 16, 64, 64, 96, 80, 24, 4, 8, 4});
  constexpr double kUsual = 0.01;  // the error allowed to a frame's sky
  for (const double height : {2.0, 800.0, 10e3}) {
    for (const double sun : {13.0, 47.0, 76.0, 86.5}) {
      for (const double view : {7.0, 33.0, 58.0, 79.0, 88.0}) {
        for (const double azimuth : {0.0, 50.0, 140.0}) {
          const double mu = std::cos(view * kDegree), mu_s = std::cos(sun * kDegree);
          const double nu = mu * mu_s + std::sqrt((1 - mu * mu) * (1 - mu_s * mu_s)) *
                                            std::cos(azimuth * kDegree);
          const double a = luminance(usual, lookup_radiance(usual, height, mu, mu_s, nu, false));
          const double b = luminance(fine, lookup_radiance(fine, height, mu, mu_s, nu, false));
          EXPECT_NEAR(a / b, 1, kUsual) << "height " << height << ", sun " << sun << ", view "
                                        << view << ", azimuth " << azimuth;
        }
      }
    }
  }
}

TEST(Tables, OrdersAreThoseOfTheReference) {
  const Preset preset = parse_preset(refs::shipped_preset_json("earth-clear"), "earth-clear");
  const ColorRule color = color_rule(refs::standard_spectral_data());
  constexpr double kTables = 0.02, kView = 58 * kDegree, kSun = 47 * kDegree, kAzimuth = 1;
  const double mu = std::cos(kView), mu_s = std::cos(kSun);
  const double nu = mu * mu_s + std::sin(kView) * std::sin(kSun) * std::cos(kAzimuth);
  const SkyPoint point{2, kSun, kView, kAzimuth};
  NodeValues sum{};
  for (const int orders : {1, 2, 3}) {
    ReferenceOptions options;
    options.order = orders;
    const SkyValues of_order =
        ReferenceModel(options).radiance(preset.atmosphere, color.nodes, {&point, 1}, {});
    for (std::size_t k = 0; k < 4; ++k) sum[k] += of_order.value[k];
    const AtmosphereTables tables =
        compute_tables(preset.atmosphere, color, {64, 64, 16, 4, 16, 16, 48, 48, 16, 4, 8, 4}, 2,
                       {}, {Transfer::kVector, orders});
    const NodeValues found = lookup_radiance(tables, 2, mu, mu_s, nu, false);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(found[k] / sum[k], 1, kTables) << orders << " orders, node " << k;
  }
}

TEST(Tables, IrradianceIsTheSkysIntegral) {
  const AtmosphereTables tables = tables_of("earth-clear", TableSizes{});
  constexpr int kSteps = 160;
  for (const double sun : {25.0, 61.0, 83.0}) {
    const double mu_s = std::cos(sun * kDegree);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double mu = (i + 0.5) / kSteps;
      for (int j = 0; j < kSteps; ++j) {
        const double widest = std::sqrt((1 - mu * mu) * (1 - mu_s * mu_s));
        const double nu = mu * mu_s + widest * std::cos(std::numbers::pi * (j + 0.5) / kSteps);
        const NodeValues l = lookup_radiance(tables, 300, mu, mu_s, nu, false);
        sum += luminance(tables, l) * mu * 2 * std::numbers::pi / (kSteps * kSteps);
      }
    }
    EXPECT_NEAR(luminance(tables, lookup_irradiance(tables, 300, mu_s)) / sum, 1, 0.02)
        << "sun " << sun;
  }
}

TEST(Tables, ShortPathsScatterInProportionToTheirLength) {
  // Toward the ground from 2 m: nothing but the light scattered in the first metres, twice as much
  // from twice the height.
  const AtmosphereTables tables = tables_of("earth-clear", TableSizes{});
  const double low = luminance(tables, lookup_radiance(tables, 2, -1, 0.5, -0.5, true));
  const double high = luminance(tables, lookup_radiance(tables, 4, -1, 0.5, -0.5, true));
  EXPECT_GT(low, 0);
  EXPECT_NEAR(high / low, 2, 0.02);
}

TEST(SlowTables, AreFiniteForEveryShippedPreset) {
  for (const std::string& name : refs::shipped_preset_names()) {
    const AtmosphereTables tables =
        tables_of(name.c_str(), {32, 16, 16, 8, 8, 8, 8, 16, 4, 8, 16, 4});
    for (const Table* table : {&tables.optical_depth, &tables.irradiance, &tables.rayleigh_like,
                               &tables.single, &tables.sky_rays.air, &tables.sky_rays.aerosol}) {
      for (const float value : table->rgba) ASSERT_TRUE(std::isfinite(value)) << name;
    }
  }
}

}  // namespace
}  // namespace skyfit
