// SPDX-License-Identifier: Apache-2.0
// Lognormal particles scatter as the integral over their spheres, which has the closed forms of
// small and of absorbing ones; derivatives equal central differences; panels of angles integrate
// and interpolate polynomials.
#include "model/atmosphere/particles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "model/atmosphere/mie.h"
#include "model/base/content_cache.h"
#include "model/base/temporary_directory.h"
#include "tests/model/truth.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;
using Complex = std::complex<double>;

const ParticleMode kFine{550, 0.15, 0.45, {1.45, 0.005}};
const ParticleMode kCoarse{550, 2, 0.6, {1.53, 0.006}};
const ParticleMode kSoot{440, 0.05, 0.7, {1.75, 0.45}};

// Even steps of the logarithm of the radius to where nothing is left, without tables or panels.
struct Sums {
  double extinction = 0, scattering = 0, asymmetry = 0, phase[2] = {0, 0}, polarising[2] = {0, 0};
};
constexpr double kAngles_deg[2] = {20, 85};
Sums by_quadrature(const ParticleMode& mode) {
  const std::vector<double> cosines = {std::cos(kAngles_deg[0] * kPi / 180),
                                       std::cos(kAngles_deg[1] * kPi / 180)};
  constexpr double kStep = 0.002, kReach = 5.5;
  Sums s;
  for (double u = -kReach; u < kReach; u += kStep / mode.width) {
    const double radius = mode.radius_um * std::exp(u * mode.width);
    const double x = 2e3 * kPi * radius / mode.wavelength_nm;
    const double weight =
        0.75 / radius * kStep / mode.width * std::exp(-0.5 * u * u) / std::sqrt(2 * kPi);
    const MieCoefficients c = mie_coefficients(x, mode.index, false);
    const MieEfficiencies q = mie_efficiencies(x, c);
    const MieMatrix matrix = mie_matrix(x, c, cosines).front();
    s.extinction += weight * q.extinction;
    s.scattering += weight * q.scattering;
    s.asymmetry += weight * q.scattering * mie_asymmetry(x, c);
    for (std::size_t i = 0; i < 2; ++i) {
      s.phase[i] += weight * matrix.m11[i];
      s.polarising[i] += weight * matrix.m12[i];
    }
  }
  return s;
}

TEST(Particles, AreTheIntegralOverTheirSpheres) {
  for (const ParticleMode& mode : {kFine, kCoarse, kSoot}) {
    const Sums s = by_quadrature(mode);
    const auto optics = ParticleTables().optics(mode, false);
    // The cut-off, and oscillations between the sizes of the tables, which are largest sideways.
    constexpr double kCut = 3e-5, kSampled = 3e-3;
    const bool large = mode.radius_um > 1;
    EXPECT_NEAR(optics->extinction[0] / s.extinction, 1, large ? 3e-4 : kCut);
    EXPECT_NEAR(optics->scattering[0] / s.scattering, 1, large ? 3e-4 : kCut);
    EXPECT_NEAR(optics->moment(1)[0], s.asymmetry / s.scattering, 3e-4);
    for (std::size_t i = 0; i < 2; ++i) {
      const double angle = kAngles_deg[i] * kPi / 180, phase = s.phase[i] / s.scattering;
      EXPECT_NEAR(optics->phase(angle)[0], phase, (large ? kSampled : 1e-4) * phase);
      EXPECT_NEAR(optics->polarising_phase(angle)[0], s.polarising[i] / s.scattering,
                  (large ? kSampled : 1e-4) * phase);
    }
  }
}

// The fine aerosol of a benchmark: effective radius 0.2 um, geometric standard
// deviation 1.6, index 1.45 + 0.01 i at 550 nm; its single scattering albedo is 0.944282.
TEST(Particles, HaveTheScatteringMatrixOfTheTruth) {
  const double width = std::log(1.6), radius = 0.2 * std::exp(0.5 * width * width);
  const auto optics = ParticleTables().optics({550, radius, width, {1.45, 0.01}}, false);
  EXPECT_NEAR(optics->scattering[0] / optics->extinction[0], 0.944282, 2e-6);
  for (const truth::Row& row : truth::read_rows("mie_fine_550nm.csv")) {
    const double angle = row.number(0) * kPi / 180, phase = row.number(1) / (4 * kPi);
    constexpr double kCut = 3e-4;  // of the largest particles, straight ahead
    EXPECT_NEAR(optics->phase(angle)[0], phase, kCut * phase) << row.number(0);
    EXPECT_NEAR(optics->polarising_phase(angle)[0], row.number(5) / (4 * kPi), kCut * phase)
        << row.number(0);
  }
}

// Per volume, with m^2 - 1 over m^2 + 2 = K: absorption is 6 pi Im(K) / wavelength, whatever the
// sizes; scattering is 2 k^4 |K|^2 / (3) times the mean of r^3, r_V^3 exp(4.5 sigma^2).
TEST(Particles, OfSmallSpheresAreRayleighs) {
  const ParticleMode mode{550, 0.001, 0.3, {1.6, 0.1}};
  const auto optics = ParticleTables().optics(mode, false);
  const Complex ratio = (mode.index * mode.index - 1.0) / (mode.index * mode.index + 2.0);
  const double wave = 2 * kPi / 0.55;
  const double scattering = 2 * std::pow(wave, 4) * std::norm(ratio) * std::pow(mode.radius_um, 3) *
                            std::exp(4.5 * mode.width * mode.width);
  constexpr double kNextOrder = 1e-3;
  EXPECT_NEAR(optics->scattering[0] / scattering, 1, kNextOrder);
  const double absorption = optics->extinction[0] - optics->scattering[0];
  EXPECT_NEAR(absorption / (3 * wave * ratio.imag()), 1, kNextOrder);
  for (const double nu : {-0.9, 0.0, 0.6}) {
    const double unit = 3 / (16 * kPi);
    EXPECT_NEAR(optics->phase(std::acos(nu))[0], unit * (1 + nu * nu), 1e-4);
    EXPECT_NEAR(optics->polarising_phase(std::acos(nu))[0], unit * (nu * nu - 1), 1e-4);
  }
  EXPECT_NEAR(optics->moment(2)[0], 0.1, 1e-4);
}

TEST(Particles, ArePositiveAndIntegrateToOne) {
  for (const ParticleMode& mode :
       {kFine, kCoarse, kSoot, ParticleMode{550, 10, 0.3, {1.333, 1e-9}}}) {
    const auto optics = ParticleTables().optics(mode, false);
    EXPECT_NEAR(optics->moment(0)[0], 1, 1e-13);
    for (double degrees = 0; degrees <= 180; degrees += 0.05) {
      const double angle = degrees * kPi / 180, phase = optics->phase(angle)[0];
      EXPECT_GT(phase, 0) << degrees;
      EXPECT_LE(std::abs(optics->polarising_phase(angle)[0]), phase) << degrees;
    }
  }
}

TEST(Particles, DerivativesAreExact) {
  const std::function<double&(ParticleMode&)> kParts[] = {
      [](ParticleMode& m) -> double& { return m.radius_um; },
      [](ParticleMode& m) -> double& { return m.width; },
      [](ParticleMode& m) -> double& { return reinterpret_cast<double(&)[2]>(m.index)[0]; },
      [](ParticleMode& m) -> double& { return reinterpret_cast<double(&)[2]>(m.index)[1]; }};
  using Quantity = std::function<ParticleValue(const ParticleOptics&)>;
  const Quantity kQuantities[] = {[](const ParticleOptics& o) { return o.extinction; },
                                  [](const ParticleOptics& o) { return o.scattering; },
                                  [](const ParticleOptics& o) { return o.matrix_moments(2).alpha; },
                                  [](const ParticleOptics& o) { return o.matrix_moments(3).zeta; },
                                  [](const ParticleOptics& o) { return o.matrix_moments(4).gamma; },
                                  [](const ParticleOptics& o) { return o.moment(5); },
                                  [](const ParticleOptics& o) { return o.phase(0.01); },
                                  [](const ParticleOptics& o) { return o.phase(1.5); },
                                  [](const ParticleOptics& o) { return o.polarising_phase(1.5); }};
  const ParticleTables tables;
  for (const ParticleMode& mode : {kFine, ParticleMode{550, 1, 0.5, {1.5, 0.02}}, kSoot}) {
    const auto exact = tables.optics(mode, true);
    for (std::size_t part = 0; part < 4; ++part) {
      ParticleMode more = mode, less = mode;
      const double step = part < 2 ? 1e-4 * kParts[part](more) : 2e-4;
      kParts[part](more) += step;
      kParts[part](less) -= step;
      const auto above = tables.optics(more, false), below = tables.optics(less, false);
      for (const Quantity& quantity : kQuantities) {
        const ParticleValue value = quantity(*exact);
        const double slope = (quantity(*above)[0] - quantity(*below)[0]) / (2 * step);
        // The step; single precision of tables of other indices; spheres that the cut-off lets in.
        const double difference = 3e-4 * std::abs(slope),
                     rounding = (part < 2 ? 0 : 1e-7) * std::max(std::abs(value[0]), 0.01) / step,
                     cut = part < 2 ? 1e-3 * std::abs(value[0]) / kParts[part](more) : 0;
        EXPECT_NEAR(value[1 + part], slope, difference + rounding + cut)
            << "radius " << mode.radius_um << ", part " << part << ", quantity "
            << &quantity - kQuantities;
      }
    }
  }
}

// What another process finds is what this one computed, bit by bit; a damaged entry is computed
// again, and without a cache nothing is written.
TEST(Particles, AreKeptInACache) {
  const TemporaryDirectory directory;
  const auto files = [&] {
    std::vector<std::filesystem::path> all;
    for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
      if (entry.is_regular_file()) all.push_back(entry.path());
    return all;
  };
  const auto values = [](bool by_index) {
    const auto optics = ParticleTables().optics(kFine, by_index);
    std::vector<ParticleValue> all = {optics->extinction, optics->scattering};
    for (const int l : {0, 3, 128}) {
      const ParticleOptics::MatrixMoments moments = optics->matrix_moments(l);
      all.insert(all.end(), {optics->moment(l), moments.alpha, moments.zeta, moments.gamma});
    }
    for (const double angle : {0.001, 1.2, 3.1})
      all.insert(all.end(), {optics->phase(angle), optics->polarising_phase(angle)});
    return all;
  };
  for (const bool by_index : {false, true}) {
    const std::vector<ParticleValue> computed = values(by_index);
    const std::size_t before = files().size();
    const auto cache = std::make_shared<ContentCache>(directory.path());
    keep_particles_in(cache);
    EXPECT_EQ(values(by_index), computed) << "kept";
    EXPECT_EQ(files().size(), before + 1);
    EXPECT_EQ(values(by_index), computed) << "found";
    EXPECT_EQ(files().size(), before + 1);
    EXPECT_EQ(cache->trouble(), std::nullopt);
    keep_particles_in(nullptr);
  }
  const std::vector<ParticleValue> computed = values(true);
  for (const std::filesystem::path& file : files()) {
    std::fstream damaged(file, std::ios::binary | std::ios::in | std::ios::out);
    damaged.seekp(static_cast<std::streamoff>(std::filesystem::file_size(file) / 2));
    damaged.put('!');
  }
  keep_particles_in(std::make_shared<ContentCache>(directory.path()));
  EXPECT_EQ(values(true), computed) << "damaged";
  keep_particles_in(nullptr);
}

TEST(Particles, RefuseSizesBeyondMie) {
  EXPECT_THROW(ParticleTables().optics({550, 500, 0.7, {1.33, 0}}, false), std::invalid_argument);
}

TEST(Particles, PanelsInterpolateAndIntegratePolynomials) {
  const AnglePanels panels;
  const auto moment_of = [&](int l, const std::function<double(double)>& f) {
    double sum = 0;
    for (std::size_t i = 0; i < panels.size(); ++i)
      sum += panels.moment(l)[i] * f(panels.cosines()[i]);
    return sum;
  };
  constexpr double kInterpolated = 1e-8;  // of order 8 over 12 deg
  EXPECT_NEAR(moment_of(0, [](double) { return 1.0; }), 4 * kPi, kInterpolated);
  EXPECT_NEAR(moment_of(2, [](double nu) { return 1.5 * nu * nu - 0.5; }), 4 * kPi / 5,
              kInterpolated);
  EXPECT_NEAR(moment_of(3, [](double nu) { return 1.5 * nu * nu - 0.5; }), 0, kInterpolated);
  for (const double angle : {0.0, 1e-4, 0.3, kPi / 2, 3.0, kPi}) {
    const AnglePanels::Weights w = panels.at(angle);
    double value = 0;
    for (std::size_t k = 0; k < AnglePanels::kNodes; ++k)
      value += w.weight[k] * panels.cosines()[w.first + k];
    EXPECT_NEAR(value, std::cos(angle), kInterpolated);
  }
}

}  // namespace
}  // namespace skyfit
