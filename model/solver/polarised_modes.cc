// SPDX-License-Identifier: Apache-2.0
#include "model/solver/polarised_modes.h"

#include <algorithm>
#include <numbers>

namespace skyfit {
namespace {

std::vector<std::size_t> polarising_scatterers(const LayerMedium& medium) {
  std::vector<std::size_t> list;
  for (std::size_t s = 0; s < medium.scatterers.size(); ++s) {
    if (medium.scatterers[s].polarises) list.push_back(s);
  }
  return list;
}

const double* second_moment_of(const LayerMedium::Scatterer& s) { return at(s.chi, 1, 2, 0); }

}  // namespace

bool PolarisedModes::any(const LaneModes& modes) {
  return std::ranges::any_of(modes, [](int m) { return m < kPolarisedModes; });
}

PolarisedModes::PolarisedModes(const Streams& streams, const LayerMedium& intensity,
                               const LayerMedium& polarised, const LaneModes& modes)
    : streams_(&streams),
      intensity_(&intensity),
      polarised_(&polarised),
      modes_(modes),
      air_(polarising_scatterers(polarised)),
      intensity_pattern_(pattern_of(Stokes::kI)) {
  for (const Stokes which : {Stokes::kQ, Stokes::kU})
    components_.push_back({pattern_of(which), {streams, polarised, air_, modes}});
  set_beam();
  set_transport();
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

// docs/theory (13.6): the sun's beam has the moment Lambda_2m(mu_s).
void PolarisedModes::set_beam() {
  const std::size_t suns = polarised_->suns;
  Batch beam(level_count() * suns * kBatchWidth);
  for (std::size_t i = 0; i < level_count(); ++i) {
    for (std::size_t j = 0; j < suns; ++j) {
      for (std::size_t k = 0; k < kBatchWidth; ++k)
        at(beam, suns, i, j)[k] = rayleigh_stokes(modes_[k], polarised_->sun_mu[j]).i;
    }
  }
  for (Component& c : components_) c.light.set_beam(sources(c.pattern, beam));
}

StreamSources PolarisedModes::sources(const Pattern& pattern, const Batch& moments) const {
  const std::size_t suns = polarised_->suns;
  StreamSources r;
  for (const std::size_t s : air_)
    r.scatterer.push_back(source(pattern, by_second_moment(s, moments, suns), suns));
  return r;
}

void PolarisedModes::add_sources(StreamSources& sources) const {
  const std::size_t suns = polarised_->suns;
  for (const std::size_t s : air_)
    add(source(intensity_pattern_, by_second_moment(s, moments_, suns), suns),
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
    StreamLight light(*streams_, *polarised_, air_, modes_);
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

void PolarisedModes::solve_values(const Batch& unpolarised) {
  const std::size_t suns = polarised_->suns;
  moments_ = solve(unpolarised, suns);
  all_ = total(unpolarised, moments_, suns);
}

// The light of Q and U itself, from K and the layers' other sources.
StreamColumns PolarisedModes::completed(Component& component, const Batch& all,
                                        std::size_t columns) const {
  component.light.add_diffuse_sources(
      source(component.pattern, scaled(*polarised_, all, columns), columns));
  return sweep(component.light, columns);
}

void PolarisedModes::set_tangent_sources() {
  for (Component& c : components_) {
    c.light.values = completed(c, all_, polarised_->suns);
    c.light.set_tangent_sources(sources(c.pattern, all_));
  }
}

void PolarisedModes::solve_tangents(const Batch& unpolarised) {
  const std::size_t columns = polarised_->suns * polarised_->parameters;
  moment_tangents_ = solve(unpolarised, columns);
  all_tangents_ = total(unpolarised, moment_tangents_, columns);
}

void PolarisedModes::advance(const Batch& second) {
  const std::size_t suns = polarised_->suns;
  if (moments_.empty()) {
    set_beam_sources();
  } else {
    for (std::size_t k = 0; k < second.size(); ++k) moments_[k] += second[k];
    const Batch scattered = scaled(*polarised_, moments_, suns);
    for (Component& c : components_) {
      c.light.clear_sources(suns);
      c.light.add_diffuse_sources(source(c.pattern, scattered, suns));
    }
  }
  moments_ = polarised_moments(suns);
}

void PolarisedModes::prepare_coupling(const HorizontalCoupling& coupling) {
  const std::size_t columns = polarised_->suns * polarised_->parameters;
  for (Component& c : components_) {
    StreamColumns tangent;
    if (columns > 0) {
      tangent = source(c.pattern, scaled(*polarised_, all_tangents_, columns), columns);
      c.light.tangents = completed(c, all_tangents_, columns);
    } else {
      c.light.values = completed(c, all_, polarised_->suns);
    }
    c.light.prepare_coupling(coupling, sources(c.pattern, all_), tangent);
  }
}

void PolarisedModes::add_coupling(const HorizontalCoupling& coupling, const ModesOf& modes_of,
                                  int width, StreamLight::Kind kind) {
  for (std::size_t c = 0; c < components_.size(); ++c) {
    const auto light_of = [&](int mode) -> StreamLight::OfMode {
      const OfMode of = modes_of(mode);
      return {of.modes ? &of.modes->components_[c].light : nullptr, of.first_lane};
    };
    components_[c].light.add_coupling(coupling, light_of, width, kind);
  }
}

}  // namespace skyfit
