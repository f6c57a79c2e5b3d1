// SPDX-License-Identifier: Apache-2.0
// What polarisation does to the azimuth modes 0 to 2 of the diffuse field, for one batch. Air
// scatters the moment K = M_2 + P of the light, where M_2 is the second moment of I and P that of Q
// and U (model/solver/rayleigh_stokes.h). Q and U are absorbed and scattered along each stream by
// themselves, so that P is a matrix G, levels x levels, times K, and what P adds to M_2 is a matrix
// R times P; both serve all suns and derivatives:
//   P = G (M_2 + (1 + R) P) + b  (docs/theory, chapter 13),
// M_2 that of the light without polarisation, b the P of light that the sun's beam polarises.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "model/solver/rayleigh_stokes.h"
#include "model/solver/stream_light.h"

namespace skyfit {

class PolarisedModes {
 public:
  static bool any(const LaneModes& modes);  // whether a lane has a mode that air polarises

  // `intensity` is the medium of I, `polarised` that of Q and U.
  PolarisedModes(const Streams& streams, const LayerMedium& intensity, const LayerMedium& polarised,
                 const LaneModes& modes);

  // Numbers of a level are one row of (levels x columns).
  // The second moments of light along the streams.
  Batch second_moments(const StreamColumns& light) const;
  // The source function of I that second moments of Q and U make.
  StreamColumns intensity_source(const Batch& moments, std::size_t columns) const;
  // R, (levels x levels): the second moments of I per unit of intensity_source() at each level.
  void set_response(const Batch& response);

  void set_beam_sources();
  // P for the second moments M_2 of I without polarisation.
  void solve_values(const Batch& unpolarised);
  void set_tangent_sources();
  void solve_tangents(const Batch& unpolarised);
  // One more order of scattering: Q and U from K of the order before, of `second` moments of I;
  // from the beam when there is none.
  void advance(const Batch& second);

  const Batch& moments() const { return moments_; }  // P: (levels x suns)
  const Batch& moment_tangents() const { return moment_tangents_; }
  // Adds to the source functions of I, per unit of each scatterer's share, what P makes of it.
  void add_sources(StreamSources& sources) const;

  void prepare_coupling(const HorizontalCoupling& coupling);
  // `modes_of(mode)` as StreamLight::LightOfMode, for the modes' Q and U.
  struct OfMode {
    const PolarisedModes* modes;
    int first_lane;
  };
  using ModesOf = std::function<OfMode(int mode)>;
  void add_coupling(const HorizontalCoupling& coupling, const ModesOf& modes_of, int width,
                    StreamLight::Kind kind);

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

  std::size_t rays(int level) const { return static_cast<std::size_t>(streams_->count(level)); }
  int levels() const { return streams_->levels(); }
  std::size_t level_count() const { return static_cast<std::size_t>(levels()); }
  Pattern pattern_of(Stokes which) const;
  StreamColumns source(const Pattern& pattern, const Batch& moments, std::size_t columns) const;
  void add_moments(const Pattern& pattern, const StreamColumns& light, Batch& moments) const;
  Batch scaled(const LayerMedium& medium, const Batch& moments, std::size_t columns) const;
  Batch by_second_moment(std::size_t scatterer, const Batch& moments, std::size_t columns) const;
  void set_beam();
  void set_transport();
  StreamColumns sweep(const StreamLight& light, std::size_t columns) const;
  StreamColumns completed(Component& component, const Batch& all, std::size_t columns) const;
  Batch polarised_moments(std::size_t columns) const;
  Batch solve(const Batch& unpolarised, std::size_t columns) const;
  Batch total(const Batch& unpolarised, const Batch& moments, std::size_t columns) const;
  StreamSources sources(const Pattern& pattern, const Batch& moments) const;

  const Streams* streams_;
  const LayerMedium *intensity_, *polarised_;
  LaneModes modes_;
  std::vector<std::size_t> air_;  // the scatterers that polarise
  Pattern intensity_pattern_;
  std::vector<Component> components_;     // Q and U
  Batch transport_, response_, inverse_;  // G, R and (1 - G (1 + R))^-1
  Batch moments_, moment_tangents_;       // P
  Batch all_, all_tangents_;              // K
};

}  // namespace skyfit
