// SPDX-License-Identifier: Apache-2.0
// Sources of a Fourier mode from moments of its light, see FourierModes.
#include "model/solver/fourier_modes.h"

namespace skyfit {

// docs/theory (4.9).
// Values at the rays from moments: first those of the rays that look up.
StreamColumns FourierModes::at_rays(const LevelMoments& moments, std::size_t columns) const {
  StreamColumns r{columns, std::vector<Batch>(levels()), std::vector<Batch>(levels())};
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
LevelMoments FourierModes::scattered(const LevelMoments& moments, std::size_t columns) const {
  LevelMoments r(moments.size());
  for (std::size_t i = 0; i < r.size(); ++i) {
    for (std::size_t parity = 0; parity < 2; ++parity) {
      r[i][parity].resize(moments[i][parity].size());
      batch::scale_rows(omega_[i][parity].data(), moments[i][parity].data(), r[i][parity].data(),
                        rows_[parity], columns);
    }
  }
  return r;
}

// Values at the rays of moments times chi.
StreamColumns FourierModes::sources_by(const Parities& chi, const LevelMoments& moments) const {
  LevelMoments q(levels());
  for (int i = 0; i < levels(); ++i) {
    for (std::size_t parity = 0; parity < 2; ++parity) {
      q[i][parity].resize(moments[i][parity].size());
      batch::scale_rows(chi[parity].data(), moments[i][parity].data(), q[i][parity].data(),
                        rows_[parity], suns());
    }
  }
  return at_rays(q, suns());
}

StreamSources FourierModes::sources_of(const LevelMoments& moments) const {
  StreamSources sources;
  for (const Parities& chi : chi_) sources.scatterer.push_back(sources_by(chi, moments));
  for (const Parities& chi : chi_tangent_) sources.phase.push_back(sources_by(chi, moments));
  return sources;
}

// Those of the field, with what polarisation makes of it.
StreamSources FourierModes::diffuse_sources() const {
  StreamSources sources = sources_of(moments_);
  if (!polarised_) return sources;
  polarised_->add_sources(sources);
  if (!polarised_->has_matrices()) return sources;
  const LevelMoments& spin = polarised_->spin_moments(StreamLight::kValues).b;
  const auto add_of = [&](const std::vector<ParticleMatrices::Moments>& matrices,
                          std::vector<StreamColumns>& to) {
    for (std::size_t s = 0; s < matrices.size(); ++s) {
      if (!matrices[s].gamma[0].empty()) add(sources_by(matrices[s].gamma, spin), to[s]);
    }
  };
  add_of(polarised_->particles().scatterers(), sources.scatterer);
  add_of(polarised_->particles().tangents(), sources.phase);
  return sources;
}

}  // namespace skyfit
