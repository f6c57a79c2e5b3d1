// SPDX-License-Identifier: Apache-2.0
#include "model/solver/fourier_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace skyfit {

namespace {

std::vector<std::size_t> all_scatterers(const LayerMedium& medium) {
  std::vector<std::size_t> list(medium.scatterers.size());
  std::iota(list.begin(), list.end(), 0);
  return list;
}

}  // namespace

FourierModes::FourierModes(const Streams& streams, const LayerMedium& medium,
                           const LayerMedium* polarised, const std::vector<ModeBasis>& bases,
                           const LaneModes& modes)
    : streams_(&streams),
      medium_(&medium),
      modes_(modes),
      light_(streams, medium, all_scatterers(medium), modes) {
  if (polarised && PolarisedModes::any(modes, *polarised))
    polarised_.emplace(streams, medium, *polarised, modes);
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

void FourierModes::set_beam() {
  if (light_.has_beam()) return;
  const LevelMoments beam(levels(), sun_basis_);
  light_.set_beam(sources_of(beam));
  if (polarised_) polarised_->set_beam(beam);
}

// docs/theory (5.8) and (5.9).
StreamColumns FourierModes::substitute(const Batch& ground, std::size_t columns) const {
  const std::size_t width = columns * kBatchWidth;
  std::vector<Batch> s(levels());
  s[0] = ground;
  Batch stack;
  for (int i = 0; i + 1 < levels(); ++i) {
    const std::size_t n = rays(i);
    stack.clear();
    append(stack, s[i], n * width);
    append(stack, light_.down_source[i], n * width);
    append(stack, light_.up_source[i], n * width);
    s[i + 1].assign(rays(i + 1) * width, 0.0);
    batch::multiply(forward_[i].data(), stack.data(), nullptr, s[i + 1].data(), n, 3 * n, columns);
  }
  StreamColumns result;
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
    append(stack, light_.down_source[i], n * width);
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
LevelMoments FourierModes::analyse(const StreamColumns& columns) const {
  LevelMoments moments(levels());
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

// docs/theory (13.11).
// The second moments of I that a unit of the source of polarised light leaves, level by level.
void FourierModes::set_polarised_response() {
  const auto n = static_cast<std::size_t>(levels());
  Batch unit(n * n * kBatchWidth, 0.0);
  add_diagonal(nullptr, unit, n, 0, n);
  light_.clear_sources(n);
  light_.add_diffuse_sources(polarised_->intensity_source(unit, n));
  const Batch dark(rays(0) * n * kBatchWidth, 0.0);
  polarised_->set_response(polarised_->second_moments(substitute(dark, n)));
}

// The source function of I that Q and U make.
StreamColumns FourierModes::source_of_polarised(StreamLight::Kind kind, std::size_t columns) const {
  StreamColumns source;
  if (polarised_->has_air())
    source = polarised_->intensity_source(polarised_->moments(kind), columns);
  if (!polarised_->has_matrices()) return source;
  StreamColumns of_particles = at_rays(
      polarised_->particles().intensity_moments(polarised_->spin_moments(kind), columns), columns);
  if (!polarised_->has_air()) return of_particles;
  add(of_particles, source);
  return source;
}

// From the sources that the layers have now and the light that the ground sends up.
void FourierModes::solve_light(StreamLight::Kind kind, const Batch& ground, std::size_t columns) {
  // Of the moments of Q and U from step to step, as a share of the largest of I: when they are
  // found, and what is too much to leave.
  constexpr double kChange = 1e-5, kUnsettled = 1e-3;
  constexpr int kMostSteps = 50;
  StreamColumns& light = light_.light(kind);
  light = substitute(ground, columns);
  LevelMoments& moments = kind == StreamLight::kValues ? moments_ : moment_tangents_;
  if (polarised_) {
    const bool in_steps = polarised_->has_matrices();
    std::array<std::vector<Batch>, 2> own;
    if (in_steps) {
      own = {light_.down_source, light_.up_source};
      polarised_->begin_steps(kind);
    }
    double change = 0;
    for (int step = 0; step < (in_steps ? kMostSteps : 1); ++step) {
      if (in_steps) moments = analyse(light);
      change = polarised_->solve(kind, light, moments, step > 0);
      if (step > 0) {
        light_.down_source = own[0];
        light_.up_source = own[1];
      }
      light_.add_diffuse_sources(source_of_polarised(kind, columns));
      light = substitute(ground, columns);
      if (change < kChange) break;
    }
    if (!(change < kUnsettled)) {
      throw std::runtime_error(fmt::format(
          "reference model: what particles make of polarised light still changes by {:.2g} of the "
          "radiance after {} steps: this atmosphere is more than the solver can do",
          change, kMostSteps));
    }
  }
  moments = analyse(light);
}

void FourierModes::solve_values() {
  solve_light(StreamLight::kValues, reflected(beam_on_ground()), suns());
  ground_ = irradiance(light_.values.down[0], suns());
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
  solve_light(StreamLight::kTangents, at_every_ground_ray(on_ground), columns);
  ground_tangent_ = irradiance(light_.tangents.down[0], columns);
}

void FourierModes::advance() {
  const std::size_t width = suns();
  Batch ground;
  if (moments_.empty()) {
    set_beam();
    light_.set_beam_sources();
    ground = reflected(beam_on_ground());
  } else {
    light_.clear_sources(width);
    light_.add_diffuse_sources(at_rays(scattered(moments_, width), width));
    if (polarised_) light_.add_diffuse_sources(source_of_polarised(StreamLight::kValues, width));
    ground = reflected(ground_);
  }
  if (polarised_) polarised_->advance(light_.values, moments_);
  StreamColumns& values = light_.values;
  values = {width, std::vector<Batch>(levels()), std::vector<Batch>(levels())};
  values.down.back().assign(rays(levels() - 1) * width * kBatchWidth, 0.0);
  for (int i = levels() - 2; i >= 0; --i) {
    Batch& d = values.down[i] = light_.down_source[i];
    add_block(medium_->layers[i].t.data(), values.down[i + 1], width, 0, d, width, 0, rays(i),
              width);
  }
  values.up[0] = ground;
  for (int i = 0; i + 1 < levels(); ++i) {
    // A ray that begins at level i + 1 comes from its other half.
    Batch& u = values.up[i + 1] = values.down[i + 1];
    std::ranges::copy(light_.up_source[i], u.begin());
    add_block(medium_->layers[i].t.data(), values.up[i], width, 0, u, width, 0, rays(i), width);
  }
  moments_ = analyse(values);
  ground_ = irradiance(values.down[0], width);
}

void FourierModes::solve() {
  eliminate();
  set_beam();
  if (polarised_ && polarised_->has_air()) set_polarised_response();
  set_beam_sources();
  solve_values();
  if (medium_->parameters == 0) return;
  set_tangent_sources();
  solve_tangents();
}

void FourierModes::set_beam_sources() {
  light_.set_beam_sources();
  if (polarised_) polarised_->set_beam_sources();
}

void FourierModes::set_tangent_sources() {
  light_.set_tangent_sources(diffuse_sources());
  if (polarised_) polarised_->set_tangent_sources(moments_);
}

void FourierModes::append_moments(int lane, int level, LargeArray& out) const {
  const std::size_t p_count = medium_->parameters;
  const auto append_row = [&](const Batch& values, const Batch* tangents, std::size_t row) {
    const double* value = at(values, suns(), row, 0) + lane;
    const double* tangent = p_count > 0 ? at(*tangents, suns() * p_count, row, 0) + lane : nullptr;
    for (std::size_t j = 0; j < suns(); ++j, value += kBatchWidth) {
      out.push_back(*value);
      for (std::size_t p = 0; p < p_count; ++p, tangent += kBatchWidth) out.push_back(*tangent);
    }
  };
  const auto append_all = [&](const LevelMoments& values, const LevelMoments& tangents, int first) {
    for (int offset = first; offset < medium_->moments - modes_[lane]; ++offset) {  // l - m
      const std::size_t parity = offset % 2;
      append_row(values[level][parity], p_count > 0 ? &tangents[level][parity] : nullptr,
                 offset / 2);
    }
  };
  append_all(moments_, moment_tangents_, 0);
  if (!polarised_) return;
  if (modes_[lane] < kPolarisedModes) {
    append_row(polarised_->moments(StreamLight::kValues),
               &polarised_->moments(StreamLight::kTangents), static_cast<std::size_t>(level));
  }
  if (!polarised_->has_matrices()) return;
  const SpinMoments &values = polarised_->spin_moments(StreamLight::kValues),
                    &tangents = polarised_->spin_moments(StreamLight::kTangents);
  const int first = std::max(2 - modes_[lane], 0);
  append_all(values.b, tangents.b, first);
  append_all(values.c, tangents.c, first);
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
