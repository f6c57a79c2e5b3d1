// SPDX-License-Identifier: Apache-2.0
#include "model/tables/diffuse_source.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

#include "model/numerics/kernels.h"
#include "model/tables/table_kernels.h"

namespace skyfit {
namespace {

constexpr bool kDeepTwilight = true;  // tables know all suns
constexpr int kZeniths = 91;          // of the table: even steps of the view zenith

// docs/theory (9.12).
// cos m phi = sum_k row[m][k] cos(4 [k / 4] phi) cos^(k mod 4) phi: by Chebyshev's polynomials up
// to m = 3, further on by cos (4 b + j) phi = 2 cos 4 b phi cos j phi - cos (4 b - j) phi. Powers
// of cos phi alone would have coefficients of 2^(m - 1), which cancel.
std::vector<std::vector<double>> block_rows(std::size_t modes) {
  constexpr std::size_t kPowers = DiffuseSource::kPowers;
  constexpr double kChebyshev[kPowers][kPowers] = {
      {1, 0, 0, 0}, {0, 1, 0, 0}, {-1, 0, 2, 0}, {0, -3, 0, 4}};
  std::vector<std::vector<double>> row(modes, std::vector<double>(modes));
  for (std::size_t m = 0; m < modes; ++m) {
    const std::size_t j = m % kPowers, first = m - j;
    const bool two_terms = first > 0 && j > 0;
    if (two_terms) {
      for (std::size_t k = 0; k < modes; ++k) row[m][k] = -row[first - j][k];
    }
    for (std::size_t p = 0; p < kPowers; ++p)
      row[m][first + p] += (two_terms ? 2 : 1) * kChebyshev[j][p];
  }
  return row;
}

// Blocks for three quarters of the modes: further ones change no sky by 0.2 %.
int blocks_of(int moments) { return 3 * moments / (4 * DiffuseSource::kPowers); }

// Fields of the same wavelengths.
void add(const std::vector<DiffuseField>& more, std::vector<DiffuseField>& to) {
  for (std::size_t w = 0; w < to.size(); ++w) {
    for (std::size_t m = 0; m < to[w].moments.size(); ++m)
      std::ranges::transform(more[w].moments[m], to[w].moments[m], to[w].moments[m].begin(),
                             std::plus<>());
  }
}

}  // namespace

DiffuseSource::DiffuseSource(const Shells& shells, const NodeOptics& optics,
                             const std::vector<double>& heights, const ReferenceOptions& options,
                             const TableLight& light)
    : moments_(options.moments),
      blocks_(blocks_of(options.moments)),
      suns_(shells),
      levels_(shells, field_grid(shells, options.levels, kDeepTwilight).levels) {
  const int count = static_cast<int>(heights.size());
  for (const Scatterer<0>& scatterer : optics[0].scatterers) {
    const int blocks = scatterer.moments.size() <= kPowers ? 1 : blocks_;
    kept_.push_back({blocks, std::vector<float>(index(count, 0, blocks))});
  }
  if (light.orders == 1) return;
  std::vector<double> sun_mu;
  for (int i = 0; i < suns_.size(); ++i) sun_mu.push_back(suns_.mu(i));
  std::vector<int> all(sun_mu.size());
  std::iota(all.begin(), all.end(), 0);
  const Streams streams(shells.bottom_radius, levels_.heights(), options.streams,
                        field_grid(shells, options.levels, kDeepTwilight).limb_rays);
  const int shifted = shifted_modes(options.moments, false);
  const HorizontalCoupling coupling =
      sun_coupling(suns_, shells, all, streams, first_coupled_sun(suns_, shells), shifted);
  const auto fields_of = [&](int order) {
    return solve_diffuse_fields<0>(shells, optics, 1, levels_.heights(), sun_mu, streams, coupling,
                                   {.moments = options.moments,
                                    .order = order,
                                    .deep_twilight = kDeepTwilight,
                                    .shifted_modes = shifted,
                                    .polarised = light.transfer == Transfer::kVector,
                                    .levels = levels_.asked()});
  };
  std::vector<DiffuseField> fields = fields_of(light.orders == 0 ? 0 : 1);
  for (int order = 2; order < light.orders; ++order) add(fields_of(order), fields);
  tbb::parallel_for(0, count, [&](int i) {
    tabulate(i, levels_.coordinate(heights[static_cast<std::size_t>(i)]), optics, fields);
  });
}

std::size_t DiffuseSource::index(int height, int zenith, int blocks) const {
  return (static_cast<std::size_t>(height) * kZeniths + zenith) * (suns_.size() + 1) * blocks *
         kBlock;
}

// source(phi) = sum_m (2 - delta_m0) cos(m phi) sum_l chi_l Lambda_lm(mu) M_lm
void DiffuseSource::tabulate(int height, double level, const NodeOptics& optics,
                             const std::vector<DiffuseField>& fields) {
  const std::size_t modes = static_cast<std::size_t>(blocks_) * kPowers;
  const std::vector<std::vector<double>> rows = block_rows(modes);
  const auto suns = static_cast<std::size_t>(suns_.size());
  const LevelStencil levels = levels_.stencil(level);
  std::vector<double> lambda(static_cast<std::size_t>(moments_)), series(suns);
  auto add = [&](float* out, int blocks, std::size_t wavelength, std::size_t m) {
    for (std::size_t p = m % 2; p <= m; p += 2) {
      const double factor = (m == 0 ? 1 : 2) * rows[m][p];
      float* to = out + p / kPowers * kBlock + wavelength * kPowers + p % kPowers;
      to[0] += static_cast<float>((p % 2 == 0 ? factor : -factor) * series[1]);
      for (std::size_t j = 0; j < suns; ++j)
        to[(j + 1) * blocks * kBlock] += static_cast<float>(factor * series[j]);
    }
  };
  for (std::size_t m = 0; m < modes; ++m) {
    std::array<std::vector<double>, 4> moments;  // [l - m][sun]
    for (std::size_t k = 0; k < fields.size(); ++k) {
      if (m >= fields[k].moments.size()) continue;
      const std::size_t size = fields[k].shape.level(static_cast<int>(m));
      moments[k].resize(size);
      for (std::size_t i = 0; i < levels.share.size(); ++i)
        kernels::add_scaled(levels.share[i],
                            fields[k].moments[m].data() + (levels.first + i) * size,
                            moments[k].data(), size);
    }
    for (int i = 0; i < kZeniths; ++i) {
      normalised_legendre(static_cast<int>(m), moments_,
                          std::cos(std::numbers::pi * i / (kZeniths - 1)), lambda.data());
      for (std::size_t k = 0; k < fields.size(); ++k) {
        if (moments[k].empty()) continue;
        for (std::size_t n = 0; n < kept_.size(); ++n) {
          const std::vector<Dual<0>>& chi = optics[k].scatterers[n].moments;
          std::fill(series.begin(), series.end(), 0.0);
          for (std::size_t l = m; l < std::min(lambda.size(), chi.size()); ++l)
            kernels::add_scaled(lambda[l - m] * chi[l].v, &moments[k][(l - m) * suns],
                                series.data(), suns);
          if (fields[k].shape.polarised_mode(static_cast<int>(m)) &&
              polarises(optics[k].scatterers[n])) {
            // docs/theory (13.6): the row after the moments of I.
            kernels::add_scaled(lambda[2 - m] * chi[2].v, &moments[k][(lambda.size() - m) * suns],
                                series.data(), suns);
          }
          if (m < chi.size())
            add(&kept_[n].values[index(height, i, kept_[n].blocks)], kept_[n].blocks, k, m);
        }
      }
    }
  }
}

void DiffuseSource::add_slice(int height, double mu, std::span<const NodeValues> factors,
                              std::vector<float>& out) const {
  const double x = std::acos(std::clamp(mu, -1.0, 1.0)) / std::numbers::pi * (kZeniths - 1);
  const int column = std::min(static_cast<int>(x), kZeniths - 2);
  const auto part = static_cast<float>(x - column);
  for (std::size_t n = 0; n < kept_.size(); ++n) {
    std::array<float, 4> factor;
    for (std::size_t k = 0; k < 4; ++k) factor[k] = static_cast<float>(factors[n][k]);
    const Kept& kept = kept_[n];
    kernels::add_source(&kept.values[index(height, column, kept.blocks)],
                        &kept.values[index(height, column + 1, kept.blocks)], part, factor.data(),
                        static_cast<std::size_t>(suns_.size() + 1),
                        static_cast<std::size_t>(kept.blocks), static_cast<std::size_t>(blocks_),
                        out.data());
  }
}

}  // namespace skyfit
