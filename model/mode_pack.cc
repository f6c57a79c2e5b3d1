// SPDX-License-Identifier: Apache-2.0
#include "model/mode_pack.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "model/parameters.h"

namespace skyfit {
namespace {

double derivative(const Dual<0>&, std::size_t) { return 0; }
template <int N>
double derivative(const Dual<N>& x, std::size_t p) {
  return x.d[p];
}

// Element (i, j) of a matrix of lanes.
double* at(std::vector<double>& m, std::size_t columns, std::size_t i, std::size_t j) {
  return m.data() + (i * columns + j) * lanes::kLanes;
}
const double* at(const std::vector<double>& m, std::size_t columns, std::size_t i, std::size_t j) {
  return m.data() + (i * columns + j) * lanes::kLanes;
}

// Adds `factor` (one element per row, or 1 when null) times rows x columns of `from` to `to`.
void add_block(const double* factor, const std::vector<double>& from, std::size_t from_columns,
               std::size_t from_first, std::vector<double>& to, std::size_t to_columns,
               std::size_t to_first, std::size_t rows, std::size_t columns, double sign = 1) {
  for (std::size_t i = 0; i < rows; ++i) {
    const double* x = at(from, from_columns, i, from_first);
    double* y = at(to, to_columns, i, to_first);
    for (std::size_t j = 0; j < columns; ++j) {
      for (std::size_t k = 0; k < lanes::kLanes; ++k, ++x, ++y)
        *y += sign * (factor ? factor[i * lanes::kLanes + k] : 1.0) * *x;
    }
  }
}

// Adds a diagonal: one element per row, or 1 when null.
void add_diagonal(const double* diagonal, std::vector<double>& to, std::size_t to_columns,
                  std::size_t to_first, std::size_t rows) {
  for (std::size_t i = 0; i < rows; ++i) {
    double* y = at(to, to_columns, i, to_first + i);
    for (std::size_t k = 0; k < lanes::kLanes; ++k)
      y[k] += diagonal ? diagonal[i * lanes::kLanes + k] : 1.0;
  }
}

std::vector<double> columns_of(const std::vector<double>& m, std::size_t all, std::size_t first,
                               std::size_t rows, std::size_t count) {
  std::vector<double> r(rows * count * lanes::kLanes);
  for (std::size_t i = 0; i < rows; ++i)
    std::copy_n(at(m, all, i, first), count * lanes::kLanes, at(r, count, i, 0));
  return r;
}

void append(std::vector<double>& to, const std::vector<double>& from, std::size_t count) {
  to.insert(to.end(), from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

template <int N>
ModePack<N>::ModePack(const Inputs& inputs, const Tasks& tasks) : in_(inputs), tasks_(tasks) {
  int lowest = tasks[0].mode;
  for (const ModeTask& task : tasks) lowest = std::min(lowest, task.mode);
  rows_ = {static_cast<std::size_t>((in_.moments - lowest + 1) / 2),
           static_cast<std::size_t>((in_.moments - lowest) / 2)};
  set_basis();
  set_layers();
  set_direct_beam();
}

// Rows of moments that a lane's mode does not have stay 0.
template <int N>
void ModePack<N>::set_basis() {
  const auto p_count = static_cast<std::size_t>(in_.parameters);
  synthesis_.resize(levels());
  analysis_.resize(levels());
  omega_.resize(levels());
  omega_tangent_.resize(levels());
  for (int parity = 0; parity < 2; ++parity) {
    const std::size_t count = rows(parity);
    for (int i = 0; i < levels(); ++i) {
      const std::size_t n = rays(i);
      Lanes &synthesis = synthesis_[i][parity], &analysis = analysis_[i][parity];
      Lanes &omega = omega_[i][parity], &tangent = omega_tangent_[i][parity];
      synthesis.assign(n * count * kLanes, 0.0);
      analysis.assign(n * count * kLanes, 0.0);
      omega.assign(count * kLanes, 0.0);
      tangent.assign(count * p_count * kLanes, 0.0);
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const auto [wave, mode] = tasks_[lane];
        const ModeBasis& basis = in_.bases[mode];
        const int own = in_.moments - mode;  // moments of this mode
        for (std::size_t row = 0; row < count; ++row) {
          const int l = static_cast<int>(2 * row) + parity;  // l - m
          if (l >= own) break;
          for (std::size_t k = 0; k < n; ++k) {
            const double value = basis.at_rays[(i * in_.fan.most() + k) * own + l];
            at(synthesis, count, k, row)[lane] = value;
            at(analysis, n, row, k)[lane] =
                2 * std::numbers::pi * in_.fan.weight(i, static_cast<int>(k)) * value;
          }
          const Dual<N>& w = in_.media[wave].omega[i * in_.moments + mode + l];
          at(omega, 1, row, 0)[lane] = w.v;
          for (std::size_t p = 0; p < p_count; ++p)
            at(tangent, p_count, row, p)[lane] = derivative(w, p);
        }
      }
    }
    Lanes& sun_basis = sun_basis_[parity];
    sun_basis.assign(count * suns() * kLanes, 0.0);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const int own = in_.moments - tasks_[lane].mode;
      for (std::size_t row = 0; row < count; ++row) {
        const int l = static_cast<int>(2 * row) + parity;
        for (std::size_t j = 0; l < own && j < suns(); ++j) {
          at(sun_basis, suns(), row, j)[lane] =
              in_.bases[tasks_[lane].mode].at_suns[j * own + l];
        }
      }
    }
  }
}

template <int N>
void ModePack<N>::set_layers() {
  const auto p_count = static_cast<std::size_t>(in_.parameters);
  layers_.resize(levels() - 1);
  for (int i = 0; i + 1 < levels(); ++i) {
    Layer& layer = layers_[i];
    const std::size_t n = rays(i);
    for (Lanes* v : {&layer.t, &layer.near, &layer.far}) v->resize(n * kLanes);
    for (Lanes* v : {&layer.t_tangent, &layer.near_tangent, &layer.far_tangent})
      v->resize(n * p_count * kLanes);
    for (std::size_t k = 0; k < n; ++k) {
      const auto weights = [&](const ModeTask& task) -> const LayerWeights<N>& {
        return in_.media[task.wave].layers[static_cast<std::size_t>(i) * in_.fan.most() + k];
      };
      pack(at(layer.t, 1, k, 0), [&](const ModeTask& t) { return weights(t).t.v; });
      pack(at(layer.near, 1, k, 0), [&](const ModeTask& t) { return weights(t).near.v; });
      pack(at(layer.far, 1, k, 0), [&](const ModeTask& t) { return weights(t).far.v; });
      for (std::size_t p = 0; p < p_count; ++p) {
        pack(at(layer.t_tangent, p_count, k, p),
             [&](const ModeTask& t) { return derivative(weights(t).t, p); });
        pack(at(layer.near_tangent, p_count, k, p),
             [&](const ModeTask& t) { return derivative(weights(t).near, p); });
        pack(at(layer.far_tangent, p_count, k, p),
             [&](const ModeTask& t) { return derivative(weights(t).far, p); });
      }
    }
  }
}

template <int N>
void ModePack<N>::set_direct_beam() {
  const auto p_count = static_cast<std::size_t>(in_.parameters);
  beam_.resize(levels());
  beam_tangent_.resize(levels());
  for (int i = 0; i < levels(); ++i) {
    beam_[i].resize(suns() * kLanes);
    beam_tangent_[i].resize(suns() * p_count * kLanes);
    for (std::size_t j = 0; j < suns(); ++j) {
      const auto beam = [&](const ModeTask& t) -> const Dual<N>& {
        return in_.media[t.wave].beam[i * suns() + j];
      };
      pack(at(beam_[i], 1, j, 0), [&](const ModeTask& t) { return beam(t).v; });
      for (std::size_t p = 0; p < p_count; ++p)
        pack(at(beam_tangent_[i], p_count, j, p),
             [&](const ModeTask& t) { return derivative(beam(t), p); });
    }
  }
  albedo_.resize(kLanes);
  albedo_tangent_.resize(p_count * kLanes);
  const auto over_pi = [](const ModeTask& t, double x) {
    return t.mode == 0 ? x / std::numbers::pi : 0.0;
  };
  pack(albedo_.data(),
       [&](const ModeTask& t) { return over_pi(t, in_.media[t.wave].ground_albedo.v); });
  for (std::size_t p = 0; p < p_count; ++p)
    pack(at(albedo_tangent_, 1, p, 0), [&](const ModeTask& t) {
      return over_pi(t, derivative(in_.media[t.wave].ground_albedo, p));
    });
}

// Matrices of the source that radiance makes: of rays that look the same way, and the other way.
template <int N>
void ModePack<N>::scattering(int level, Lanes& same, Lanes& other) const {
  const std::size_t n = rays(level);
  same.resize(n * n * kLanes);
  other.resize(n * n * kLanes);
  Lanes weighted(analysis_[level][0].size());
  Lanes* const result[2] = {&same, &other};
  for (int parity = 0; parity < 2; ++parity) {
    weighted.resize(analysis_[level][parity].size());
    lanes::scale_rows(omega_[level][parity].data(), analysis_[level][parity].data(),
                      weighted.data(), rows(parity), n);
    lanes::multiply(synthesis_[level][parity].data(), weighted.data(), nullptr,
                    result[parity]->data(), n, rows(parity), n);
  }
  lanes::butterfly(same.data(), other.data(), n * n);
}

template <int N>
void ModePack<N>::eliminate() {
  reflection_.resize(levels());
  forward_.resize(levels() - 1);
  backward_.resize(levels() - 1);
  const std::size_t n = rays(0);
  reflection_[0].assign(n * n * kLanes, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const int ray = static_cast<int>(j);
      for (std::size_t k = 0; k < kLanes; ++k)
        at(reflection_[0], n, i, j)[k] = 2 * std::numbers::pi * albedo_[k] *
                                         in_.fan.weight(0, ray) * in_.fan.mu(0, ray);
    }
  }
  Lanes same, other, same_above, other_above;
  scattering(0, same, other);
  for (int i = 0; i + 1 < levels(); ++i) {
    scattering(i + 1, same_above, other_above);
    eliminate_layer(i, same, other, same_above, other_above);
    same.swap(same_above);
    other.swap(other_above);
  }
}

// From R_i to R_{i+1}, and the matrices of both sweeps. A limb ray that begins at level i + 1 has
// U = D there.
template <int N>
void ModePack<N>::eliminate_layer(int layer, const Lanes& same, const Lanes& other,
                                  const Lanes& same_above, const Lanes& other_above) {
  const std::size_t n = rays(layer), above = rays(layer + 1);
  const double *t = layers_[layer].t.data(), *near = layers_[layer].near.data(),
               *far = layers_[layer].far.data();
  const Lanes& reflection = reflection_[layer];
  Lanes down(n * n * kLanes), up(n * n * kLanes);  // sources per D once U = R D
  lanes::multiply(other.data(), reflection.data(), same.data(), down.data(), n, n, n);
  lanes::multiply(same.data(), reflection.data(), other.data(), up.data(), n, n, n);

  // D_i = G [(t + far A1) D' + far A2 U' + near S s + e], one elimination for all four.
  const std::size_t width = above + 3 * n;
  Lanes matrix(n * n * kLanes, 0.0), right(n * width * kLanes, 0.0);
  add_diagonal(nullptr, matrix, n, 0, n);
  add_block(near, down, n, 0, matrix, n, 0, n, n, -1);
  add_diagonal(t, right, width, 0, n);
  add_block(far, same_above, above, 0, right, width, 0, n, above);
  add_block(far, other_above, above, n, right, width, n, n, above - n);
  add_block(far, other_above, above, 0, right, width, above, n, n);
  add_block(near, other, n, 0, right, width, above + n, n, n);
  add_diagonal(nullptr, right, width, above + 2 * n, n);
  lanes::solve(matrix.data(), right.data(), n, width);
  const Lanes from_down = columns_of(right, width, 0, n, above);
  const Lanes from_up = columns_of(right, width, above, n, n);

  // U' = V [(near A3 + H G (t + far A1)) D' + P s + H G e + e'], with U_{i+1} per D_i in H.
  Lanes h(n * n * kLanes, 0.0), product(n * std::max(width, n) * kLanes);
  add_block(t, reflection, n, 0, h, n, 0, n, n);
  add_block(far, up, n, 0, h, n, 0, n, n);
  lanes::multiply(h.data(), right.data(), nullptr, product.data(), n, n, width);
  matrix.assign(n * n * kLanes, 0.0);
  add_diagonal(nullptr, matrix, n, 0, n);
  add_block(near, same_above, above, 0, matrix, n, 0, n, n, -1);
  add_block(nullptr, product, width, above, matrix, n, 0, n, n, -1);
  Lanes upward(n * width * kLanes, 0.0);
  add_block(near, other_above, above, 0, upward, width, 0, n, above);
  add_block(near, same_above, above, n, upward, width, n, n, above - n);
  add_block(nullptr, product, width, 0, upward, width, 0, n, above);
  add_diagonal(t, upward, width, above, n);
  add_block(far, same, n, 0, upward, width, above, n, n);
  add_block(nullptr, product, width, above + n, upward, width, above, n, 2 * n);
  add_diagonal(nullptr, upward, width, above + 2 * n, n);
  lanes::solve(matrix.data(), upward.data(), n, width);

  Lanes& next = reflection_[layer + 1];
  next = columns_of(upward, width, 0, n, above);
  Lanes& backward = backward_[layer];
  backward = right;
  lanes::multiply(from_up.data(), next.data(), from_down.data(), product.data(), n, n, above);
  for (std::size_t i = 0; i < n; ++i)
    std::copy_n(at(product, above, i, 0), above * kLanes, at(backward, width, i, 0));
  next.resize(above * above * kLanes, 0.0);
  for (std::size_t i = n; i < above; ++i) {
    for (std::size_t k = 0; k < kLanes; ++k) at(next, above, i, i)[k] = 1;
  }
  forward_[layer] = columns_of(upward, width, above, n, 3 * n);
}

template <int N>
void ModePack<N>::to_rays(int level, const std::array<Lanes, 2>& moments, std::size_t columns,
                          Lanes& down, Lanes& up) const {
  const std::size_t n = rays(level);
  Lanes* const result[2] = {&down, &up};
  for (int parity = 0; parity < 2; ++parity) {
    result[parity]->resize(n * columns * kLanes);
    lanes::multiply(synthesis_[level][parity].data(), moments[parity].data(), nullptr,
                    result[parity]->data(), n, rows(parity), columns);
  }
  lanes::butterfly(down.data(), up.data(), n * columns);
}

// e_D = near q_i + far q_{i+1} of the rays that look up; e_U = near q_{i+1} + far q_i of the others.
template <int N>
void ModePack<N>::layer_sources(const std::vector<Lanes>& down, const std::vector<Lanes>& up,
                                std::size_t columns) {
  down_source_.resize(layers_.size());
  up_source_.resize(layers_.size());
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const std::size_t n = rays(static_cast<int>(i));
    down_source_[i].resize(n * columns * kLanes);
    up_source_[i].resize(n * columns * kLanes);
    lanes::layer_source(layers_[i].near.data(), down[i].data(), layers_[i].far.data(),
                        down[i + 1].data(), down_source_[i].data(), n, columns);
    lanes::layer_source(layers_[i].near.data(), up[i + 1].data(), layers_[i].far.data(),
                        up[i].data(), up_source_[i].data(), n, columns);
  }
}

template <int N>
typename ModePack<N>::Columns ModePack<N>::substitute(const Lanes& ground,
                                                      std::size_t columns) const {
  const std::size_t width = columns * kLanes;
  std::vector<Lanes> s(levels());
  s[0] = ground;
  Lanes stack;
  for (int i = 0; i + 1 < levels(); ++i) {
    const std::size_t n = rays(i);
    stack.clear();
    append(stack, s[i], n * width);
    append(stack, down_source_[i], n * width);
    append(stack, up_source_[i], n * width);
    s[i + 1].assign(rays(i + 1) * width, 0.0);
    lanes::multiply(forward_[i].data(), stack.data(), nullptr, s[i + 1].data(), n, 3 * n, columns);
  }
  Columns result;
  result.count = columns;
  result.down.resize(levels());
  result.up.resize(levels());
  const int top = levels() - 1;
  result.down[top].assign(rays(top) * width, 0.0);
  result.up[top] = s[top];
  for (int i = top - 1; i >= 0; --i) {
    const std::size_t n = rays(i), above = rays(i + 1);
    stack = result.down[i + 1];
    append(stack, s[i + 1], n * width);
    append(stack, s[i], n * width);
    append(stack, down_source_[i], n * width);
    result.down[i].resize(n * width);
    lanes::multiply(backward_[i].data(), stack.data(), nullptr, result.down[i].data(), n,
                    above + 3 * n, columns);
    result.up[i].resize(n * width);
    lanes::multiply(reflection_[i].data(), result.down[i].data(), s[i].data(),
                    result.up[i].data(), n, n, columns);
  }
  return result;
}

template <int N>
void ModePack<N>::analyse(const Columns& columns, std::vector<Lanes>& even,
                          std::vector<Lanes>& odd) const {
  even.resize(levels());
  odd.resize(levels());
  for (int i = 0; i < levels(); ++i) {
    const std::size_t n = rays(i);
    Lanes sum = columns.down[i], difference = columns.up[i];
    lanes::butterfly(sum.data(), difference.data(), n * columns.count);
    even[i].resize(rows(0) * columns.count * kLanes);
    odd[i].resize(rows(1) * columns.count * kLanes);
    lanes::multiply(analysis_[i][0].data(), sum.data(), nullptr, even[i].data(), rows(0), n,
                    columns.count);
    lanes::multiply(analysis_[i][1].data(), difference.data(), nullptr, odd[i].data(), rows(1), n,
                    columns.count);
  }
}

template <int N>
typename ModePack<N>::Lanes ModePack<N>::irradiance(const Lanes& down, std::size_t columns) const {
  Lanes sum(columns * kLanes, 0.0);
  for (int k = 0; k < in_.fan.count(0); ++k) {
    const double weight = 2 * std::numbers::pi * in_.fan.weight(0, k) * in_.fan.mu(0, k);
    const double* row = at(down, columns, static_cast<std::size_t>(k), 0);
    for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += weight * row[j];
  }
  return sum;
}

template <int N>
typename ModePack<N>::Lanes ModePack<N>::at_every_ground_ray(const Lanes& radiance) const {
  Lanes r;
  for (std::size_t k = 0; k < rays(0); ++k) append(r, radiance, radiance.size());
  return r;
}

// albedo / pi times an irradiance per sun.
template <int N>
typename ModePack<N>::Lanes ModePack<N>::reflected(Lanes irradiance) const {
  for (std::size_t i = 0; i < irradiance.size(); ++i) irradiance[i] *= albedo_[i % kLanes];
  return at_every_ground_ray(irradiance);
}

// Moments of one parity: of the sun's beam, of the diffuse field, or of both.
template <int N>
typename ModePack<N>::Lanes ModePack<N>::light(int level, int parity, Light which) const {
  const Lanes& diffuse = parity == 0 ? even_[level] : odd_[level];
  if (which == Light::kDiffuse) return diffuse;
  Lanes m(sun_basis_[parity].size());
  for (std::size_t i = 0; i < m.size(); ++i)
    m[i] = sun_basis_[parity][i] * beam_[level][i % (suns() * kLanes)];
  if (which == Light::kAll) {
    for (std::size_t i = 0; i < m.size(); ++i) m[i] += diffuse[i];
  }
  return m;
}

// Source functions at the rays of all levels.
template <int N>
void ModePack<N>::sources(Light which, std::vector<Lanes>& down, std::vector<Lanes>& up) const {
  down.resize(levels());
  up.resize(levels());
  for (int i = 0; i < levels(); ++i) {
    std::array<Lanes, 2> q;
    for (int parity = 0; parity < 2; ++parity) {
      const Lanes m = light(i, parity, which);
      q[parity].resize(m.size());
      lanes::scale_rows(omega_[i][parity].data(), m.data(), q[parity].data(), rows(parity), suns());
    }
    to_rays(i, q, suns(), down[i], up[i]);
  }
}

template <int N>
typename ModePack<N>::Lanes ModePack<N>::beam_on_ground() const {
  Lanes r(suns() * kLanes);
  for (std::size_t i = 0; i < r.size(); ++i)
    r[i] = std::max(in_.sun_mu[i / kLanes], 0.0) * beam_[0][i];
  return r;
}

template <int N>
void ModePack<N>::solve_values() {
  even_.resize(levels());
  odd_.resize(levels());
  std::vector<Lanes> down, up;
  sources(Light::kBeam, down, up);
  layer_sources(down, up, suns());
  values_ = substitute(reflected(beam_on_ground()), suns());
  analyse(values_, even_, odd_);
  ground_ = irradiance(values_.down[0], suns());
}

// The same linear system for all derivatives: what depends on the parameters, applied to the
// solution, is their source.
template <int N>
void ModePack<N>::solve_tangents() {
  const auto p_count = static_cast<std::size_t>(in_.parameters);
  const std::size_t columns = suns() * p_count;
  std::vector<Lanes> down(levels()), up(levels());
  for (int i = 0; i < levels(); ++i) {
    std::array<Lanes, 2> q;
    for (int parity = 0; parity < 2; ++parity) {
      q[parity].resize(rows(parity) * columns * kLanes);
      lanes::moment_tangent(omega_tangent_[i][parity].data(), light(i, parity, Light::kAll).data(),
                            omega_[i][parity].data(), sun_basis_[parity].data(),
                            beam_tangent_[i].data(), q[parity].data(), rows(parity), suns(),
                            p_count);
    }
    to_rays(i, q, columns, down[i], up[i]);
  }
  layer_sources(down, up, columns);
  sources(Light::kAll, down, up);
  for (int i = 0; i + 1 < levels(); ++i) {
    const Layer& w = layers_[i];
    lanes::add_layer_tangent(w.t_tangent.data(), values_.down[i + 1].data(),
                             w.near_tangent.data(), down[i].data(), w.far_tangent.data(),
                             down[i + 1].data(), down_source_[i].data(), rays(i), suns(), p_count);
    lanes::add_layer_tangent(w.t_tangent.data(), values_.up[i].data(), w.near_tangent.data(),
                             up[i + 1].data(), w.far_tangent.data(), up[i].data(),
                             up_source_[i].data(), rays(i), suns(), p_count);
  }
  Lanes on_ground(columns * kLanes);
  for (std::size_t j = 0; j < suns(); ++j) {
    const double mu = std::max(in_.sun_mu[j], 0.0);
    for (std::size_t p = 0; p < p_count; ++p) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        const double all = ground_[j * kLanes + k] + mu * beam_[0][j * kLanes + k];
        on_ground[(j * p_count + p) * kLanes + k] =
            albedo_tangent_[p * kLanes + k] * all +
            albedo_[k] * mu * beam_tangent_[0][(j * p_count + p) * kLanes + k];
      }
    }
  }
  const Columns tangents = substitute(at_every_ground_ray(on_ground), columns);
  analyse(tangents, even_tangent_, odd_tangent_);
  ground_tangent_ = irradiance(tangents.down[0], columns);
}

template <int N>
void ModePack<N>::advance() {
  const bool first = even_.empty();
  std::vector<Lanes> down, up;
  even_.resize(levels());
  odd_.resize(levels());
  sources(first ? Light::kBeam : Light::kDiffuse, down, up);
  layer_sources(down, up, suns());
  const Lanes ground = reflected(first ? beam_on_ground() : ground_);
  values_ = {suns(), std::vector<Lanes>(levels()), std::vector<Lanes>(levels())};
  const std::size_t width = suns();
  values_.down.back().assign(rays(levels() - 1) * width * kLanes, 0.0);
  for (int i = levels() - 2; i >= 0; --i) {
    Lanes& d = values_.down[i] = down_source_[i];
    add_block(layers_[i].t.data(), values_.down[i + 1], width, 0, d, width, 0, rays(i), width);
  }
  values_.up[0] = ground;
  for (int i = 0; i + 1 < levels(); ++i) {
    // A ray that begins at level i + 1 comes from its other half.
    Lanes& u = values_.up[i + 1] = values_.down[i + 1];
    std::ranges::copy(up_source_[i], u.begin());
    add_block(layers_[i].t.data(), values_.up[i], width, 0, u, width, 0, rays(i), width);
  }
  analyse(values_, even_, odd_);
  ground_ = irradiance(values_.down[0], suns());
}

template <int N>
void ModePack<N>::solve() {
  eliminate();
  solve_values();
  if (in_.parameters > 0) solve_tangents();
}

template <int N>
double ModePack<N>::moment(int lane, int level, int l, int sun, int slice) const {
  const int offset = l - tasks_[lane].mode, parity = offset % 2;
  const std::size_t row = static_cast<std::size_t>(offset / 2), j = static_cast<std::size_t>(sun);
  if (slice == 0) return at(parity == 0 ? even_[level] : odd_[level], suns(), row, j)[lane];
  const auto p_count = static_cast<std::size_t>(in_.parameters);
  return at(parity == 0 ? even_tangent_[level] : odd_tangent_[level], suns() * p_count, row,
            j * p_count + static_cast<std::size_t>(slice) - 1)[lane];
}

template <int N>
double ModePack<N>::ground_irradiance(int lane, int sun, int slice) const {
  const auto p_count = static_cast<std::size_t>(in_.parameters);
  if (slice == 0) return ground_[static_cast<std::size_t>(sun) * kLanes + lane];
  return ground_tangent_[(sun * p_count + static_cast<std::size_t>(slice) - 1) * kLanes + lane];
}

template class ModePack<0>;
template class ModePack<kParameterCount>;

}  // namespace skyfit
