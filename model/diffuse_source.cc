// SPDX-License-Identifier: Apache-2.0
#include "model/diffuse_source.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

namespace skyfit {
namespace {

constexpr int kLevels = 40, kStreams = 16;
constexpr int kMu = 49, kAzimuths = 19;  // of the table: even steps of the cosine and of the angle
constexpr int kStencils = 16384;
constexpr double kPi = std::numbers::pi;

// source(phi) = sum_m (2 - delta_m0) cos(m phi) sum_l chi_l Lambda_lm(mu) M_lm
void add_mode(const DiffuseField& field, int level, int m, const std::vector<double>& lambda_chi,
              std::vector<double>& by_azimuth) {
  const auto suns = static_cast<std::size_t>(field.shape.suns);
  std::vector<double> series(suns, 0.0);
  for (std::size_t row = 0; row < lambda_chi.size(); ++row) {
    if (lambda_chi[row] == 0) continue;
    const double* from = field.moments[static_cast<std::size_t>(m)].data() +
                         static_cast<std::size_t>(level) * field.shape.level(m) +
                         row * field.shape.row();
    for (std::size_t j = 0; j < suns; ++j) series[j] += lambda_chi[row] * from[j];
  }
  for (int a = 0; a < kAzimuths; ++a) {
    const double wave = (m == 0 ? 1 : 2) * std::cos(m * kPi * a / (kAzimuths - 1));
    for (std::size_t j = 0; j < suns; ++j) by_azimuth[j * kAzimuths + a] += wave * series[j];
  }
}

// Finest where the field changes fastest, about the horizon; below 108 degrees it is dark.
SunGrid sun_grid() {
  std::vector<double> zenith;
  for (double degrees = 0; degrees < 108.5; degrees += degrees < 60 ? 6 : degrees < 80 ? 4 : 2)
    zenith.push_back(degrees * kPi / 180);
  return SunGrid(std::move(zenith));
}

// First of the four nodes about x in a descending list, and the weights of the cubic through them
// (Lagrange).
int cubic_stencil(const std::vector<double>& nodes, double x, std::array<float, 4>& weight) {
  const auto below = std::lower_bound(nodes.begin(), nodes.end(), x, std::greater<>());
  const auto first = std::clamp<std::ptrdiff_t>(below - nodes.begin() - 2, 0,
                                                static_cast<std::ptrdiff_t>(nodes.size()) - 4);
  const double* node = nodes.data() + first;
  for (std::size_t i = 0; i < 4; ++i) {
    double product = 1;
    for (std::size_t j = 0; j < 4; ++j) {
      if (j != i) product *= (x - node[j]) / (node[i] - node[j]);
    }
    weight[i] = static_cast<float>(product);
  }
  return static_cast<int>(first);
}

}  // namespace

DiffuseSource::DiffuseSource(const Shells& shells, const NodeOptics& optics) : shells_(shells) {
  const SunGrid grid = sun_grid();
  for (int i = 0; i < grid.size(); ++i) sun_mu_.push_back(grid.mu(i));
  std::vector<int> all(sun_mu_.size());
  std::iota(all.begin(), all.end(), 0);
  const std::vector<double> heights = level_heights(shells.top, kLevels);
  const RayFan fan(shells.bottom_radius, heights, kStreams);
  const SunCoupling coupling = sun_coupling(grid, all, fan, first_coupled_sun(grid, shells));
  const std::vector<DiffuseField> fields =
      solve_diffuse_fields<0>(shells, optics, 1, heights, sun_mu_, fan, coupling, {kSourceMoments});
  const std::size_t size = index(kLevels, 0);
  air_.resize(size);
  aerosol_.resize(size);
  for (std::size_t node = 0; node < 4; ++node) tabulate(optics[node], fields[node], node);

  const double lowest = sun_mu_.back();
  for (int i = 0; i < kStencils; ++i) {
    Stencil stencil{};
    stencil.first =
        cubic_stencil(sun_mu_, lowest + (1 - lowest) * i / (kStencils - 1.0), stencil.weight);
    stencils_.push_back(stencil);
  }
}

std::size_t DiffuseSource::index(int level, int mu) const {
  return (static_cast<std::size_t>(level) * kMu + mu) * sun_mu_.size() * kAzimuths * 4;
}

void DiffuseSource::tabulate(const Optics<0>& optics, const DiffuseField& field, std::size_t node) {
  tbb::parallel_for(0, kLevels, [&](int level) {
    std::vector<double> lambda(kSourceMoments);
    const auto count = sun_mu_.size() * kAzimuths;
    for (int i = 0; i < kMu; ++i) {
      std::vector<double> air(count, 0.0), aerosol(count, 0.0);
      for (int m = 0; m < kSourceMoments; ++m) {
        if (static_cast<std::size_t>(m) >= field.moments.size()) break;
        normalised_legendre(m, kSourceMoments, 2.0 * i / (kMu - 1) - 1, lambda.data());
        std::vector<double> of_air, of_aerosol;
        for (int l = m; l < kSourceMoments; ++l) {
          const auto at = static_cast<std::size_t>(l);
          const double value = lambda[at - static_cast<std::size_t>(m)];
          of_aerosol.push_back(value * optics.moments[at].v);
          if (at < optics.air_moments.size()) of_air.push_back(value * optics.air_moments[at]);
        }
        add_mode(field, level, m, of_air, air);
        add_mode(field, level, m, of_aerosol, aerosol);
      }
      const std::size_t base = index(level, i);
      for (std::size_t k = 0; k < count; ++k) {
        air_[base + 4 * k + node] = static_cast<float>(air[k]);
        aerosol_[base + 4 * k + node] = static_cast<float>(aerosol[k]);
      }
    }
  });
}

void DiffuseSource::slice(double height, double mu, const std::array<double, 4>& air,
                          const std::array<double, 4>& aerosol, Slice& out) const {
  out.source_ = this;
  out.value_.assign(index(0, 1), 0.0f);
  // The levels' own coordinate, in which the source is nearly linear.
  const double y = level_coordinate(height, shells_.top, kLevels);
  const double x = std::clamp(0.5 * mu + 0.5, 0.0, 1.0) * (kMu - 1);
  const int level = std::min(static_cast<int>(y), kLevels - 2),
            column = std::min(static_cast<int>(x), kMu - 2);
  for (int corner = 0; corner < 4; ++corner) {
    const int up = corner / 2, right = corner % 2;
    const double weight = (up ? y - level : 1 - y + level) * (right ? x - column : 1 - x + column);
    std::array<float, 4> a, b;
    for (std::size_t k = 0; k < 4; ++k) {
      a[k] = static_cast<float>(weight * air[k]);
      b[k] = static_cast<float>(weight * aerosol[k]);
    }
    const float* from_air = &air_[index(level + up, column + right)];
    const float* from_aerosol = &aerosol_[index(level + up, column + right)];
    for (std::size_t i = 0; i < out.value_.size(); i += 4) {
      for (std::size_t k = 0; k < 4; ++k)
        out.value_[i + k] += a[k] * from_air[i + k] + b[k] * from_aerosol[i + k];
    }
  }
}

void DiffuseSource::Slice::add(double mu_s, double cos_azimuth, float* sum) const {
  const double lowest = source_->sun_mu_.back();
  const double entry = std::clamp((mu_s - lowest) / (1 - lowest), 0.0, 1.0) * (kStencils - 1);
  const Stencil& stencil = source_->stencils_[static_cast<std::size_t>(entry + 0.5)];
  const double turn = std::acos(std::clamp(cos_azimuth, -1.0, 1.0)) / kPi * (kAzimuths - 1);
  const int azimuth = std::min(static_cast<int>(turn), kAzimuths - 2);
  const auto part = static_cast<float>(turn - azimuth);
  for (std::size_t j = 0; j < 4; ++j) {
    const float* at =
        &value_[((static_cast<std::size_t>(stencil.first) + j) * kAzimuths + azimuth) * 4];
    const float near = stencil.weight[j] * (1 - part), far = stencil.weight[j] * part;
    for (std::size_t k = 0; k < 4; ++k) sum[k] += near * at[k] + far * at[k + 4];
  }
}

}  // namespace skyfit
