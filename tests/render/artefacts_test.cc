// SPDX-License-Identifier: Apache-2.0
// The three artefacts of Sperlhofer 2011, 5.1, each by the method that makes it and by ours: noise
// in the transmittance of short paths, a seam at the horizon, aerosols of a wrong colour after
// sunset.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "data_refs/spectra.h"
#include "model/registry.h"
#include "model/shared/shared.h"
#include "model/sky_model.h"
#include "model/tables/table_lookup.h"
#include "tests/render/gl_fixture.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

const AtmosphereTables& tables() {
  static const AtmosphereTables made = tables_of(shipped("earth-clear"), TableSizes{});
  return made;
}

double luminance(const NodeValues& nodes) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += tables().color.xyz_from_nodes[1][k] * nodes[k];
  return sum;
}

double as_half(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, 11)), exponent - 11);
}

TEST(Transmittance, OfShortPathsHasNoNoise) {
  // Transmittances to the top in half floats, one divided by the other, against the difference of
  // optical depths: along a ray near the horizon, in steps of 20 m.
  constexpr double kHeight = 500, kStep = 20;
  const double mu = std::cos(89.5 * kDegree);
  const TablePlace start{kHeight, mu, 0.5};
  const auto to_top = [](const TablePlace& place) {
    return as_half(std::exp(-lookup_optical_depth(tables(), place.height, place.mu)[0]));
  };
  std::vector<double> before, after;
  for (int i = 0; i < 200; ++i) {
    const TablePlace end = place_along(tables(), start, 0.3, kStep * i);
    before.push_back(to_top(start) / to_top(end));
    after.push_back(lookup_transmittance(tables(), start, end, false)[0]);
  }
  const auto roughness = [](const std::vector<double>& values) {
    double sum = 0;
    for (std::size_t i = 2; i < values.size(); ++i)
      sum += std::abs(values[i] - 2 * values[i - 1] + values[i - 2]);
    return sum / static_cast<double>(values.size() - 2);
  };
  std::printf("[  noise ] %.2g before, %.2g after\n", roughness(before), roughness(after));
  EXPECT_GT(roughness(before), 20 * roughness(after));
  EXPECT_TRUE(std::is_sorted(after.rbegin(), after.rend()));
}

TEST(Horizon, HasNoSeam) {
  // Light of the first 2 km of rays about the horizon from 50 m: whole rays interpolated in the
  // cosine over 128 texels that know no horizon, and ours, against the reference.
  constexpr double kHeight = 50, kLength = 2e3, kSun = 85 * kDegree, kAzimuth = 30 * kDegree;
  const double bottom = tables().atmosphere.bottom_radius_m;
  const double mu_s = std::cos(kSun);
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), 2);
  const auto whole = [&](const TablePlace& place, double nu) {
    return luminance(lookup_radiance(tables(), place.height, place.mu, place.mu_s, nu,
                                     place.mu < horizon_cosine(bottom, place.height)));
  };
  const auto across_the_horizon = [&](const TablePlace& place, double nu) {
    constexpr double kTexel = 2.0 / 127;
    const double texel = std::floor((place.mu + 1) / kTexel), low = texel * kTexel - 1;
    const double a = whole({place.height, low, place.mu_s}, nu),
                 b = whole({place.height, low + kTexel, place.mu_s}, nu);
    return a + (place.mu - low) / kTexel * (b - a);
  };
  double worst_before = 0, worst_after = 0;
  for (double zenith = 89.9; zenith < 91.3; zenith += 0.1) {
    const double mu = std::cos(zenith * kDegree), sine = std::sin(zenith * kDegree);
    const double nu = mu * mu_s + sine * std::sin(kSun) * std::cos(kAzimuth);
    const TablePlace start{kHeight, mu, mu_s}, end = place_along(tables(), start, nu, kLength);
    const bool down = mu < horizon_cosine(bottom, kHeight);
    const double through =
        luminance(lookup_transmittance(tables(), start, end, down)) / luminance({1, 1, 1, 1});
    // The end's azimuth, by nu there.
    const double cosine =
        (nu - end.mu * end.mu_s) / std::sqrt((1 - end.mu * end.mu) * (1 - end.mu_s * end.mu_s));
    const SkyPoint points[2] = {{kHeight, kSun, zenith * kDegree, kAzimuth},
                                {end.height, std::acos(end.mu_s), std::acos(end.mu),
                                 std::acos(std::clamp(cosine, -1.0, 1.0))}};
    // Light straight from the ground is in both and falls out of the difference.
    const SkyValues light = model->radiance(tables().atmosphere, tables().color.nodes, points, {});
    NodeValues finite;
    const NodeValues t = lookup_transmittance(tables(), start, end, down);
    for (std::size_t k = 0; k < 4; ++k)
      finite[k] = light.at(0, static_cast<int>(k)) - t[k] * light.at(1, static_cast<int>(k));
    const double truth = luminance(finite);
    NodeValues ours;
    const NodeValues from = lookup_radiance(tables(), start.height, start.mu, mu_s, nu, down),
                     rest = lookup_radiance(tables(), end.height, end.mu, end.mu_s, nu, down);
    for (std::size_t k = 0; k < 4; ++k) ours[k] = from[k] - t[k] * rest[k];
    const double blended = across_the_horizon(start, nu) - through * across_the_horizon(end, nu);
    worst_before = std::max(worst_before, std::abs(blended / truth - 1));
    worst_after = std::max(worst_after, std::abs(luminance(ours) / truth - 1));
  }
  std::printf("[horizon ] worst %.1f %% before, %.2f %% after\n", 100 * worst_before,
              100 * worst_after);
  constexpr double kTables = 0.03;  // 1 % of whole rays, of which the path has the half
  EXPECT_LT(worst_after, kTables);
  EXPECT_GT(worst_before, 5 * worst_after);
}

TEST(Aerosols, KeepTheirColorAfterSunset) {
  // Blue single scattering by the aerosol, made from its red one as air and multiple scattering go:
  // right by day, wrong once the sun's light comes through the long way of the blue. We keep it in
  // a table (whose light after sunset sky_agreement_test holds against the reference).
  const TableSizes& sizes = tables().sizes;
  Shared<double> shared;
  const auto recovered_over_kept = [&](double sun_height) {
    int sun = 0;
    for (int i = 0; i < sizes.scattering_mu_s; ++i) {
      const auto height_of = [&](int index) {
        return shared.sun_from_unit(index / (sizes.scattering_mu_s - 1.0), kTableLowestSun);
      };
      if (std::abs(height_of(i) - sun_height) < std::abs(height_of(sun) - sun_height)) sun = i;
    }
    // From the ground, 60 degrees above the horizon or so, toward the sun's azimuth.
    const int row = sizes.scattering_ground + sizes.scattering_sky / 2;
    const std::size_t texel = 4 * (static_cast<std::size_t>(row) * tables().single.width + sun);
    const auto law = [&](const Constituent<double>& c, std::size_t node) {
      return std::pow(tables().color.nodes[node].wavelength_nm, -c.angstrom_exponent);
    };
    const auto& a = tables().atmosphere;
    const auto value = [&](const Table& table, std::size_t node) {
      return std::exp(double{table.rgba[texel + node]});
    };
    const double recovered = value(tables().rayleigh_like, 0) * value(tables().single, 3) /
                             value(tables().rayleigh_like, 3) *
                             (law(a.at("rayleigh"), 3) / law(a.at("mie"), 3)) *
                             (law(a.at("mie"), 0) / law(a.at("rayleigh"), 0));
    return recovered / value(tables().single, 0);
  };
  const double day = recovered_over_kept(std::cos(30 * kDegree)),
               dusk = recovered_over_kept(std::cos(93 * kDegree));
  std::printf("[aerosols] recovered / kept: %.2f by day, %.2f with the sun 3 degrees down\n", day,
              dusk);
  EXPECT_LT(std::abs(std::log(day)), std::log(1.3));
  EXPECT_GT(std::abs(std::log(dusk)), std::log(1.5));
}

}  // namespace
}  // namespace skyfit
