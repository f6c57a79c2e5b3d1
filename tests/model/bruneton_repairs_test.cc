// SPDX-License-Identifier: Apache-2.0
// What `bruneton` shows with each of the three repairs of Sperlhofer 2011, 5.1, left out, in his
// atmosphere: noise in the transmittance of short paths, a wrong look-up beside the horizon, a
// false glow of the aerosol after sunset; and that each choice changes what it is about alone.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "data_refs/references.h"
#include "data_refs/spectra.h"
#include "model/atmosphere/preset.h"
#include "model/literature/bruneton.h"
#include "model/numerics/half.h"
#include "model/registry.h"
#include "model/shared/shared.h"
#include "model/tables/tables.h"

namespace skyfit {
namespace {

using literature::BrunetonGeometry;
using Tables = literature::BrunetonTables<0>;
using Sizes = literature::BrunetonSizes;

constexpr double kDegree = std::numbers::pi / 180;
constexpr WavelengthNode kBlue{440, 0}, kRed{BrunetonMethod::kRedNm, 0};

const Atmosphere<double>& earth() {
  static const Atmosphere<double> atmosphere =
      parse_preset(refs::shipped_preset_json("sperlhofer-2011"), "sperlhofer-2011").atmosphere;
  return atmosphere;
}
const BrunetonGeometry& geometry() {
  static const BrunetonGeometry made(earth());
  return made;
}
literature::ClearAir<0> air_at(const WavelengthNode& node) {
  return literature::clear_air(geometry().shells(), seeded<0>(earth(), {}), node);
}
const Tables& blue() {
  static const Tables made(geometry(), air_at(kBlue), {});
  return made;
}
const Tables& red() {
  static const Tables made(geometry(), air_at(kRed), {});
  return made;
}
const Tables& halves() {
  static const Tables made(
      geometry(), air_at(kBlue), {},
      {BrunetonTransmittance::kInHalfFloats, BrunetonInScatter::kInHalfFloats, BrunetonMie::kKept});
  return made;
}
View view_of(double altitude_m, double sun_deg, double view_deg, double azimuth_deg) {
  return literature::view_of(
      earth(), {altitude_m, sun_deg * kDegree, view_deg * kDegree, azimuth_deg * kDegree});
}

TEST(BrunetonRepairs, HalfFloatsHaveElevenBits) {
  EXPECT_EQ(rounded_to_half(1), 1);
  EXPECT_EQ(rounded_to_half(1 + 0x1p-11), 1);  // to the even one
  EXPECT_EQ(rounded_to_half(1 + 0x1p-10), 1 + 0x1p-10);
  EXPECT_EQ(rounded_to_half(1.9 * kLeastHalf), 2 * kLeastHalf);
  EXPECT_EQ(rounded_to_half(0.4 * kLeastHalf), 0);
}

// His listing divides two look-ups; the noise is the more of a path's extinction the shorter it is.
TEST(BrunetonRepairs, TransmittanceInHalfFloatsIsNoisy) {
  std::vector<double> quotients, exact;
  for (int i = 0; i < 200; ++i) {  // eyes near the ground, toward the horizon
    const ViewRay ray = literature::table_ray(geometry().shells(), 2 + 0.1 * i, -0.02, true);
    quotients.push_back(halves().half_transmittance_to_ground(ray).v);
    exact.push_back(literature::transmittance_to_ground(geometry().shells(), air_at(kBlue), ray).v);
    EXPECT_LE(quotients.back(), 1);
    EXPECT_NEAR(quotients.back() / exact.back(), 1, 0.05) << i;
  }
  const auto roughness = [](const std::vector<double>& values) {
    double sum = 0;
    for (std::size_t i = 2; i < values.size(); ++i)
      sum += std::abs(values[i] - 2 * values[i - 1] + values[i - 2]);
    return sum / static_cast<double>(values.size() - 2);
  };
  std::cout << "[ noise ] " << roughness(quotients) << " before, " << roughness(exact)
            << " after\n";
  EXPECT_GT(roughness(quotients), 20 * roughness(exact));
  // Straight down from high above it is what it should be, to the table's steps.
  const ViewRay down = literature::table_ray(geometry().shells(), 50e3, -1, true);
  EXPECT_NEAR(halves().half_transmittance_to_ground(down).v /
                  literature::transmittance_to_ground(geometry().shells(), air_at(kBlue), down).v,
              1, 2e-3);
}

// The light on a ray to the sky has nothing to do with the transmittance of paths.
TEST(BrunetonRepairs, TransmittanceChangesTheGroundAlone) {
  const Tables half(geometry(), air_at(kBlue), {}, {BrunetonTransmittance::kInHalfFloats});
  for (const double view : {10.0, 80.0, 89.9, 95.0, 150.0}) {
    const View at = view_of(2e3, 50, view, 40);
    EXPECT_EQ(half.light(at).air.v, blue().light(at).air.v) << view;
    EXPECT_EQ(half.light(at).aerosol.v, blue().light(at).aerosol.v) << view;
    if (view > 94) {
      EXPECT_NE(half.light(at).ground.v, blue().light(at).ground.v) << view;
      EXPECT_NEAR(half.light(at).ground.v / blue().light(at).ground.v, 1, 0.01) << view;
    }
  }
}

// By radii the coordinates are the same ones, in single precision they are not.
TEST(BrunetonRepairs, RadiiInFloatsLoseTheWayToTheHorizon) {
  constexpr double kBottom = 6360, kTop = 6420;  // km
  Shared<double> exact;
  Shared<float> single;
  double near = 0, far = 0;  // worst errors
  for (const double h : {0.02, 0.5, 3.0, 20.0}) {
    EXPECT_NEAR(exact.bruneton_unit_from_radius(kBottom + h, kBottom, kTop),
                exact.bruneton_unit_from_height(h, kBottom, kTop - kBottom), 1e-9);
    const double horizon = -exact.horizon_distance(h, kBottom) / (kBottom + h);
    for (const double mu : {1.0, 0.3, horizon + 1e-3}) {
      EXPECT_FALSE(exact.bruneton_meets_ground(kBottom + h, mu, kBottom));
      EXPECT_NEAR(exact.bruneton_sky_unit_by_radius(kBottom + h, mu, kBottom, kTop),
                  exact.unit_from_upward_ray(h, mu, kBottom, kTop - kBottom), 1e-9);
    }
    for (const double below : {1e-6, 1e-5, 0.3, 0.9}) {
      const double mu = horizon - below * (1 + horizon),
                   unit = exact.unit_from_ground_ray(h, mu, kBottom);
      EXPECT_TRUE(exact.bruneton_meets_ground(kBottom + h, mu, kBottom));
      EXPECT_NEAR(exact.bruneton_ground_unit_by_radius(kBottom + h, mu, kBottom), unit, 1e-6);
      const double error = std::abs(static_cast<double>(single.bruneton_ground_unit_by_radius(
                                        static_cast<float>(kBottom + h), static_cast<float>(mu),
                                        static_cast<float>(kBottom))) -
                                    unit);
      (below < 1e-3 ? near : far) = std::max(below < 1e-3 ? near : far, error);
    }
  }
  std::cout << "[ coordinate ] off by " << near << " beside the horizon, " << far << " below\n";
  EXPECT_GT(near, 0.02);  // of the table's 64 texels more than one
  EXPECT_LT(far, 1e-3);
}

// What he calls imprecise data beside the horizon: of the light before a surface, as the difference
// of two look-ups, of which each finds for itself whether it meets the ground.
TEST(BrunetonRepairs, InScatterBeforeSurfacesIsWrongBesideTheHorizon) {
  constexpr double kHeight = 2, kSun = 85 * kDegree, kAzimuth = 40 * kDegree;
  const double mu_s = std::cos(kSun), bottom = geometry().bottom();
  const double dip = std::acos(horizon_cosine(bottom, kHeight)) - 0.5 * std::numbers::pi;
  // The worst error of paths a tenth to nine tenths of the way to the ground, as a part of the
  // light of the whole way to the horizon; `below_horizon` in radians.
  const auto worst = [&](double below_horizon) {
    double error = 0;
    const double horizon = blue()
                               .in_scatter(kHeight, horizon_cosine(bottom, kHeight), mu_s,
                                           std::sin(kSun) * std::cos(kAzimuth), true)
                               .rayleigh_like.v;
    for (double part = 0.1; part < 0.95; part += 0.02) {
      const double view = 0.5 * std::numbers::pi + dip + below_horizon;
      const double mu = std::cos(view);
      const double nu = mu * mu_s + std::sin(view) * std::sin(kSun) * std::cos(kAzimuth);
      const ViewRay ray = literature::table_ray(geometry().shells(), kHeight, mu, true);
      const double length = part * ray.length;
      const RayPoint end = ray_point(ray, bottom, length);
      const double end_mu_s = ((bottom + kHeight) * mu_s + length * nu) / (bottom + end.height);
      const double through =
          std::exp(-air_at(kBlue).optical_depth(columns_along(geometry().shells(), ray, end)).v);
      const auto before = [&](const Tables::InScatter& whole, const Tables::InScatter& rest) {
        return std::max(whole.rayleigh_like.v - through * rest.rayleigh_like.v, 0.0);
      };
      const Tables::InScatter whole = blue().in_scatter(kHeight, mu, mu_s, nu, true);
      const double exact = before(whole, blue().in_scatter(end.height, end.mu, end_mu_s, nu, true)),
                   published =
                       before(halves().in_scatter_by_radii(kHeight, mu, mu_s, nu),
                              halves().in_scatter_by_radii(end.height, end.mu, end_mu_s, nu));
      error = std::max(error, std::abs(published - exact) / horizon);
    }
    return error;
  };
  const double beside = worst(0.003 * kDegree), below = worst(10 * kDegree);
  std::cout << "[ in-scatter ] worst " << 100 * beside << " % beside the horizon, " << 100 * below
            << " % ten degrees below\n";
  EXPECT_GT(beside, 0.2);
  EXPECT_LT(below, 0.01);
}

// The renderer's tables: halves of the exact ones, with the rays to the ground before the others.
TEST(BrunetonRepairs, InScatterIsKeptInHalfFloats) {
  const auto half = halves().sky_rays(), exact = blue().sky_rays();
  ASSERT_EQ(half.air.height, Sizes::mu);
  ASSERT_EQ(exact.air.height, Sizes::mu / 2);
  const std::size_t slice = exact.air.values.size() / Sizes::r;
  for (std::size_t r = 0; r < Sizes::r; ++r) {
    for (std::size_t i = 0; i < slice; i += 7) {
      ASSERT_EQ(double{half.air.values[(2 * r + 1) * slice + i]},
                rounded_to_half(double{exact.air.values[r * slice + i]}));
      ASSERT_EQ(double{half.aerosol.values[(2 * r + 1) * slice + i]},
                rounded_to_half(double{exact.aerosol.values[r * slice + i]}));
    }
  }
  // A ray to the ground from there has no length.
  EXPECT_EQ(half.air.values[0], 0);
}

// The rule is exact at the wavelength that it starts from; in the blue it is near by day, and once
// the sun is down it makes light that is not there, which is what he fades.
TEST(BrunetonRepairs, MieFromRayleighGlowsAfterSunset) {
  Tables same = red(), recovered = blue();
  same.take_mie_from_rayleigh(red());
  recovered.take_mie_from_rayleigh(red());
  const auto glow = [&](double sun) {
    const View at = view_of(0, sun, 80, 0);
    EXPECT_NEAR(same.light(at).aerosol.v / red().light(at).aerosol.v, 1, 1e-12);
    EXPECT_EQ(recovered.light(at).air.v, blue().light(at).air.v);
    return recovered.light(at).aerosol.v / blue().light(at).aerosol.v;
  };
  const double day = glow(30), dusk = glow(91);
  std::cout << "[ aerosol ] recovered / kept: " << day << " by day, " << dusk
            << " with the sun a degree down\n";
  EXPECT_LT(std::abs(std::log(day)), std::log(1.3));
  EXPECT_GT(dusk, 1.5);
  const View at = view_of(0, 91, 80, 0);
  EXPECT_GT(recovered.light(at).sum().v, 1.03 * blue().light(at).sum().v);
}

// A model that asks for transmittances in half floats, and scatters nothing.
class Dark final : public SkyModel {
 public:
  explicit Dark(const BrunetonChoices& choices) : choices_(choices) {}
  std::string_view name() const override { return "dark"; }
  SkyValues radiance(const Atmosphere<double>&, std::span<const WavelengthNode>,
                     std::span<const SkyPoint>, std::span<const Parameter>) const override {
    return {};
  }
  ScatteredLight scattered_light(const Atmosphere<double>&, std::span<const WavelengthNode> nodes,
                                 std::span<const SkyPoint> points) const override {
    const std::vector<double> nothing(nodes.size() * points.size());
    return {nothing, nothing};
  }
  std::size_t prepare(const Atmosphere<double>&, std::span<const WavelengthNode>) const override {
    return 0;
  }
  std::optional<SkyRayTables> sky_rays(const Atmosphere<double>&,
                                       std::span<const WavelengthNode, 4>) const override {
    SkyRayTables tables{SkyRayMapping::kBruneton, {}, {}};
    tables.bruneton = choices_;
    return tables;
  }

 private:
  BrunetonChoices choices_;
};

TEST(BrunetonRepairs, RenderersReadTransmittancesInHalfFloats) {
  TableSizes sizes;
  sizes.scattering_r = sizes.scattering_ground = sizes.scattering_sky = sizes.scattering_mu_s =
      sizes.scattering_azimuth = 2;
  const auto table = [&](const BrunetonChoices& choices) {
    return compute_tables_of(Dark(choices), earth(), color_rule(refs::standard_spectral_data()),
                             sizes, 1, {})
        .optical_depth;
  };
  const Table depth = table({}), half = table({BrunetonTransmittance::kInHalfFloats});
  ASSERT_EQ(half.rgba.size(), depth.rgba.size());
  for (std::size_t i = 0; i < depth.rgba.size(); ++i)
    ASSERT_EQ(double{half.rgba[i]}, rounded_to_half(std::exp(-double{depth.rgba[i]})));
}

}  // namespace
}  // namespace skyfit
