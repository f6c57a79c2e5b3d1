// SPDX-License-Identifier: Apache-2.0
#include "model/solver/stream_light.h"

namespace skyfit {

void add(const StreamColumns& more, StreamColumns& to) {
  for (auto side : {&StreamColumns::down, &StreamColumns::up}) {
    for (std::size_t i = 0; i < (to.*side).size(); ++i) {
      for (std::size_t k = 0; k < (to.*side)[i].size(); ++k) (to.*side)[i][k] += (more.*side)[i][k];
    }
  }
}

void StreamLight::set_beam(StreamSources per_unit_beam) {
  beam_ = std::move(per_unit_beam);
  beam_source_ = source_function(beam_);
}

StreamColumns StreamLight::source_function(const StreamSources& sources) const {
  StreamColumns r{suns(), std::vector<Batch>(levels()), std::vector<Batch>(levels())};
  for (int i = 0; i < levels(); ++i) {
    const std::size_t count = rays(i) * suns();
    for (auto side : {&StreamColumns::down, &StreamColumns::up}) {
      Batch& sum = (r.*side)[i];
      sum.assign(count * kBatchWidth, 0.0);
      for (std::size_t s = 0; s < sources.scatterer.size(); ++s) {
        batch::add_scaled(scatterer(s).share[i].data(), (sources.scatterer[s].*side)[i].data(),
                          sum.data(), count);
      }
    }
  }
  return r;
}

// docs/theory (5.2).
void StreamLight::set_beam_sources() {
  down_source.resize(medium_->layers.size());
  up_source.resize(medium_->layers.size());
  for (std::size_t i = 0; i < medium_->layers.size(); ++i) {
    const LayerMedium::Layer& w = medium_->layers[i];
    const std::size_t count = w.down.near.size() / kBatchWidth;
    down_source[i].resize(count * kBatchWidth);
    up_source[i].resize(count * kBatchWidth);
    batch::blend(w.down.near.data(), beam_source_.down[i].data(), w.down.far.data(),
                 beam_source_.down[i + 1].data(), down_source[i].data(), count);
    batch::blend(w.up.near.data(), beam_source_.up[i + 1].data(), w.up.far.data(),
                 beam_source_.up[i].data(), up_source[i].data(), count);
  }
}

void StreamLight::clear_sources(std::size_t columns) {
  for (auto* sources : {&down_source, &up_source}) {
    sources->resize(medium_->layers.size());
    for (std::size_t i = 0; i < sources->size(); ++i)
      (*sources)[i].assign(rays(static_cast<int>(i)) * columns * kBatchWidth, 0.0);
  }
}

// Adds near J_i + far J_{i+1} to the rays that look up, near J_{i+1} + far J_i to the others.
void StreamLight::add_diffuse_sources(const StreamColumns& source) {
  for (std::size_t i = 0; i < medium_->layers.size(); ++i) {
    const LayerMedium::Layer& w = medium_->layers[i];
    const std::size_t n = rays(static_cast<int>(i));
    batch::add_blend(w.near.data(), source.down[i].data(), w.far.data(), source.down[i + 1].data(),
                     down_source[i].data(), n, source.count);
    batch::add_blend(w.near.data(), source.up[i + 1].data(), w.far.data(), source.up[i].data(),
                     up_source[i].data(), n, source.count);
  }
}

void StreamLight::set_tangent_sources(const StreamSources& diffuse) {
  for (int i = 0; i + 1 < levels(); ++i) {
    down_source[i] = layer_tangent(i, true, diffuse, true);
    up_source[i] = layer_tangent(i, false, diffuse, true);
  }
}

// docs/theory (6.2) and (6.3).
Batch StreamLight::layer_tangent(int layer, bool looks_up, const StreamSources& diffuse,
                                 bool near) const {
  const LayerMedium::Layer& w = medium_->layers[layer];
  const std::array<int, 2> level =
      looks_up ? std::array{layer, layer + 1} : std::array{layer + 1, layer};  // near, far
  const BeamWeights& b = looks_up ? w.down : w.up;
  const auto of = [&](const StreamColumns& c, int i) {
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
    for (std::size_t s = 0; s < scatterers_.size(); ++s) {
      tangent.scatterer[s] = {scatterer(s).share[at_level].data(),
                              scatterer(s).share_tangent[at_level].data(),
                              of(diffuse.scatterer[s], i), of(beam_.scatterer[s], i)};
    }
    return tangent;
  };
  Batch out(rays(layer) * suns() * p_count * kBatchWidth);
  const batch::LayerTangent in{{end(0), end(1)},
                               scatterers_.size(),
                               w.t.data(),
                               of(values, 1),
                               w.depth_tangent.data(),
                               medium_->sun_depth_tangent[level[0]].data(),
                               medium_->sun_depth_tangent[level[1]].data()};
  batch::layer_tangent(in, out.data(), rays(layer), suns(), p_count);
  for (std::size_t q = 0; q < diffuse.phase.size(); ++q) {
    const LayerMedium::PhaseTangent& phase = medium_->phase_tangents[q];
    const auto phase_end = [&](int i) {
      const auto at_level = static_cast<std::size_t>(level[i]);
      return batch::PhaseTangent{medium_->scatterers[phase.scatterer].share[at_level].data(),
                                 in.end[i].weight, of(diffuse.phase[q], i), in.end[i].beam,
                                 of(beam_.phase[q], i)};
    };
    const batch::PhaseTangent ends[2] = {phase_end(0), phase_end(1)};
    batch::add_phase_tangent(ends, out.data(), rays(layer), suns(), p_count, phase.parameter);
  }
  return out;
}

}  // namespace skyfit
