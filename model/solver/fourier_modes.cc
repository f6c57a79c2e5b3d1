// SPDX-License-Identifier: Apache-2.0
#include "model/solver/fourier_modes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skyfit {

FourierModes::FourierModes(const Streams& streams, const LayerMedium& medium,
                           const std::vector<ModeBasis>& bases, const Modes& modes)
    : streams_(&streams), medium_(&medium), modes_(modes) {
  const int most = medium.moments - *std::min_element(modes.begin(), modes.end());
  rows_ = {static_cast<std::size_t>((most + 1) / 2), static_cast<std::size_t>(most / 2)};
  set_basis(bases);
  const auto over_pi = [&](const Batch& albedo) {
    Batch r = albedo;
    for (std::size_t i = 0; i < r.size(); ++i)
      r[i] *= modes_[i % kBatchWidth] == 0 ? 1 / std::numbers::pi : 0.0;
    return r;
  };
  albedo_ = over_pi(medium.ground_albedo);
  albedo_tangent_ = over_pi(medium.ground_albedo_tangent);
}

// Rows of moments that a lane's mode does not have stay 0.
void FourierModes::set_basis(const std::vector<ModeBasis>& bases) {
  for (auto* v : {&synthesis_, &analysis_, &omega_}) v->resize(levels());
  chi_.resize(medium_->scatterers.size());
  chi_tangent_.resize(medium_->phase_tangents.size());
  for (std::size_t parity = 0; parity < 2; ++parity) {
    const std::size_t count = rows_[parity];
    sun_basis_[parity].assign(count * suns() * kBatchWidth, 0.0);
    for (int i = 0; i < levels(); ++i) {
      synthesis_[i][parity].assign(rays(i) * count * kBatchWidth, 0.0);
      analysis_[i][parity].assign(rays(i) * count * kBatchWidth, 0.0);
      omega_[i][parity].assign(count * kBatchWidth, 0.0);
    }
    for (auto* all : {&chi_, &chi_tangent_}) {
      for (Parities& chi : *all) chi[parity].assign(count * kBatchWidth, 0.0);
    }
    for (std::size_t lane = 0; lane < kBatchWidth; ++lane) {
      const ModeBasis& basis = bases[modes_[lane]];
      const auto m = static_cast<std::size_t>(modes_[lane]),
                 own = static_cast<std::size_t>(medium_->moments) - m;
      for (std::size_t row = 0; 2 * row + parity < own; ++row) {
        const std::size_t offset = 2 * row + parity, l = m + offset;  // offset = l - m
        for (std::size_t j = 0; j < suns(); ++j)
          at(sun_basis_[parity], suns(), row, j)[lane] = basis.at_suns[j * own + offset];
        for (std::size_t s = 0; s < chi_.size(); ++s)
          at(chi_[s][parity], 1, row, 0)[lane] = at(medium_->scatterers[s].chi, 1, l, 0)[lane];
        for (std::size_t q = 0; q < chi_tangent_.size(); ++q)
          at(chi_tangent_[q][parity], 1, row, 0)[lane] =
              at(medium_->phase_tangents[q].chi, 1, l, 0)[lane];
        for (int i = 0; i < levels(); ++i) {
          for (std::size_t k = 0; k < rays(i); ++k) {
            const double value = basis.at_rays[(i * streams_->most() + k) * own + offset];
            at(synthesis_[i][parity], count, k, row)[lane] = value;
            at(analysis_[i][parity], rays(i), row, k)[lane] =
                2 * std::numbers::pi * streams_->weight(i, static_cast<int>(k)) * value;
          }
          for (const LayerMedium::Scatterer& s : medium_->scatterers)
            at(omega_[i][parity], 1, row, 0)[lane] += s.share[i][lane] * at(s.chi, 1, l, 0)[lane];
        }
      }
    }
  }
}

// docs/theory (4.10).
// Matrices of the source that radiance makes: of rays that look the same way, and the other way.
void FourierModes::scattering(int level, Batch& same, Batch& other) const {
  const std::size_t n = rays(level);
  same.resize(n * n * kBatchWidth);
  other.resize(n * n * kBatchWidth);
  Batch weighted;
  Batch* const result[2] = {&same, &other};
  for (std::size_t parity = 0; parity < 2; ++parity) {
    weighted.resize(analysis_[level][parity].size());
    batch::scale_rows(omega_[level][parity].data(), analysis_[level][parity].data(),
                      weighted.data(), rows_[parity], n);
    batch::multiply(synthesis_[level][parity].data(), weighted.data(), nullptr,
                    result[parity]->data(), n, rows_[parity], n);
  }
  batch::butterfly(same.data(), other.data(), n * n);
}

// docs/theory (5.3): the ground.
void FourierModes::eliminate() {
  reflection_.resize(levels());
  forward_.resize(levels() - 1);
  backward_.resize(levels() - 1);
  const std::size_t n = rays(0);
  reflection_[0].assign(n * n * kBatchWidth, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const int ray = static_cast<int>(j);
      for (std::size_t k = 0; k < kBatchWidth; ++k)
        at(reflection_[0], n, i, j)[k] =
            2 * std::numbers::pi * albedo_[k] * streams_->weight(0, ray) * streams_->mu(0, ray);
    }
  }
  Batch same, other, same_above, other_above;
  scattering(0, same, other);
  for (int i = 0; i + 1 < levels(); ++i) {
    scattering(i + 1, same_above, other_above);
    eliminate_layer(i, same, other, same_above, other_above);
    same.swap(same_above);
    other.swap(other_above);
  }
}

// docs/theory (5.5) to (5.9).
// From R_i to R_{i+1}, and the matrices of both sweeps. A limb ray that begins at level i + 1 has
// U = D there.
void FourierModes::eliminate_layer(int layer, const Batch& same, const Batch& other,
                                   const Batch& same_above, const Batch& other_above) {
  const std::size_t n = rays(layer), above = rays(layer + 1);
  const LayerMedium::Layer& weights = medium_->layers[layer];
  const double *t = weights.t.data(), *near = weights.near.data(), *far = weights.far.data();
  const Batch& reflection = reflection_[layer];
  Batch down(n * n * kBatchWidth), up(n * n * kBatchWidth);  // sources per D once U = R D
  batch::multiply(other.data(), reflection.data(), same.data(), down.data(), n, n, n);
  batch::multiply(same.data(), reflection.data(), other.data(), up.data(), n, n, n);

  // D_i = G [(t + far A1) D' + far A2 U' + near S s + e], one elimination for all four.
  const std::size_t width = above + 3 * n;
  Batch matrix(n * n * kBatchWidth, 0.0), right(n * width * kBatchWidth, 0.0);
  add_diagonal(nullptr, matrix, n, 0, n);
  add_block(near, down, n, 0, matrix, n, 0, n, n, -1);
  add_diagonal(t, right, width, 0, n);
  add_block(far, same_above, above, 0, right, width, 0, n, above);
  add_block(far, other_above, above, n, right, width, n, n, above - n);
  add_block(far, other_above, above, 0, right, width, above, n, n);
  add_block(near, other, n, 0, right, width, above + n, n, n);
  add_diagonal(nullptr, right, width, above + 2 * n, n);
  batch::solve(matrix.data(), right.data(), n, width);
  const Batch from_down = columns_of(right, width, 0, n, above);
  const Batch from_up = columns_of(right, width, above, n, n);

  // U' = V [(near A3 + H G (t + far A1)) D' + P s + H G e + e'], with U_{i+1} per D_i in H.
  Batch h(n * n * kBatchWidth, 0.0), product(n * std::max(width, n) * kBatchWidth);
  add_block(t, reflection, n, 0, h, n, 0, n, n);
  add_block(far, up, n, 0, h, n, 0, n, n);
  batch::multiply(h.data(), right.data(), nullptr, product.data(), n, n, width);
  matrix.assign(n * n * kBatchWidth, 0.0);
  add_diagonal(nullptr, matrix, n, 0, n);
  add_block(near, same_above, above, 0, matrix, n, 0, n, n, -1);
  add_block(nullptr, product, width, above, matrix, n, 0, n, n, -1);
  Batch upward(n * width * kBatchWidth, 0.0);
  add_block(near, other_above, above, 0, upward, width, 0, n, above);
  add_block(near, same_above, above, n, upward, width, n, n, above - n);
  add_block(nullptr, product, width, 0, upward, width, 0, n, above);
  add_diagonal(t, upward, width, above, n);
  add_block(far, same, n, 0, upward, width, above, n, n);
  add_block(nullptr, product, width, above + n, upward, width, above, n, 2 * n);
  add_diagonal(nullptr, upward, width, above + 2 * n, n);
  batch::solve(matrix.data(), upward.data(), n, width);

  Batch& next = reflection_[layer + 1];
  next = columns_of(upward, width, 0, n, above);
  Batch& backward = backward_[layer];
  backward = right;
  batch::multiply(from_up.data(), next.data(), from_down.data(), product.data(), n, n, above);
  for (std::size_t i = 0; i < n; ++i)
    std::copy_n(at(product, above, i, 0), above * kBatchWidth, at(backward, width, i, 0));
  next.resize(above * above * kBatchWidth, 0.0);
  for (std::size_t i = n; i < above; ++i) {
    for (std::size_t k = 0; k < kBatchWidth; ++k) at(next, above, i, i)[k] = 1;
  }
  forward_[layer] = columns_of(upward, width, above, n, 3 * n);
}

// docs/theory (4.9).
// Values at the rays from moments: first those of the rays that look up.
FourierModes::Columns FourierModes::at_rays(const std::vector<Parities>& moments,
                                            std::size_t columns) const {
  Columns r{columns, std::vector<Batch>(levels()), std::vector<Batch>(levels())};
  for (int i = 0; i < levels(); ++i) {
    const std::size_t n = rays(i);
    Batch* const result[2] = {&r.down[i], &r.up[i]};
    for (std::size_t parity = 0; parity < 2; ++parity) {
      result[parity]->resize(n * columns * kBatchWidth);
      batch::multiply(synthesis_[i][parity].data(), moments[i][parity].data(), nullptr,
                      result[parity]->data(), n, rows_[parity], columns);
    }
    batch::butterfly(r.down[i].data(), r.up[i].data(), n * columns);
  }
  return r;
}

// Source moments of light's moments.
std::vector<FourierModes::Parities> FourierModes::scattered(
    const std::vector<Parities>& moments) const {
  std::vector<Parities> r(moments.size());
  for (std::size_t i = 0; i < r.size(); ++i) {
    for (std::size_t parity = 0; parity < 2; ++parity) {
      r[i][parity].resize(moments[i][parity].size());
      batch::scale_rows(omega_[i][parity].data(), moments[i][parity].data(), r[i][parity].data(),
                        rows_[parity], suns());
    }
  }
  return r;
}

// Values at the rays of moments times chi.
FourierModes::Columns FourierModes::sources_by(const Parities& chi,
                                               const std::vector<Parities>& moments) const {
  std::vector<Parities> q(levels());
  for (int i = 0; i < levels(); ++i) {
    for (std::size_t parity = 0; parity < 2; ++parity) {
      q[i][parity].resize(moments[i][parity].size());
      batch::scale_rows(chi[parity].data(), moments[i][parity].data(), q[i][parity].data(),
                        rows_[parity], suns());
    }
  }
  return at_rays(q, suns());
}

FourierModes::Sources FourierModes::sources_of(const std::vector<Parities>& moments) const {
  Sources sources;
  for (const Parities& chi : chi_) sources.scatterer.push_back(sources_by(chi, moments));
  for (const Parities& chi : chi_tangent_) sources.phase.push_back(sources_by(chi, moments));
  return sources;
}

FourierModes::Columns FourierModes::source_function(const Sources& sources) const {
  Columns r{suns(), std::vector<Batch>(levels()), std::vector<Batch>(levels())};
  for (int i = 0; i < levels(); ++i) {
    const std::size_t count = rays(i) * suns();
    for (auto side : {&Columns::down, &Columns::up}) {
      Batch& sum = (r.*side)[i];
      sum.assign(count * kBatchWidth, 0.0);
      for (std::size_t s = 0; s < sources.scatterer.size(); ++s) {
        batch::add_scaled(medium_->scatterers[s].share[i].data(),
                          (sources.scatterer[s].*side)[i].data(), sum.data(), count);
      }
    }
  }
  return r;
}

// docs/theory (5.2).
// What the beam's light, scattered once in a layer, adds to the rays that leave it.
void FourierModes::beam_sources() {
  if (beam_source_.count == 0) {
    beam_ = sources_of(std::vector<Parities>(levels(), sun_basis_));
    beam_source_ = source_function(beam_);
  }
  down_source_.resize(medium_->layers.size());
  up_source_.resize(medium_->layers.size());
  for (std::size_t i = 0; i < medium_->layers.size(); ++i) {
    const LayerMedium::Layer& w = medium_->layers[i];
    const std::size_t count = w.down.near.size() / kBatchWidth;
    down_source_[i].resize(count * kBatchWidth);
    up_source_[i].resize(count * kBatchWidth);
    batch::blend(w.down.near.data(), beam_source_.down[i].data(), w.down.far.data(),
                 beam_source_.down[i + 1].data(), down_source_[i].data(), count);
    batch::blend(w.up.near.data(), beam_source_.up[i + 1].data(), w.up.far.data(),
                 beam_source_.up[i].data(), up_source_[i].data(), count);
  }
}

// Adds near J_i + far J_{i+1} to the rays that look up, near J_{i+1} + far J_i to the others.
void FourierModes::add_diffuse_sources(const Columns& source, std::size_t columns) {
  for (std::size_t i = 0; i < medium_->layers.size(); ++i) {
    const LayerMedium::Layer& w = medium_->layers[i];
    const std::size_t n = rays(static_cast<int>(i));
    batch::add_blend(w.near.data(), source.down[i].data(), w.far.data(), source.down[i + 1].data(),
                     down_source_[i].data(), n, columns);
    batch::add_blend(w.near.data(), source.up[i + 1].data(), w.far.data(), source.up[i].data(),
                     up_source_[i].data(), n, columns);
  }
}

// docs/theory (5.8) and (5.9).
FourierModes::Columns FourierModes::substitute(const Batch& ground, std::size_t columns) const {
  const std::size_t width = columns * kBatchWidth;
  std::vector<Batch> s(levels());
  s[0] = ground;
  Batch stack;
  for (int i = 0; i + 1 < levels(); ++i) {
    const std::size_t n = rays(i);
    stack.clear();
    append(stack, s[i], n * width);
    append(stack, down_source_[i], n * width);
    append(stack, up_source_[i], n * width);
    s[i + 1].assign(rays(i + 1) * width, 0.0);
    batch::multiply(forward_[i].data(), stack.data(), nullptr, s[i + 1].data(), n, 3 * n, columns);
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
    batch::multiply(backward_[i].data(), stack.data(), nullptr, result.down[i].data(), n,
                    above + 3 * n, columns);
    result.up[i].resize(n * width);
    batch::multiply(reflection_[i].data(), result.down[i].data(), s[i].data(), result.up[i].data(),
                    n, n, columns);
  }
  return result;
}

// docs/theory (4.8).
std::vector<FourierModes::Parities> FourierModes::analyse(const Columns& columns) const {
  std::vector<Parities> moments(levels());
  for (int i = 0; i < levels(); ++i) {
    const std::size_t n = rays(i);
    std::array<Batch, 2> light = {columns.down[i], columns.up[i]};  // then sum and difference
    batch::butterfly(light[0].data(), light[1].data(), n * columns.count);
    for (std::size_t parity = 0; parity < 2; ++parity) {
      moments[i][parity].resize(rows_[parity] * columns.count * kBatchWidth);
      batch::multiply(analysis_[i][parity].data(), light[parity].data(), nullptr,
                      moments[i][parity].data(), rows_[parity], n, columns.count);
    }
  }
  return moments;
}

// docs/theory (5.10).
Batch FourierModes::irradiance(const Batch& down, std::size_t columns) const {
  Batch sum(columns * kBatchWidth, 0.0);
  for (int k = 0; k < streams_->count(0); ++k) {
    const double weight = 2 * std::numbers::pi * streams_->weight(0, k) * streams_->mu(0, k);
    const double* row = at(down, columns, static_cast<std::size_t>(k), 0);
    for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += weight * row[j];
  }
  return sum;
}

Batch FourierModes::at_every_ground_ray(const Batch& radiance) const {
  Batch r;
  for (std::size_t k = 0; k < rays(0); ++k) append(r, radiance, radiance.size());
  return r;
}

// albedo / pi times an irradiance per sun.
Batch FourierModes::reflected(Batch irradiance) const {
  for (std::size_t i = 0; i < irradiance.size(); ++i) irradiance[i] *= albedo_[i % kBatchWidth];
  return at_every_ground_ray(irradiance);
}

Batch FourierModes::beam_on_ground() const {
  Batch r = medium_->ground_beam;
  for (std::size_t i = 0; i < r.size(); ++i)
    r[i] *= std::max(medium_->sun_mu[i / kBatchWidth], 0.0);
  return r;
}

void FourierModes::solve_values() {
  values_ = substitute(reflected(beam_on_ground()), suns());
  moments_ = analyse(values_);
  ground_ = irradiance(values_.down[0], suns());
}

// What depends on the parameters, applied to the solution, is the source of the derivatives.
void FourierModes::set_tangent_sources() {
  const Sources diffuse = sources_of(moments_);
  for (int i = 0; i + 1 < levels(); ++i) {
    down_source_[i] = layer_tangent(i, true, diffuse, true);
    up_source_[i] = layer_tangent(i, false, diffuse, true);
  }
}

// docs/theory (6.2) and (6.3).
Batch FourierModes::layer_tangent(int layer, bool looks_up, const Sources& diffuse,
                                  bool near) const {
  const LayerMedium::Layer& w = medium_->layers[layer];
  const std::array<int, 2> level =
      looks_up ? std::array{layer, layer + 1} : std::array{layer + 1, layer};  // near, far
  const BeamWeights& b = looks_up ? w.down : w.up;
  const auto of = [&](const Columns& c, int i) {
    return (looks_up ? c.down : c.up)[static_cast<std::size_t>(level[i])].data();
  };
  const std::size_t p_count = medium_->parameters;
  const Batch zero(near ? 0 : rays(layer) * suns() * kBatchWidth, 0.0);
  const auto end = [&](int i) {
    const bool is_near = i == 0, none = is_near && !near;
    const auto& slopes = is_near ? b.near_slope : b.far_slope;
    const auto pick = [&](const double* x) { return none ? zero.data() : x; };
    const auto at_level = static_cast<std::size_t>(level[i]);
    batch::LayerEndTangent tangent{
        pick((is_near ? w.near_slope : w.far_slope).data()),
        pick((is_near ? w.near : w.far).data()),
        pick((is_near ? b.near : b.far).data()),
        {pick(slopes[0].data()), pick(slopes[1].data()), pick(slopes[2].data())},
        {}};
    for (std::size_t s = 0; s < medium_->scatterers.size(); ++s) {
      const LayerMedium::Scatterer& scatterer = medium_->scatterers[s];
      tangent.scatterer[s] = {scatterer.share[at_level].data(),
                              scatterer.share_tangent[at_level].data(), of(diffuse.scatterer[s], i),
                              of(beam_.scatterer[s], i)};
    }
    return tangent;
  };
  Batch out(rays(layer) * suns() * p_count * kBatchWidth);
  const batch::LayerTangent in{{end(0), end(1)},
                               medium_->scatterers.size(),
                               w.t.data(),
                               of(values_, 1),
                               w.depth_tangent.data(),
                               medium_->sun_depth_tangent[level[0]].data(),
                               medium_->sun_depth_tangent[level[1]].data()};
  batch::layer_tangent(in, out.data(), rays(layer), suns(), p_count);
  for (std::size_t q = 0; q < diffuse.phase.size(); ++q) {
    const LayerMedium::PhaseTangent& phase = medium_->phase_tangents[q];
    const auto phase_end = [&](int i) {
      return batch::PhaseTangent{in.end[i].scatterer[phase.scatterer].share, in.end[i].weight,
                                 of(diffuse.phase[q], i), in.end[i].beam, of(beam_.phase[q], i)};
    };
    const batch::PhaseTangent ends[2] = {phase_end(0), phase_end(1)};
    batch::add_phase_tangent(ends, out.data(), rays(layer), suns(), p_count, phase.parameter);
  }
  return out;
}

// docs/theory (6.4), then (5.8) and (5.9).
void FourierModes::solve_tangents() {
  const std::size_t p_count = medium_->parameters, columns = suns() * p_count;
  Batch on_ground(columns * kBatchWidth);
  for (std::size_t j = 0; j < suns(); ++j) {
    const double mu = std::max(medium_->sun_mu[j], 0.0);
    for (std::size_t p = 0; p < p_count; ++p) {
      for (std::size_t k = 0; k < kBatchWidth; ++k) {
        const std::size_t sun = j * kBatchWidth + k, column = (j * p_count + p) * kBatchWidth + k;
        const double beam = mu * medium_->ground_beam[sun];
        on_ground[column] = albedo_tangent_[p * kBatchWidth + k] * (ground_[sun] + beam) -
                            albedo_[k] * beam * medium_->sun_depth_tangent[0][column];
      }
    }
  }
  tangents_ = substitute(at_every_ground_ray(on_ground), columns);
  moment_tangents_ = analyse(tangents_);
  ground_tangent_ = irradiance(tangents_.down[0], columns);
}

void FourierModes::advance() {
  Batch ground;
  if (moments_.empty()) {
    beam_sources();
    ground = reflected(beam_on_ground());
  } else {
    for (auto* sources : {&down_source_, &up_source_}) {
      for (Batch& source : *sources) std::ranges::fill(source, 0.0);
    }
    add_diffuse_sources(at_rays(scattered(moments_), suns()), suns());
    ground = reflected(ground_);
  }
  const std::size_t width = suns();
  values_ = {width, std::vector<Batch>(levels()), std::vector<Batch>(levels())};
  values_.down.back().assign(rays(levels() - 1) * width * kBatchWidth, 0.0);
  for (int i = levels() - 2; i >= 0; --i) {
    Batch& d = values_.down[i] = down_source_[i];
    add_block(medium_->layers[i].t.data(), values_.down[i + 1], width, 0, d, width, 0, rays(i),
              width);
  }
  values_.up[0] = ground;
  for (int i = 0; i + 1 < levels(); ++i) {
    // A ray that begins at level i + 1 comes from its other half.
    Batch& u = values_.up[i + 1] = values_.down[i + 1];
    std::ranges::copy(up_source_[i], u.begin());
    add_block(medium_->layers[i].t.data(), values_.up[i], width, 0, u, width, 0, rays(i), width);
  }
  moments_ = analyse(values_);
  ground_ = irradiance(values_.down[0], width);
}

void FourierModes::solve() {
  eliminate();
  beam_sources();
  solve_values();
  if (medium_->parameters == 0) return;
  set_tangent_sources();
  solve_tangents();
}

void FourierModes::append_moments(int lane, int level, LargeArray& out) const {
  const std::size_t p_count = medium_->parameters;
  for (int offset = 0; offset < medium_->moments - modes_[lane]; ++offset) {  // l - m
    const std::size_t parity = offset % 2, row = offset / 2;
    const double* value = at(moments_[level][parity], suns(), row, 0) + lane;
    const double* tangent =
        p_count > 0 ? at(moment_tangents_[level][parity], suns() * p_count, row, 0) + lane
                    : nullptr;
    for (std::size_t j = 0; j < suns(); ++j, value += kBatchWidth) {
      out.push_back(*value);
      for (std::size_t p = 0; p < p_count; ++p, tangent += kBatchWidth) out.push_back(*tangent);
    }
  }
}

void FourierModes::append_ground_irradiance(int lane, LargeArray& out) const {
  const std::size_t p_count = medium_->parameters;
  for (std::size_t j = 0; j < suns(); ++j) {
    out.push_back(ground_[j * kBatchWidth + lane]);
    for (std::size_t p = 0; p < p_count; ++p)
      out.push_back(ground_tangent_[(j * p_count + p) * kBatchWidth + lane]);
  }
}

}  // namespace skyfit
