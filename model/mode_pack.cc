// SPDX-License-Identifier: Apache-2.0
#include "model/mode_pack.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skyfit {
namespace {

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

ModePack::ModePack(const RayFan& fan, const LayerMedium& medium,
                   const std::vector<ModeBasis>& bases, const Modes& modes)
    : fan_(fan), medium_(medium), modes_(modes) {
  const int most = medium.moments - *std::min_element(modes.begin(), modes.end());
  rows_ = {static_cast<std::size_t>((most + 1) / 2), static_cast<std::size_t>(most / 2)};
  set_basis(bases);
  const auto over_pi = [&](const Lanes& albedo) {
    Lanes r = albedo;
    for (std::size_t i = 0; i < r.size(); ++i)
      r[i] *= modes_[i % kLanes] == 0 ? 1 / std::numbers::pi : 0.0;
    return r;
  };
  albedo_ = over_pi(medium.ground_albedo);
  albedo_tangent_ = over_pi(medium.ground_albedo_tangent);
}

// Rows of moments that a lane's mode does not have stay 0.
void ModePack::set_basis(const std::vector<ModeBasis>& bases) {
  const std::size_t p_count = medium_.parameters;
  for (auto* v : {&synthesis_, &analysis_, &omega_, &omega_tangent_}) v->resize(levels());
  for (std::size_t parity = 0; parity < 2; ++parity) {
    const std::size_t count = rows_[parity];
    sun_basis_[parity].assign(count * suns() * kLanes, 0.0);
    for (int i = 0; i < levels(); ++i) {
      synthesis_[i][parity].assign(rays(i) * count * kLanes, 0.0);
      analysis_[i][parity].assign(rays(i) * count * kLanes, 0.0);
      omega_[i][parity].assign(count * kLanes, 0.0);
      omega_tangent_[i][parity].assign(count * p_count * kLanes, 0.0);
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const ModeBasis& basis = bases[modes_[lane]];
      const auto m = static_cast<std::size_t>(modes_[lane]),
                 own = static_cast<std::size_t>(medium_.moments) - m;
      for (std::size_t row = 0; 2 * row + parity < own; ++row) {
        const std::size_t offset = 2 * row + parity, l = m + offset;  // offset = l - m
        for (std::size_t j = 0; j < suns(); ++j)
          at(sun_basis_[parity], suns(), row, j)[lane] = basis.at_suns[j * own + offset];
        for (int i = 0; i < levels(); ++i) {
          for (std::size_t k = 0; k < rays(i); ++k) {
            const double value = basis.at_rays[(i * fan_.most() + k) * own + offset];
            at(synthesis_[i][parity], count, k, row)[lane] = value;
            at(analysis_[i][parity], rays(i), row, k)[lane] =
                2 * std::numbers::pi * fan_.weight(i, static_cast<int>(k)) * value;
          }
          at(omega_[i][parity], 1, row, 0)[lane] = at(medium_.omega[i], 1, l, 0)[lane];
          for (std::size_t p = 0; p < p_count; ++p)
            at(omega_tangent_[i][parity], p_count, row, p)[lane] =
                at(medium_.omega_tangent[i], p_count, l, p)[lane];
        }
      }
    }
  }
}

// Matrices of the source that radiance makes: of rays that look the same way, and the other way.
void ModePack::scattering(int level, Lanes& same, Lanes& other) const {
  const std::size_t n = rays(level);
  same.resize(n * n * kLanes);
  other.resize(n * n * kLanes);
  Lanes weighted;
  Lanes* const result[2] = {&same, &other};
  for (std::size_t parity = 0; parity < 2; ++parity) {
    weighted.resize(analysis_[level][parity].size());
    lanes::scale_rows(omega_[level][parity].data(), analysis_[level][parity].data(),
                      weighted.data(), rows_[parity], n);
    lanes::multiply(synthesis_[level][parity].data(), weighted.data(), nullptr,
                    result[parity]->data(), n, rows_[parity], n);
  }
  lanes::butterfly(same.data(), other.data(), n * n);
}

void ModePack::eliminate() {
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
                                         fan_.weight(0, ray) * fan_.mu(0, ray);
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
void ModePack::eliminate_layer(int layer, const Lanes& same, const Lanes& other,
                                  const Lanes& same_above, const Lanes& other_above) {
  const std::size_t n = rays(layer), above = rays(layer + 1);
  const LayerMedium::Layer& weights = medium_.layers[layer];
  const double *t = weights.t.data(), *near = weights.near.data(), *far = weights.far.data();
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

// Values at the rays from moments: first those of the rays that look up.
ModePack::Columns ModePack::at_rays(const std::vector<Parities>& moments,
                                    std::size_t columns) const {
  Columns r{columns, std::vector<Lanes>(levels()), std::vector<Lanes>(levels())};
  for (int i = 0; i < levels(); ++i) {
    const std::size_t n = rays(i);
    Lanes* const result[2] = {&r.down[i], &r.up[i]};
    for (std::size_t parity = 0; parity < 2; ++parity) {
      result[parity]->resize(n * columns * kLanes);
      lanes::multiply(synthesis_[i][parity].data(), moments[i][parity].data(), nullptr,
                      result[parity]->data(), n, rows_[parity], columns);
    }
    lanes::butterfly(r.down[i].data(), r.up[i].data(), n * columns);
  }
  return r;
}

// Source moments of light's moments.
std::vector<ModePack::Parities> ModePack::scattered(const std::vector<Parities>& moments) const {
  std::vector<Parities> r(moments.size());
  for (std::size_t i = 0; i < r.size(); ++i) {
    for (std::size_t parity = 0; parity < 2; ++parity) {
      r[i][parity].resize(moments[i][parity].size());
      lanes::scale_rows(omega_[i][parity].data(), moments[i][parity].data(), r[i][parity].data(),
                        rows_[parity], suns());
    }
  }
  return r;
}

// What the beam's light, scattered once in a layer, adds to the rays that leave it.
void ModePack::beam_sources() {
  const std::vector<Parities> unit(levels(), sun_basis_);
  unit_beam_ = at_rays(scattered(unit), suns());
  down_source_.resize(medium_.layers.size());
  up_source_.resize(medium_.layers.size());
  for (std::size_t i = 0; i < medium_.layers.size(); ++i) {
    const LayerMedium::Layer& w = medium_.layers[i];
    const std::size_t count = w.down.near.size() / kLanes;
    down_source_[i].resize(count * kLanes);
    up_source_[i].resize(count * kLanes);
    lanes::blend(w.down.near.data(), unit_beam_.down[i].data(), w.down.far.data(),
                 unit_beam_.down[i + 1].data(), down_source_[i].data(), count);
    lanes::blend(w.up.near.data(), unit_beam_.up[i + 1].data(), w.up.far.data(),
                 unit_beam_.up[i].data(), up_source_[i].data(), count);
  }
}

// Adds near J_i + far J_{i+1} to the rays that look up, near J_{i+1} + far J_i to the others.
void ModePack::add_diffuse_sources(const Columns& source, std::size_t columns) {
  for (std::size_t i = 0; i < medium_.layers.size(); ++i) {
    const LayerMedium::Layer& w = medium_.layers[i];
    const std::size_t n = rays(static_cast<int>(i));
    lanes::add_blend(w.near.data(), source.down[i].data(), w.far.data(),
                     source.down[i + 1].data(), down_source_[i].data(), n, columns);
    lanes::add_blend(w.near.data(), source.up[i + 1].data(), w.far.data(), source.up[i].data(),
                     up_source_[i].data(), n, columns);
  }
}

ModePack::Columns ModePack::substitute(const Lanes& ground,
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

std::vector<ModePack::Parities> ModePack::analyse(const Columns& columns) const {
  std::vector<Parities> moments(levels());
  for (int i = 0; i < levels(); ++i) {
    const std::size_t n = rays(i);
    std::array<Lanes, 2> light = {columns.down[i], columns.up[i]};  // then sum and difference
    lanes::butterfly(light[0].data(), light[1].data(), n * columns.count);
    for (std::size_t parity = 0; parity < 2; ++parity) {
      moments[i][parity].resize(rows_[parity] * columns.count * kLanes);
      lanes::multiply(analysis_[i][parity].data(), light[parity].data(), nullptr,
                      moments[i][parity].data(), rows_[parity], n, columns.count);
    }
  }
  return moments;
}

Lanes ModePack::irradiance(const Lanes& down, std::size_t columns) const {
  Lanes sum(columns * kLanes, 0.0);
  for (int k = 0; k < fan_.count(0); ++k) {
    const double weight = 2 * std::numbers::pi * fan_.weight(0, k) * fan_.mu(0, k);
    const double* row = at(down, columns, static_cast<std::size_t>(k), 0);
    for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += weight * row[j];
  }
  return sum;
}

Lanes ModePack::at_every_ground_ray(const Lanes& radiance) const {
  Lanes r;
  for (std::size_t k = 0; k < rays(0); ++k) append(r, radiance, radiance.size());
  return r;
}

// albedo / pi times an irradiance per sun.
Lanes ModePack::reflected(Lanes irradiance) const {
  for (std::size_t i = 0; i < irradiance.size(); ++i) irradiance[i] *= albedo_[i % kLanes];
  return at_every_ground_ray(irradiance);
}

Lanes ModePack::beam_on_ground() const {
  Lanes r = medium_.ground_beam;
  for (std::size_t i = 0; i < r.size(); ++i) r[i] *= std::max(medium_.sun_mu[i / kLanes], 0.0);
  return r;
}

void ModePack::solve_values() {
  beam_sources();
  values_ = substitute(reflected(beam_on_ground()), suns());
  moments_ = analyse(values_);
  ground_ = irradiance(values_.down[0], suns());
}

// The same linear system for all derivatives: what depends on the parameters, applied to the
// solution, is their source.
void ModePack::solve_tangents() {
  const std::size_t p_count = medium_.parameters, columns = suns() * p_count;
  const auto changed = [&](auto&& moments_at) {  // by the change of the scattering alone
    std::vector<Parities> q(levels());
    for (int i = 0; i < levels(); ++i) {
      for (std::size_t parity = 0; parity < 2; ++parity) {
        q[i][parity].resize(rows_[parity] * columns * kLanes);
        lanes::outer(omega_tangent_[i][parity].data(), moments_at(i)[parity].data(),
                     q[i][parity].data(), rows_[parity], suns(), p_count);
      }
    }
    return at_rays(q, columns);
  };
  const Columns source = at_rays(scattered(moments_), suns());
  const Columns beam_change = changed([&](int) -> const Parities& { return sun_basis_; });
  for (int i = 0; i + 1 < levels(); ++i) {
    const LayerMedium::Layer& w = medium_.layers[i];
    const auto tangent = [&](const BeamWeights& beam, const Lanes& light,
                             const std::vector<Lanes>& j, const std::vector<Lanes>& q,
                             const std::vector<Lanes>& dq, int near, int far, Lanes& out) {
      const auto slope = [&](std::size_t k) { return beam.near_slope[k].data(); };
      const auto far_slope = [&](std::size_t k) { return beam.far_slope[k].data(); };
      out.resize(rays(i) * columns * kLanes);
      lanes::layer_tangent(
          {w.t.data(), w.near_slope.data(), w.far_slope.data(), light.data(), j[near].data(),
           j[far].data(), beam.near.data(), beam.far.data(), {slope(0), slope(1), slope(2)},
           {far_slope(0), far_slope(1), far_slope(2)}, q[near].data(), q[far].data(),
           dq[near].data(), dq[far].data(), w.depth_tangent.data(),
           medium_.sun_depth_tangent[near].data(), medium_.sun_depth_tangent[far].data()},
          out.data(), rays(i), suns(), p_count);
    };
    tangent(w.down, values_.down[i + 1], source.down, unit_beam_.down, beam_change.down, i, i + 1,
            down_source_[i]);
    tangent(w.up, values_.up[i], source.up, unit_beam_.up, beam_change.up, i + 1, i,
            up_source_[i]);
  }
  add_diffuse_sources(changed([&](int i) -> const Parities& { return moments_[i]; }), columns);
  Lanes on_ground(columns * kLanes);
  for (std::size_t j = 0; j < suns(); ++j) {
    const double mu = std::max(medium_.sun_mu[j], 0.0);
    for (std::size_t p = 0; p < p_count; ++p) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        const std::size_t sun = j * kLanes + k, column = (j * p_count + p) * kLanes + k;
        const double beam = mu * medium_.ground_beam[sun];
        on_ground[column] = albedo_tangent_[p * kLanes + k] * (ground_[sun] + beam) -
                            albedo_[k] * beam * medium_.sun_depth_tangent[0][column];
      }
    }
  }
  const Columns tangents = substitute(at_every_ground_ray(on_ground), columns);
  moment_tangents_ = analyse(tangents);
  ground_tangent_ = irradiance(tangents.down[0], columns);
}

void ModePack::advance() {
  Lanes ground;
  if (moments_.empty()) {
    beam_sources();
    ground = reflected(beam_on_ground());
  } else {
    for (auto* sources : {&down_source_, &up_source_}) {
      for (Lanes& source : *sources) std::ranges::fill(source, 0.0);
    }
    add_diffuse_sources(at_rays(scattered(moments_), suns()), suns());
    ground = reflected(ground_);
  }
  const std::size_t width = suns();
  values_ = {width, std::vector<Lanes>(levels()), std::vector<Lanes>(levels())};
  values_.down.back().assign(rays(levels() - 1) * width * kLanes, 0.0);
  for (int i = levels() - 2; i >= 0; --i) {
    Lanes& d = values_.down[i] = down_source_[i];
    add_block(medium_.layers[i].t.data(), values_.down[i + 1], width, 0, d, width, 0, rays(i),
              width);
  }
  values_.up[0] = ground;
  for (int i = 0; i + 1 < levels(); ++i) {
    // A ray that begins at level i + 1 comes from its other half.
    Lanes& u = values_.up[i + 1] = values_.down[i + 1];
    std::ranges::copy(up_source_[i], u.begin());
    add_block(medium_.layers[i].t.data(), values_.up[i], width, 0, u, width, 0, rays(i), width);
  }
  moments_ = analyse(values_);
  ground_ = irradiance(values_.down[0], width);
}

void ModePack::solve() {
  eliminate();
  solve_values();
  if (medium_.parameters > 0) solve_tangents();
}

double ModePack::moment(int lane, int level, int l, int sun, int slice) const {
  const int offset = l - modes_[lane];
  const std::size_t parity = offset % 2, row = offset / 2, j = sun;
  if (slice == 0) return at(moments_[level][parity], suns(), row, j)[lane];
  return at(moment_tangents_[level][parity], suns() * medium_.parameters, row,
            j * medium_.parameters + slice - 1)[lane];
}

double ModePack::ground_irradiance(int lane, int sun, int slice) const {
  if (slice == 0) return ground_[sun * kLanes + lane];
  return ground_tangent_[(sun * medium_.parameters + slice - 1) * kLanes + lane];
}

}  // namespace skyfit
