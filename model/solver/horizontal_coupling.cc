// SPDX-License-Identifier: Apache-2.0
// The coupling of suns and azimuth modes, see HorizontalCoupling in model/solver/stream_light.h.
#include "model/solver/fourier_modes.h"

namespace skyfit {

// docs/theory (7.3).
// P_m = df_m/dtheta - m cot f_m for the mode m + 1, Q_m = df_m/dtheta + m cot f_m for m - 1.
void StreamLight::set_neighbour(const HorizontalCoupling& coupling, int layer,
                                const Batch& from_afar, std::size_t parameters, Batch& to_next,
                                Batch& to_previous) const {
  const std::size_t width = parameters * kBatchWidth;
  to_next.assign(from_afar.size(), 0.0);
  to_previous.assign(from_afar.size(), 0.0);
  for (std::size_t r = 0; r < rays(layer); ++r) {
    for (std::size_t j = 0; j < suns(); ++j) {
      if (!coupling.coupled[j] || (!coupling.shifted.empty() && coupling.shifted[j])) continue;
      const HorizontalCoupling::Sun& sun = coupling.suns[j];
      const double* const here = from_afar.data() + (r * suns() + j) * width;
      double* const next = to_next.data() + (r * suns() + j) * width;
      double* const previous = to_previous.data() + (r * suns() + j) * width;
      for (std::size_t k = 0; k < 5; ++k) {
        const double* from =
            from_afar.data() + (r * suns() + static_cast<std::size_t>(sun.slope.index[k])) * width;
        for (std::size_t e = 0; e < width; ++e) {
          const double weight =
              modes_[e % kBatchWidth] % 2 == 0 ? sun.slope.even[k] : sun.slope.odd[k];
          next[e] += weight * from[e];
        }
      }
      for (std::size_t e = 0; e < width; ++e) {
        const double m = modes_[e % kBatchWidth];
        const double turn = m * (sun.at_zenith ? next[e] : sun.cotangent * here[e]);
        previous[e] = next[e] + turn;
        next[e] -= turn;
      }
    }
  }
}

// docs/theory (7.5) and (7.8).
// The light that enters a layer at its far end, as it is at the near end.
void StreamLight::prepare_coupling(const HorizontalCoupling& coupling, double share,
                                   const StreamSources& diffuse,
                                   const StreamColumns& source_tangent) {
  const std::size_t p_count = medium_->parameters, columns = suns() * p_count;
  const StreamColumns source = source_function(diffuse);
  const auto blend_and_keep = [&](Batch& light, Batch& before) {
    if (!before.empty()) {
      for (std::size_t k = 0; k < light.size(); ++k)
        light[k] = share * light[k] + (1 - share) * before[k];
    }
    before = light;
  };
  for (std::size_t side = 0; side < 2; ++side) {
    const bool looks_up = side == 0;
    for (auto* v : {&to_next_, &to_previous_, &from_afar_}) {
      for (auto& kind : *v) kind[side].resize(medium_->layers.size());
    }
    for (int i = 0; i + 1 < levels(); ++i) {
      const LayerMedium::Layer& w = medium_->layers[i];
      const int far = looks_up ? i + 1 : i;
      const auto of = [&](const StreamColumns& c) {
        return (looks_up ? c.down : c.up)[static_cast<std::size_t>(far)].data();
      };
      Batch x((looks_up ? w.down : w.up).far);
      for (std::size_t k = 0; k < x.size(); ++k) x[k] *= of(beam_source_)[k];
      batch::add_blend(w.t.data(), of(values), w.far.data(), of(source), x.data(), rays(i), suns());
      blend_and_keep(x, from_afar_[kValues][side][i]);
      set_neighbour(coupling, i, x, 1, to_next_[kValues][side][i], to_previous_[kValues][side][i]);
      if (p_count == 0) continue;
      Batch dx = layer_tangent(i, looks_up, diffuse, false);
      batch::add_blend(w.t.data(), of(tangents), w.far.data(), of(source_tangent), dx.data(),
                       rays(i), columns);
      blend_and_keep(dx, from_afar_[kTangents][side][i]);
      set_neighbour(coupling, i, dx, p_count, to_next_[kTangents][side][i],
                    to_previous_[kTangents][side][i]);
    }
  }
}

// docs/theory (7.4).
// Adds -psi / 2 (P_{m-1} + Q_{m+1}), in mode 0 -psi Q_1.
void StreamLight::add_coupling(const HorizontalCoupling& coupling, const LightOfMode& light_of,
                               int width, Kind kind, bool sines) {
  const std::size_t columns = suns() * (kind == kValues ? 1 : medium_->parameters);
  if (!coupling.shifted.empty()) add_shares(coupling, light_of, width, kind, sines);
  for (int lane = 0; lane < static_cast<int>(kBatchWidth); ++lane) {
    const int m = modes_[lane];
    const auto add = [&](int neighbour, double factor, bool next) {
      const OfMode of = light_of(neighbour);
      if (!of.light) return;
      const int from = of.first_lane + lane % width;
      const auto& light = (next ? of.light->to_next_ : of.light->to_previous_)[kind];
      for (std::size_t side = 0; side < 2; ++side) {
        std::vector<Batch>& source = side == 0 ? down_source : up_source;
        for (std::size_t i = 0; i < source.size(); ++i) {
          const std::size_t n = rays(static_cast<int>(i));
          for (std::size_t r = 0; r < n; ++r) {
            const double weight =
                factor * coupling.step[i * static_cast<std::size_t>(streams_->most()) + r];
            const double* x = light[side][i].data() + r * columns * kBatchWidth + from;
            double* y = source[i].data() + r * columns * kBatchWidth + lane;
            for (std::size_t c = 0; c < columns; ++c)
              y[c * kBatchWidth] += weight * x[c * kBatchWidth];
          }
        }
      }
    };
    if (m == 0) {
      add(1, -1, false);
    } else {
      add(m - 1, -0.5, true);
      add(m + 1, -0.5, false);
    }
  }
}

// docs/theory (7.7). The lanes of one mode lie side by side.
void StreamLight::add_shares(const HorizontalCoupling& coupling, const LightOfMode& light_of,
                             int width, Kind kind, bool sines) {
  const std::size_t p_count = kind == kValues ? 1 : medium_->parameters,
                    count = static_cast<std::size_t>(width);
  std::vector<OfMode> of_mode;
  const auto shifted = static_cast<int>(coupling.shares.front().size());
  for (int mode = 0; mode < shifted; ++mode) of_mode.push_back(light_of(mode));
  for (std::size_t lane = 0; lane + count <= kBatchWidth; lane += count) {
    if (modes_[lane] >= shifted) break;
    const auto m = static_cast<std::size_t>(modes_[lane]);
    for (std::size_t side = 0; side < 2; ++side) {
      std::vector<Batch>& source = side == 0 ? down_source : up_source;
      for (std::size_t i = 0; i < source.size(); ++i) {
        for (std::size_t r = 0; r < rays(static_cast<int>(i)); ++r) {
          const auto& of_ray = coupling.shares[i * static_cast<std::size_t>(streams_->most()) + r];
          for (const HorizontalCoupling::Share& share : of_ray[m]) {
            const OfMode& of = of_mode[share.from_mode];
            if (!of.light) continue;
            const double weight = sines ? share.sine : share.cosine;
            const double* x = of.light->from_afar_[kind][side][i].data() +
                              (r * suns() + share.from_sun) * p_count * kBatchWidth +
                              static_cast<std::size_t>(of.first_lane);
            double* y = source[i].data() + (r * suns() + share.sun) * p_count * kBatchWidth + lane;
            for (std::size_t c = 0; c < p_count; ++c, x += kBatchWidth, y += kBatchWidth) {
              for (std::size_t w = 0; w < count; ++w) y[w] += weight * x[w];
            }
          }
        }
      }
    }
  }
}

void PolarisedModes::prepare_coupling(const HorizontalCoupling& coupling, double share,
                                      const LevelMoments& intensity,
                                      const LevelMoments& intensity_tangents) {
  const std::size_t tangents = columns(Kind::kTangents);
  const Kind kind = tangents > 0 ? Kind::kTangents : Kind::kValues;
  if (!has_matrices()) complete(kind);
  std::array<StreamColumns, 2> tangent;
  if (tangents > 0) {
    const State& state = state_[Kind::kTangents];
    if (has_air()) {
      const Batch scattered_by_air = scaled(*polarised_, state.all, tangents);
      for (std::size_t c = 0; c < components_.size(); ++c)
        tangent[c] = source(components_[c].pattern, scattered_by_air, tangents);
    }
    if (has_matrices()) {
      const std::array<StreamColumns, 2> of_particles =
          particles_->scattered(intensity_tangents, state.spin, tangents);
      for (std::size_t c = 0; c < components_.size(); ++c) {
        if (has_air()) {
          add(of_particles[c], tangent[c]);
        } else {
          tangent[c] = of_particles[c];
        }
      }
    }
  }
  const State& state = state_[Kind::kValues];
  const std::array<StreamSources, 2> of = sources(state.all, intensity, state.spin);
  for (std::size_t c = 0; c < components_.size(); ++c)
    components_[c].light.prepare_coupling(coupling, share, of[c], tangent[c]);
}

void PolarisedModes::add_coupling(const HorizontalCoupling& coupling, const ModesOf& modes_of,
                                  int width, Kind kind) {
  for (std::size_t c = 0; c < components_.size(); ++c) {
    const auto light_of = [&](int mode) -> StreamLight::OfMode {
      const OfMode of = modes_of(mode);
      return {of.modes ? &of.modes->components_[c].light : nullptr, of.first_lane};
    };
    components_[c].light.add_coupling(coupling, light_of, width, kind, c == 1);
  }
}

void FourierModes::prepare_coupling(const HorizontalCoupling& coupling, double share) {
  const std::size_t columns = suns() * medium_->parameters;
  StreamColumns tangent;
  if (columns > 0) {
    tangent = at_rays(scattered(moment_tangents_, columns), columns);
    if (polarised_) add(source_of_polarised(StreamLight::kTangents, columns), tangent);
  }
  light_.prepare_coupling(coupling, share, diffuse_sources(), tangent);
  if (polarised_) polarised_->prepare_coupling(coupling, share, moments_, moment_tangents_);
}

void FourierModes::couple(const HorizontalCoupling& coupling,
                          const std::vector<std::optional<FourierModes>>& packs, int at_once,
                          int width) {
  const auto add_coupling = [&](StreamLight::Kind kind) {
    // The pack of a mode and its first lane there; null where there is none: a pack's last lanes
    // may repeat the last mode.
    const auto pack_of = [&](int mode) -> std::pair<const FourierModes*, int> {
      if (mode >= static_cast<int>(packs.size()) * at_once) return {};
      const FourierModes& pack = *packs[mode / at_once];
      const int lane = mode % at_once * width;
      if (pack.modes_[lane] != mode) return {};
      return {&pack, lane};
    };
    const auto light_of = [&](int mode) -> StreamLight::OfMode {
      const auto [pack, lane] = pack_of(mode);
      return {pack ? &pack->light_ : nullptr, lane};
    };
    const auto polarised_of = [&](int mode) -> PolarisedModes::OfMode {
      const auto [pack, lane] = pack_of(mode);
      return {pack && pack->polarised_ ? &*pack->polarised_ : nullptr, lane};
    };
    light_.add_coupling(coupling, light_of, width, kind);
    if (polarised_) polarised_->add_coupling(coupling, polarised_of, width, kind);
  };
  set_beam_sources();
  add_coupling(StreamLight::kValues);
  solve_values();
  if (medium_->parameters == 0) return;
  set_tangent_sources();
  add_coupling(StreamLight::kTangents);
  solve_tangents();
}

}  // namespace skyfit
