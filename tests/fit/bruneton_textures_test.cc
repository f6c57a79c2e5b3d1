// SPDX-License-Identifier: Apache-2.0
// Read as the shaders of Bruneton 2017 do, the textures give the sky of the reference.
#include "fit/exchange/bruneton_textures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "fit/exchange/engines.h"
#include "model/irradiance.h"
#include "tests/fit/exchange.h"

namespace skyfit::fit {
namespace {

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
