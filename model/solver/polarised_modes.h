// SPDX-License-Identifier: Apache-2.0
// What polarisation does to the azimuth modes of the diffuse field, for one batch. In the modes 0
// to 2, air scatters the moment K = M_2 + P of the light, where M_2 is the second moment of I and P
// that of Q and U (model/solver/rayleigh_stokes.h). Q and U are absorbed and scattered along each
// stream by themselves, so that P is a matrix G, levels x levels, times K, and what P adds to M_2
// is a matrix R times P; both serve all suns and derivatives:
//   P = G (M_2 + (1 + R) P) + b  (docs/theory, chapter 13),
// M_2 that of the light without polarisation, b the P of light that the sun's beam polarises.
// Scattering matrices of particles, where the media have them, make sources of I, Q and U from the
// moments of all three in every mode (model/solver/particle_matrices.h); these are found by
// iteration.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "model/solver/particle_matrices.h"
#include "model/solver/rayleigh_stokes.h"
#include "model/solver/stream_light.h"

namespace skyfit {

class PolarisedModes {
 public:
  using Kind = StreamLight::Kind;

  // Whether a lane has a mode that is polarised in the light of a medium.
  static bool any(const LaneModes& modes, const LayerMedium& medium);

  // `intensity` is the medium of I, `polarised` that of Q and U.
  PolarisedModes(const Streams& streams, const LayerMedium& intensity, const LayerMedium& polarised,
                 const LaneModes& modes);

  bool has_matrices() const { return particles_.has_value(); }
  bool has_air() const { return !air_.empty(); }  // which polarises light of these modes

  // Numbers of a level are one row of (levels x columns).
  // The second moments of light along the streams.
  Batch second_moments(const StreamColumns& light) const;
  // The source function of I that second moments of Q and U make.
  StreamColumns intensity_source(const Batch& moments, std::size_t columns) const;
  // R, (levels x levels): the second moments of I per unit of intensity_source() at each level.
  void set_response(const Batch& response);

  // `beam` has the moments of the sun's beam.
  void set_beam(const LevelMoments& beam);
  void set_beam_sources();
  // `intensity` has the moments of I.
  void set_tangent_sources(const LevelMoments& intensity);
  // P, of values or of derivatives, from the sources that the layers have now and from I. With
  // matrices also the light of Q and U, in steps that begin_steps() comes before: the particles
  // scatter `light` and Q and U of the step before. `polarised` says whether the light of I holds
  // already what P of the step before does to it. `intensity` has the moments of I. Returns how
  // much the moments of Q and U have changed as a share of the largest of I.
  void begin_steps(Kind kind);
  double solve(Kind kind, const StreamColumns& light, const LevelMoments& intensity,
               bool polarised);
  // One more order of scattering: Q and U from the light of the order before, I in `light` and as
  // moments; from the beam when there is none.
  void advance(const StreamColumns& light, const LevelMoments& intensity);

  const Batch& moments(Kind kind) const { return state_[kind].moments; }  // P: (levels x columns)
  // Of Q and U; with matrices.
  const SpinMoments& spin_moments(Kind kind) const { return state_[kind].spin; }
  const ParticleMatrices& particles() const { return *particles_; }  // with matrices
  // Adds to the source functions of I, per unit of each scatterer's share, what air makes of P.
  void add_sources(StreamSources& sources) const;

  void prepare_coupling(const HorizontalCoupling& coupling, double share,
                        const LevelMoments& intensity, const LevelMoments& intensity_tangents);
  // `modes_of(mode)` as StreamLight::LightOfMode, for the modes' Q and U.
  struct OfMode {
    const PolarisedModes* modes;
    int first_lane;
  };
  using ModesOf = std::function<OfMode(int mode)>;
  void add_coupling(const HorizontalCoupling& coupling, const ModesOf& modes_of, int width,
                    Kind kind);

 private:
  static constexpr std::size_t kBatchWidth = batch::kBatchWidth;
  // One of the functions of StokesFunctions at the streams, and the weights of its integral; of
  // rays that look up and down.
  struct Pattern {
    std::vector<Batch> down, up;                // per level: (rays x 1)
    std::vector<Batch> down_weight, up_weight;  // per level: (1 x rays)
  };
  struct Component {
    Pattern pattern;
    StreamLight light;
  };
  struct State {
    Batch moments, all;  // P and K
    SpinMoments spin;
    std::array<std::vector<Batch>, 2> down_source, up_source;  // of Q and U before the first step
  };

  std::size_t rays(int level) const { return static_cast<std::size_t>(streams_->count(level)); }
  int levels() const { return streams_->levels(); }
  std::size_t level_count() const { return static_cast<std::size_t>(levels()); }
  std::size_t columns(Kind kind) const {
    return polarised_->suns * (kind == Kind::kValues ? 1 : polarised_->parameters);
  }
  Pattern pattern_of(Stokes which) const;
  StreamColumns source(const Pattern& pattern, const Batch& moments, std::size_t columns) const;
  void add_moments(const Pattern& pattern, const StreamColumns& light, Batch& moments) const;
  Batch scaled(const LayerMedium& medium, const Batch& moments, std::size_t columns) const;
  Batch by_second_moment(std::size_t scatterer, const Batch& moments, std::size_t columns) const;
  void set_transport();
  StreamColumns sweep(const StreamLight& light, std::size_t columns) const;
  void complete(Kind kind);
  void add_air_sources(const Batch& moments, std::size_t columns);
  void add_particle_sources(const LevelMoments& intensity, const SpinMoments& spin,
                            std::size_t columns);
  Batch polarised_moments(std::size_t columns) const;
  void solve_air(Kind kind, const StreamColumns& light, bool polarised);
  Batch solve(const Batch& unpolarised, std::size_t columns) const;
  Batch total(const Batch& unpolarised, const Batch& moments, std::size_t columns) const;
  // Of Q and U per unit of each scatterer's share.
  std::array<StreamSources, 2> sources(const Batch& moments, const LevelMoments& intensity,
                                       const SpinMoments& spin) const;

  const Streams* streams_;
  const LayerMedium *intensity_, *polarised_;
  LaneModes modes_;
  std::vector<std::size_t> polarising_, air_;  // scatterers; air has Rayleigh's matrix
  std::optional<ParticleMatrices> particles_;
  Pattern intensity_pattern_;
  std::vector<Component> components_;     // Q and U
  Batch transport_, response_, inverse_;  // G, R and (1 - G (1 + R))^-1
  std::array<State, 2> state_;            // by Kind
};

}  // namespace skyfit
