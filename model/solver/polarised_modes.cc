// SPDX-License-Identifier: Apache-2.0
#include "model/solver/polarised_modes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace skyfit {
namespace {

bool polarised_by_air(const LaneModes& modes) {
  return std::ranges::any_of(modes, [](int m) { return m < kPolarisedModes; });
}

bool has_matrix(const LayerMedium::Scatterer& s) { return !s.matrix.alpha.empty(); }

// The scatterers that give light of these modes polarisation.
std::vector<std::size_t> polarising_scatterers(const LayerMedium& medium, const LaneModes& modes) {
  std::vector<std::size_t> list;
  for (std::size_t s = 0; s < medium.scatterers.size(); ++s) {
    const LayerMedium::Scatterer& scatterer = medium.scatterers[s];
    if ((scatterer.polarises && polarised_by_air(modes)) || has_matrix(scatterer))
      list.push_back(s);
  }
  return list;
}

const double* second_moment_of(const LayerMedium::Scatterer& s) { return at(s.chi, 1, 2, 0); }

}  // namespace

bool PolarisedModes::any(const LaneModes& modes, const LayerMedium& medium) {
  return medium.has_matrices() || polarised_by_air(modes);
}

PolarisedModes::PolarisedModes(const Streams& streams, const LayerMedium& intensity,
                               const LayerMedium& polarised, const LaneModes& modes)
    : streams_(&streams),
      intensity_(&intensity),
      polarised_(&polarised),
      modes_(modes),
      polarising_(polarising_scatterers(polarised, modes)),
      intensity_pattern_(pattern_of(Stokes::kI)) {
  std::ranges::copy_if(polarising_, std::back_inserter(air_),
                       [&](std::size_t s) { return polarised.scatterers[s].polarises; });
  if (polarised.has_matrices()) particles_.emplace(streams, intensity, polarised, modes);
  for (const Stokes which : {Stokes::kQ, Stokes::kU}) {
    components_.push_back({pattern_of(which), {streams, polarised, polarising_, modes}});
  }
  if (has_air()) set_transport();
}

// docs/theory (13.5) and (13.7).
PolarisedModes::Pattern PolarisedModes::pattern_of(Stokes which) const {
  Pattern pattern;
  for (int i = 0; i < levels(); ++i) {
    for (auto* side : {&pattern.down, &pattern.up, &pattern.down_weight, &pattern.up_weight})
      side->emplace_back(rays(i) * kBatchWidth, 0.0);
    for (std::size_t k = 0; k < rays(i); ++k) {
      const int ray = static_cast<int>(k);
      const double mu = streams_->mu(i, ray),
                   weight = 2 * std::numbers::pi * streams_->weight(i, ray);
      double down = 0, up = 0;
      for (std::size_t lane = 0; lane < kBatchWidth; ++lane) {
        if (lane == 0 || modes_[lane] != modes_[lane - 1]) {
          down = component(rayleigh_stokes(modes_[lane], mu), which);
          up = component(rayleigh_stokes(modes_[lane], -mu), which);
        }
        const std::size_t e = k * kBatchWidth + lane;
        pattern.down[i][e] = down;
        pattern.up[i][e] = up;
        pattern.down_weight[i][e] = weight * pattern.down[i][e];
        pattern.up_weight[i][e] = weight * pattern.up[i][e];
      }
    }
  }
  return pattern;
}

// The pattern at the streams times a number per level.
StreamColumns PolarisedModes::source(const Pattern& pattern, const Batch& moments,
                                     std::size_t columns) const {
  StreamColumns r{columns, std::vector<Batch>(levels()), std::vector<Batch>(levels())};
  for (int i = 0; i < levels(); ++i) {
    const double* const row = at(moments, columns, static_cast<std::size_t>(i), 0);
    for (const auto& [out, in] :
         {std::pair{&r.down[i], &pattern.down[i]}, std::pair{&r.up[i], &pattern.up[i]}}) {
      out->resize(rays(i) * columns * kBatchWidth);
      batch::multiply(in->data(), row, nullptr, out->data(), rays(i), 1, columns);
    }
  }
  return r;
}

void PolarisedModes::add_moments(const Pattern& pattern, const StreamColumns& light,
                                 Batch& moments) const {
  Batch sum(light.count * kBatchWidth);
  for (int i = 0; i < levels(); ++i) {
    double* const row = at(moments, light.count, static_cast<std::size_t>(i), 0);
    batch::multiply(pattern.down_weight[i].data(), light.down[i].data(), row, sum.data(), 1,
                    rays(i), light.count);
    batch::multiply(pattern.up_weight[i].data(), light.up[i].data(), sum.data(), row, 1, rays(i),
                    light.count);
  }
}

Batch PolarisedModes::second_moments(const StreamColumns& light) const {
  Batch moments(level_count() * light.count * kBatchWidth, 0.0);
  add_moments(intensity_pattern_, light, moments);
  return moments;
}

// Times sum of share chi_2 over the scatterers that polarise: source per moment.
Batch PolarisedModes::scaled(const LayerMedium& medium, const Batch& moments,
                             std::size_t columns) const {
  Batch factor(level_count() * kBatchWidth, 0.0), r(moments.size());
  for (const std::size_t s : air_) {
    const LayerMedium::Scatterer& scatterer = medium.scatterers[s];
    for (std::size_t i = 0; i < level_count(); ++i) {
      for (std::size_t k = 0; k < kBatchWidth; ++k)
        at(factor, 1, i, 0)[k] += scatterer.share[i][k] * second_moment_of(scatterer)[k];
    }
  }
  batch::scale_rows(factor.data(), moments.data(), r.data(), level_count(), columns);
  return r;
}

StreamColumns PolarisedModes::intensity_source(const Batch& moments, std::size_t columns) const {
  return source(intensity_pattern_, scaled(*intensity_, moments, columns), columns);
}

Batch PolarisedModes::by_second_moment(std::size_t scatterer, const Batch& moments,
                                       std::size_t columns) const {
  Batch r(moments.size(), 0.0);
  batch::add_scaled(second_moment_of(polarised_->scatterers[scatterer]), moments.data(), r.data(),
                    level_count() * columns);
  return r;
}

// docs/theory (13.6): the sun's beam has the moment Lambda_2m(mu_s), and no polarisation.
void PolarisedModes::set_beam(const LevelMoments& beam) {
  const std::size_t suns = polarised_->suns;
  Batch second(level_count() * suns * kBatchWidth);
  for (std::size_t i = 0; i < level_count(); ++i) {
    for (std::size_t j = 0; j < suns; ++j) {
      for (std::size_t k = 0; k < kBatchWidth; ++k)
        at(second, suns, i, j)[k] = rayleigh_stokes(modes_[k], polarised_->sun_mu[j]).i;
    }
  }
  std::array<StreamSources, 2> of_beam = sources(second, beam, {});
  for (std::size_t c = 0; c < components_.size(); ++c)
    components_[c].light.set_beam(std::move(of_beam[c]));
}

std::array<StreamSources, 2> PolarisedModes::sources(const Batch& moments,
                                                     const LevelMoments& intensity,
                                                     const SpinMoments& spin) const {
  const std::size_t suns = polarised_->suns;
  std::array<StreamSources, 2> r;
  const auto add_of = [&](const ParticleMatrices::Moments& matrix, auto list) {
    std::array<StreamColumns, 2> light = particles_->scattered_by(matrix, intensity, spin, suns);
    for (std::size_t c = 0; c < 2; ++c) (r[c].*list).push_back(std::move(light[c]));
  };
  for (const std::size_t s : polarising_) {
    if (polarised_->scatterers[s].polarises) {
      for (std::size_t c = 0; c < 2; ++c)
        r[c].scatterer.push_back(
            source(components_[c].pattern, by_second_moment(s, moments, suns), suns));
    } else {
      add_of(particles_->scatterers()[s], &StreamSources::scatterer);
    }
  }
  if (!particles_) return r;
  for (const ParticleMatrices::Moments& matrix : particles_->tangents())
    add_of(matrix, &StreamSources::phase);
  return r;
}

void PolarisedModes::add_sources(StreamSources& sources) const {
  const std::size_t suns = polarised_->suns;
  for (const std::size_t s : air_)
    add(source(intensity_pattern_, by_second_moment(s, moments(Kind::kValues), suns), suns),
        sources.scatterer[s]);
}

// docs/theory (13.9).
// Light along each stream by itself, from the layers' sources. A ray that begins at level i + 1
// comes from its other half; its meridian plane is the same.
StreamColumns PolarisedModes::sweep(const StreamLight& light, std::size_t columns) const {
  StreamColumns r{columns, std::vector<Batch>(levels()), std::vector<Batch>(levels())};
  r.down.back().assign(rays(levels() - 1) * columns * kBatchWidth, 0.0);
  for (int i = levels() - 2; i >= 0; --i) {
    r.down[i] = light.down_source[i];
    add_block(polarised_->layers[i].t.data(), r.down[i + 1], columns, 0, r.down[i], columns, 0,
              rays(i), columns);
  }
  r.up[0].assign(rays(0) * columns * kBatchWidth, 0.0);  // the ground reflects no polarised light
  for (int i = 0; i + 1 < levels(); ++i) {
    Batch& u = r.up[i + 1] = r.down[i + 1];
    std::ranges::copy(light.up_source[i], u.begin());
    add_block(polarised_->layers[i].t.data(), r.up[i], columns, 0, u, columns, 0, rays(i), columns);
  }
  return r;
}

// P of the sweeps of Q and U from the sources that their layers have now.
Batch PolarisedModes::polarised_moments(std::size_t columns) const {
  Batch moments(level_count() * columns * kBatchWidth, 0.0);
  for (const Component& c : components_) add_moments(c.pattern, sweep(c.light, columns), moments);
  return moments;
}

// docs/theory (13.10).
// G, from unit moments at each level.
void PolarisedModes::set_transport() {
  const std::size_t n = level_count();
  Batch unit(n * n * kBatchWidth, 0.0);
  add_diagonal(nullptr, unit, n, 0, n);
  const Batch source_of_unit = scaled(*polarised_, unit, n);
  transport_.assign(n * n * kBatchWidth, 0.0);
  for (const Component& c : components_) {
    StreamLight light(*streams_, *polarised_, polarising_, modes_);
    light.clear_sources(n);
    light.add_diffuse_sources(source(c.pattern, source_of_unit, n));
    add_moments(c.pattern, sweep(light, n), transport_);
  }
}

void PolarisedModes::set_response(const Batch& response) {
  const std::size_t n = level_count();
  response_ = response;
  Batch one_more = response, product(response.size()), matrix(response.size(), 0.0);
  add_diagonal(nullptr, one_more, n, 0, n);
  batch::multiply(transport_.data(), one_more.data(), nullptr, product.data(), n, n, n);
  add_diagonal(nullptr, matrix, n, 0, n);
  add_block(nullptr, product, n, 0, matrix, n, 0, n, n, -1);
  inverse_.assign(response.size(), 0.0);
  add_diagonal(nullptr, inverse_, n, 0, n);
  batch::solve(matrix.data(), inverse_.data(), n, n);
}

// docs/theory (13.12).
Batch PolarisedModes::solve(const Batch& unpolarised, std::size_t columns) const {
  const std::size_t n = level_count();
  const Batch from_sources = polarised_moments(columns);
  Batch right(unpolarised.size()), moments(unpolarised.size());
  batch::multiply(transport_.data(), unpolarised.data(), from_sources.data(), right.data(), n, n,
                  columns);
  batch::multiply(inverse_.data(), right.data(), nullptr, moments.data(), n, n, columns);
  return moments;
}

// K = M_2 + R P + P.
Batch PolarisedModes::total(const Batch& unpolarised, const Batch& moments,
                            std::size_t columns) const {
  const std::size_t n = level_count();
  Batch r(unpolarised.size());
  batch::multiply(response_.data(), moments.data(), unpolarised.data(), r.data(), n, n, columns);
  for (std::size_t k = 0; k < r.size(); ++k) r[k] += moments[k];
  return r;
}

void PolarisedModes::set_beam_sources() {
  for (Component& c : components_) c.light.set_beam_sources();
}

void PolarisedModes::begin_steps(Kind kind) {
  State& state = state_[kind];
  for (std::size_t c = 0; c < components_.size(); ++c) {
    state.down_source[c] = components_[c].light.down_source;
    state.up_source[c] = components_[c].light.up_source;
  }
}

void PolarisedModes::add_particle_sources(const LevelMoments& intensity, const SpinMoments& spin,
                                          std::size_t columns) {
  const std::array<StreamColumns, 2> light = particles_->scattered(intensity, spin, columns);
  for (std::size_t c = 0; c < components_.size(); ++c)
    components_[c].light.add_diffuse_sources(light[c]);
}

// docs/theory (13.12), of M_2 = second moment of I - R P where I holds what P does to it.
void PolarisedModes::solve_air(Kind kind, const StreamColumns& light, bool polarised) {
  State& state = state_[kind];
  const std::size_t n = level_count();
  Batch unpolarised = second_moments(light);
  if (polarised) {
    Batch response(unpolarised.size());
    batch::multiply(response_.data(), state.moments.data(), nullptr, response.data(), n, n,
                    columns(kind));
    for (std::size_t k = 0; k < response.size(); ++k) unpolarised[k] -= response[k];
  }
  state.moments = solve(unpolarised, columns(kind));
  state.all = total(unpolarised, state.moments, columns(kind));
}

double PolarisedModes::solve(Kind kind, const StreamColumns& light, const LevelMoments& intensity,
                             bool polarised) {
  State& state = state_[kind];
  if (has_matrices()) {
    for (std::size_t c = 0; c < components_.size(); ++c) {
      components_[c].light.down_source = state.down_source[c];
      components_[c].light.up_source = state.up_source[c];
    }
    add_particle_sources(intensity, state.spin, columns(kind));
  }
  if (has_air()) solve_air(kind, light, polarised);
  if (!has_matrices()) return 0;
  complete(kind);
  SpinMoments spin = particles_->basis().analyse(components_[0].light.light(kind),
                                                 components_[1].light.light(kind));
  const double changed = ParticleMatrices::change(spin, state.spin, intensity, columns(kind));
  state.spin = std::move(spin);
  return changed;
}

// The light of Q and U itself, from K and the layers' other sources.
void PolarisedModes::complete(Kind kind) {
  if (has_air()) add_air_sources(state_[kind].all, columns(kind));
  for (Component& c : components_) c.light.light(kind) = sweep(c.light, columns(kind));
}

void PolarisedModes::add_air_sources(const Batch& moments, std::size_t columns) {
  const Batch scattered_by_air = scaled(*polarised_, moments, columns);
  for (Component& c : components_)
    c.light.add_diffuse_sources(source(c.pattern, scattered_by_air, columns));
}

void PolarisedModes::set_tangent_sources(const LevelMoments& intensity) {
  const State& state = state_[Kind::kValues];
  if (!has_matrices()) complete(Kind::kValues);
  const std::array<StreamSources, 2> of = sources(state.all, intensity, state.spin);
  for (std::size_t c = 0; c < components_.size(); ++c)
    components_[c].light.set_tangent_sources(of[c]);
}

void PolarisedModes::advance(const StreamColumns& light, const LevelMoments& intensity) {
  const std::size_t suns = polarised_->suns;
  State& state = state_[Kind::kValues];
  if (intensity.empty()) {
    set_beam_sources();
  } else {
    for (Component& c : components_) c.light.clear_sources(suns);
    if (has_air()) {
      const Batch second = second_moments(light);
      for (std::size_t k = 0; k < second.size(); ++k) state.moments[k] += second[k];
      add_air_sources(state.moments, suns);
    }
    if (has_matrices()) add_particle_sources(intensity, state.spin, suns);
  }
  if (has_air()) state.moments = polarised_moments(suns);
  if (has_matrices())
    state.spin = particles_->basis().analyse(sweep(components_[0].light, suns),
                                             sweep(components_[1].light, suns));
}

}  // namespace skyfit
