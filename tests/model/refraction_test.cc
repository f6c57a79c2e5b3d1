// SPDX-License-Identifier: Apache-2.0
// Curved rays: bending, columns, spreading and single scattering are those of rays that are traced
// step by step through the shells.
#include "model/atmosphere/refraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "data_refs/spectra.h"
#include "model/atmosphere/dry_air.h"
#include "model/atmosphere/optics.h"
#include "model/atmosphere/preset.h"
#include "model/solver/reference_model.h"
#include "tests/atmospheres.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180, kBlue = 440;

// dr/ds = cos z, dphi/ds = sin z / r, dz/ds = -sin z (1/r + d ln n / dr) by Runge and Kutta.
class TracedAir {
 public:
  TracedAir(const Atmosphere<double>& a, double nm)
      : atmosphere_(a),
        bottom_(a.bottom_radius_m),
        top_(a.top_radius_m),
        height_(a.at("rayleigh").profile.scale_height_m),
        refractivity_(refractive_index_of_air(nm, 400) - 1) {}

  struct State {
    double r, z, phi, air = 0, aerosol = 0;  // columns of density 1
  };
  State slope(const State& at) const {
    const double h = at.r - bottom_, n1 = refractivity_ * std::exp(-h / height_);
    return {std::cos(at.z), -std::sin(at.z) * (1 / at.r - n1 / (1 + n1) / height_),
            std::sin(at.z) / at.r, std::exp(-h / height_),
            std::exp(-h / atmosphere_.at("mie").profile.scale_height_m)};
  }
  State step(const State& at, double ds) const {
    const auto ahead = [&](const State& d, double f) {
      return State{at.r + f * d.r, at.z + f * d.z, at.phi + f * d.phi, at.air + f * d.air,
                   at.aerosol + f * d.aerosol};
    };
    const State a = slope(at), b = slope(ahead(a, 0.5 * ds)), c = slope(ahead(b, 0.5 * ds)),
                d = slope(ahead(c, ds));
    const auto mean = [&](double State::*m) { return (a.*m + 2 * (b.*m + c.*m) + d.*m) / 6; };
    return ahead({mean(&State::r), mean(&State::z), mean(&State::phi), mean(&State::air),
                  mean(&State::aerosol)},
                 ds);
  }
  // Out of the air; nothing when the ray meets the ground.
  std::optional<State> outward(double r, double z) const {
    State at{r, z, 0};
    while (at.r < top_) {
      const double h = at.r - bottom_;
      at = step(at, 300 + 0.1 * h);
      if (at.r < bottom_) return {};
    }
    return at;
  }
  double true_zenith(double r, double z) const {
    const auto end = outward(r, z);
    return end ? end->z + end->phi : std::numeric_limits<double>::quiet_NaN();
  }
  // From which zenith angle the light of a star at `zenith` arrives; none behind the planet.
  std::optional<double> apparent(double r, double zenith) const {
    // The true zenith angle rises with the apparent one by a little more than 1.
    double apparent = zenith;
    for (int i = 0; i < 8; ++i) apparent -= true_zenith(r, apparent) - zenith;
    if (std::isnan(apparent)) return {};
    return apparent;
  }
  double index(double r) const { return 1 + refractivity_ * std::exp(-(r - bottom_) / height_); }
  double bottom() const { return bottom_; }
  double top() const { return top_; }

 private:
  const Atmosphere<double>& atmosphere_;
  double bottom_, top_, height_, refractivity_;
};

Atmosphere<double> earth() {
  Atmosphere<double> a;
  set_scattering(a.at("mie"), 550, 3e-5, 1.3);
  a.at("mie").phase = {PhaseType::kHenyeyGreenstein, 0.5, 0, 0, 0};
  a.at("ozone").amount = 0;
  a.ground_albedo = 0;
  return a;
}

TEST(Refraction, BendsAsTracedRaysDo) {
  const Atmosphere<double> a = earth();
  const Refraction refraction(a, kBlue);
  const TracedAir traced(a, kBlue);
  for (const double height : {0.0, 500.0, 8e3, 20e3}) {
    for (const double z : {1.0, 45.0, 75.0, 85.0, 88.0, 89.5, 90.0, 91.0}) {
      if (height == 0 && z > 90) continue;
      if (height == 500 && z > 90) continue;
      const double x = refraction.refractive_height(height);
      const double bending =
          traced.true_zenith(traced.bottom() + height, z * kDegree) - z * kDegree;
      EXPECT_NEAR(refraction.bending(x, z * kDegree), bending, 2e-3 * bending + 1e-8)
          << height << " m, " << z << " deg";
      EXPECT_NEAR(refraction.apparent_zenith(x, z * kDegree + bending), z * kDegree,
                  2e-3 * bending + 1e-6);
    }
  }
  // Half a degree at the horizon, a minute of arc at 45 deg.
  EXPECT_NEAR(refraction.bending(0, 45 * kDegree) / kDegree * 60, 1, 0.05);
}

TEST(Refraction, ColumnsAreThoseOfTracedRays) {
  const Atmosphere<double> a = earth();
  const Refraction refraction(a, kBlue);
  const TracedAir traced(a, kBlue);
  const Shells shells = refraction.refracted(shells_of(a, Keep::kWhatMatters));
  for (const double height : {0.0, 3e3}) {
    for (const double z : {0.0, 60.0, 80.0, 88.0, 90.0}) {
      const PathColumns columns =
          shells.columns_to_top(refraction.refractive_height(height), std::cos(z * kDegree));
      const auto end = traced.outward(traced.bottom() + height, z * kDegree);
      EXPECT_NEAR(columns[0].value / end->air, 1, 1.2e-3) << height << " m, " << z << " deg";
      EXPECT_NEAR(columns[1].value / end->aerosol, 1, 1.2e-3) << height << " m, " << z << " deg";
    }
  }
}

// Power is kept: what falls on a ring about the axis to the sun, b db outside, is on the ground
// cos z_a sin z_t dz_t times the irradiance.
TEST(Refraction, SpreadsTheBeamAsTracedRaysDo) {
  const Atmosphere<double> a = earth();
  const Refraction refraction(a, kBlue);
  const TracedAir traced(a, kBlue);
  for (const double z : {5.0, 60.0, 80.0, 88.0, 89.8}) {
    const double step = 0.01 * kDegree, r = traced.bottom(), n = traced.index(r);
    const double wide =
        traced.true_zenith(r, z * kDegree + step) - traced.true_zenith(r, z * kDegree - step);
    const double expected = n * n * std::sin(z * kDegree) /
                            std::sin(traced.true_zenith(r, z * kDegree)) * 2 * step / wide;
    const double index = refraction.refractive_index(0);
    EXPECT_NEAR(index * index * refraction.beam_spread(0, z * kDegree), expected, 1e-3) << z;
  }
  EXPECT_NEAR(refraction.refractive_index(0), traced.index(traced.bottom()), 1e-12);
}

// Light scattered once along a traced ray, by air and aerosol.
double traced_light(const Atmosphere<double>& a, const SkyPoint& point) {
  const TracedAir traced(a, kBlue);
  const Constituent<double>&air = a.at("rayleigh"), &mie = a.at("mie");
  const double of_air = air.amount * std::pow(kBlue / air.wavelength_nm, -air.angstrom_exponent);
  const double of_mie = mie.amount * std::pow(kBlue / mie.wavelength_nm, -mie.angstrom_exponent);
  const double taken = of_mie / mie.single_scattering_albedo, g = mie.phase.g;
  const double sun_up = std::cos(point.sun_zenith),
               sun_forward = std::sin(point.sun_zenith) * std::cos(point.relative_azimuth),
               sun_right = std::sin(point.sun_zenith) * std::sin(point.relative_azimuth);
  const double observer = traced.bottom() + point.altitude_m;
  const auto source = [&](const TracedAir::State& middle) {
    const double up = std::cos(middle.phi) * sun_up + std::sin(middle.phi) * sun_forward,
                 forward = std::cos(middle.phi) * sun_forward - std::sin(middle.phi) * sun_up;
    const double true_zenith = std::acos(std::clamp(up, -1.0, 1.0));
    const auto apparent = traced.apparent(middle.r, true_zenith);
    if (!apparent) return 0.0;
    const auto to_sun = traced.outward(middle.r, *apparent);
    if (!to_sun) return 0.0;
    const double small = 1e-4;
    const double spread = std::sin(*apparent) / std::sin(true_zenith) * 2 * small /
                          (traced.true_zenith(middle.r, *apparent + small) -
                           traced.true_zenith(middle.r, *apparent - small));
    if (std::isnan(spread)) return 0.0;  // it grazes the ground and is dark
    const double across = std::hypot(forward, sun_right);
    const double nu = std::cos(middle.z) * std::cos(*apparent) +
                      std::sin(middle.z) * std::sin(*apparent) * forward / across;
    const double depth =
        of_air * (middle.air + to_sun->air) + taken * (middle.aerosol + to_sun->aerosol);
    const double p_air = 3 / (16 * kPi) * (1 + nu * nu);
    const double p_mie = (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * nu, 1.5));
    const TracedAir::State density = traced.slope(middle);
    return spread * std::exp(-depth) *
           (of_air * density.air * p_air + of_mie * density.aerosol * p_mie);
  };
  TracedAir::State at{observer, point.view_zenith, 0};
  double light = 0;
  while (at.r < traced.top()) {
    const double ds = 300 + 0.1 * (at.r - traced.bottom());
    for (const double place : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)})  // Gauss
      light += 0.5 * ds * source(traced.step(at, place * ds));
    at = traced.step(at, ds);
  }
  const double n = traced.index(observer);
  return n * n * light;
}

TEST(Refraction, SingleScatteringIsThatOfTracedRays) {
  const Atmosphere<double> a = earth();
  ReferenceOptions options;
  options.order = 1;
  options.refraction = true;
  options.transfer = Transfer::kScalar;
  options.threads = 2;
  const ReferenceModel model(options);
  options.refraction = false;
  const ReferenceModel straight(options);
  std::vector<SkyPoint> points;
  for (const double sun : {30.0, 80.0, 88.0}) {
    for (const double view : {0.0, 70.0, 89.0})
      points.push_back({0, sun * kDegree, view * kDegree, 0.3});
  }
  const auto nodes = spectral_nodes(refs::standard_spectral_data(), {kBlue});
  const SkyValues curved = model.radiance(a, nodes, points, {}),
                  plain = straight.radiance(a, nodes, points, {});
  double worst = 0, most = 0;
  for (int i = 0; i < curved.points; ++i) {
    const double expected = traced_light(a, points[static_cast<std::size_t>(i)]);
    EXPECT_NEAR(curved.at(i, 0) / expected, 1, 1e-3)
        << points[static_cast<std::size_t>(i)].sun_zenith / kDegree << " "
        << points[static_cast<std::size_t>(i)].view_zenith / kDegree << " "
        << points[static_cast<std::size_t>(i)].relative_azimuth / kDegree;
    worst = std::max(worst, std::abs(curved.at(i, 0) / expected - 1));
    most = std::max(most, std::abs(plain.at(i, 0) / expected - 1));
  }
  std::printf("[   worst ] curved %.2f %%, straight %.1f %%\n", 100 * worst, 100 * most);
  EXPECT_GT(most, 0.05);
}

TEST(Refraction, DerivativesAreThoseOfDifferences) {
  const Atmosphere<double> a = earth();
  ReferenceOptions options;
  options.refraction = true;
  const ReferenceModel model(options);
  const std::vector<SkyPoint> points = {{0, 80 * kDegree, 60 * kDegree, 1},
                                        {0, 80 * kDegree, 88 * kDegree, 0.2}};
  const auto nodes = spectral_nodes(refs::standard_spectral_data(), {440, 600});
  for (const Parameter& id : {Parameter::kMieScattering, Parameter::kMieScaleHeight}) {
    const SkyValues exact = model.radiance(a, nodes, points, {&id, 1});
    const double step = 1e-4 * get_parameter(a, id);
    Atmosphere<double> low = a, high = a;
    set_parameter(low, id, get_parameter(a, id) - step);
    set_parameter(high, id, get_parameter(a, id) + step);
    const SkyValues below = model.radiance(low, nodes, points, {}),
                    above = model.radiance(high, nodes, points, {});
    for (std::size_t i = 0; i < exact.value.size(); ++i) {
      const double difference = (above.value[i] - below.value[i]) / (2 * step);
      EXPECT_NEAR(exact.derivative[i], difference, 1e-5 * std::abs(difference)) << id.name();
    }
  }
}

// Also on the limb, where the bending changes faster than the zenith angle.
TEST(Refraction, ApparentZenithIsTheOneThatIsBentToTheTrueOne) {
  const Atmosphere<double> a = earth();
  const Refraction refraction(a, kBlue);
  for (const double height_m : {0.0, 10e3, 400e3}) {
    const double height = refraction.refractive_height(height_m),
                 limb = kPi - std::asin(a.bottom_radius_m / (a.bottom_radius_m + height_m));
    for (const double above : {60.0, 20.0, 1.0, 0.5, 0.2, 0.0, -0.3, -0.5}) {
      const double true_zenith = limb - above * kDegree,
                   seen = refraction.apparent_zenith(height, true_zenith);
      EXPECT_LE(seen, true_zenith);
      EXPECT_NEAR(seen + refraction.bending(height, seen), true_zenith, 1e-9)
          << height_m << " m, " << above << " deg above the horizon";
    }
  }
}

TEST(Refraction, WithoutAirThereIsNone) {
  Atmosphere<double> a = earth();
  std::erase_if(a.constituents, [](const auto& c) { return c.name == "rayleigh"; });
  const Refraction refraction(a, kBlue);
  EXPECT_EQ(refraction.bending(0, 1.5), 0);
  EXPECT_EQ(refraction.beam_spread(0, 1.5), 1);
  ReferenceOptions options;
  const ReferenceModel straight(options);
  options.refraction = true;
  const ReferenceModel curved(options);
  const std::vector<SkyPoint> points = {{0, 1.3, 1.0, 0.5}};
  const auto nodes = spectral_nodes(refs::standard_spectral_data(), {kBlue});
  EXPECT_NEAR(curved.radiance(a, nodes, points, {}).value[0] /
                  straight.radiance(a, nodes, points, {}).value[0],
              1, 1e-3);
}

}  // namespace
}  // namespace skyfit
