// SPDX-License-Identifier: Apache-2.0
// One Stokes component of the diffuse light along the streams, eight modes at a time: what the
// layers add to it, how that changes with the parameters, and what neighbouring places under their
// own sun change. Within a layer the source of diffuse light is linear in optical depth along each
// ray,
//   D_i = t D_{i+1} + near J_i + far J_{i+1} + beam,   U_{i+1} = t U_i + near J_{i+1} + far J_i +
//   beam,
// with D the light that is seen when looking up and U when looking down (docs/theory, chapters 5 to
// 7). How J follows from the light itself is the business of FourierModes and PolarisedModes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "model/solver/layer_medium.h"
#include "model/solver/sun_grid.h"

namespace skyfit {

// The mode of each lane; its wavelength is that of the medium's lane.
using LaneModes = std::array<int, batch::kBatchWidth>;

// Light, or a source function, at the levels: (rays x count), of rays that look up and down.
struct StreamColumns {
  std::size_t count = 0;
  std::vector<Batch> down, up;  // per level
};

// Adds light or sources to others of the same shape.
void add(const StreamColumns& more, StreamColumns& to);

// Source functions per unit of each scatterer's share, and the same by the medium's phase tangents.
struct StreamSources {
  std::vector<StreamColumns> scatterer, phase;
};

// How the sun's place changes along a ray, for the coupling of suns and modes: a step by the angle
// psi of the zenith toward the view turns light f into
//   f + psi (-cos(phi) df/dtheta + cot(theta) sin(phi) df/dphi)
// to first order, theta the sun's zenith and phi the azimuth between view and sun.
struct HorizontalCoupling {
  struct Sun {
    double cotangent = 0;  // of theta; 0 at the zenith, where f_m / theta is df_m / dtheta
    bool at_zenith = false;
    SunSlope slope;  // indices into the solved suns
  };
  std::vector<Sun> suns;      // of the solved suns
  std::vector<char> coupled;  // [sun]: whether light from neighbouring places is taken as theirs
  std::vector<double> step;   // [layer][ray]: psi of a layer, radians
  // In twilight, where light falls steeply with the sun, the step is not taken to first
  // order: light under a sun and of a mode is made of that of other suns and modes at the far end,
  // docs/theory (7.7). What it takes of one of them, for cosine and for sine series, and less its
  // own:
  struct Share {
    std::uint8_t sun, from_sun, from_mode;
    float cosine, sine;
  };
  std::vector<char> shifted;  // [sun]: whether it takes these; empty: none does
  std::vector<std::vector<std::vector<Share>>> shares;  // [layer][ray] by [mode], shifted_modes()
  // Whether more than two steps of the iteration are of use: not on a planet whose atmosphere is
  // thick against its radius (Titan), there they diverge.
  bool converges = true;
};

// Modes that a shift couples, of a field with so many moments: light toward the sun is so much
// brighter that it takes more of them than wide phase functions have. The light of a narrow lobe
// rings around the sun where too few are taken: of the dust of Mars under a sun at 93 deg 6 leave a
// factor of 2.6 and places without light, 20 a tenth. By day, in an extended atmosphere, in which
// all suns are coupled, 6 give the same within 1e-5 (Mars, suns to 80 deg).
constexpr int shifted_modes(int moments, bool day_of_extended) {
  constexpr int kWide = 16, kOfWide = 6, kOfNarrow = 20;
  return std::min(moments, moments > kWide && !day_of_extended ? kOfNarrow : kOfWide);
}

class StreamLight {
 public:
  // `scatterers` are those of the medium that give a source.
  StreamLight(const Streams& streams, const LayerMedium& medium,
              std::vector<std::size_t> scatterers, const LaneModes& modes)
      : streams_(&streams), medium_(&medium), scatterers_(std::move(scatterers)), modes_(modes) {}

  enum Kind : std::size_t { kValues, kTangents };

  // The sources that the layers give to the rays that leave them.
  std::vector<Batch> down_source, up_source;  // per layer
  StreamColumns values, tangents;             // the light
  StreamColumns& light(Kind kind) { return kind == kValues ? values : tangents; }

  bool has_beam() const { return beam_source_.count > 0; }
  void set_beam(StreamSources per_unit_beam);  // what the sun's beam makes, per unit of it
  // Sources of the layers: those of the beam; none; those of a source function, added.
  void set_beam_sources();
  void clear_sources(std::size_t columns);
  void add_diffuse_sources(const StreamColumns& source);
  // What depends on the parameters, applied to `values`, is the source of the derivatives.
  void set_tangent_sources(const StreamSources& diffuse);

  // Per unit of extinction.
  StreamColumns source_function(const StreamSources& sources) const;

  // Horizontal coupling: prepare_coupling() derives the light that enters each layer from its far
  // end by the sun's place, blended as `share` of it with what it was the time before;
  // add_coupling() adds it to the layers' sources. `source_tangent` is the source function's
  // derivative, empty without parameters. `light_of` gives the light of a mode and its first lane,
  // or null.
  void prepare_coupling(const HorizontalCoupling& coupling, double share,
                        const StreamSources& diffuse, const StreamColumns& source_tangent);
  struct OfMode {
    const StreamLight* light;
    int first_lane;
  };
  using LightOfMode = std::function<OfMode(int mode)>;
  void add_coupling(const HorizontalCoupling& coupling, const LightOfMode& light_of, int width,
                    Kind kind, bool sines = false);

 private:
  static constexpr std::size_t kBatchWidth = batch::kBatchWidth;
  std::size_t rays(int level) const { return static_cast<std::size_t>(streams_->count(level)); }
  int levels() const { return streams_->levels(); }
  std::size_t suns() const { return medium_->suns; }
  const LayerMedium::Scatterer& scatterer(std::size_t s) const {
    return medium_->scatterers[scatterers_[s]];
  }

  // Of the light that leaves a layer along the rays that look up, or down; `near` false leaves out
  // the sources at the near end.
  Batch layer_tangent(int layer, bool looks_up, const StreamSources& diffuse, bool near) const;
  void add_shares(const HorizontalCoupling& coupling, const LightOfMode& light_of, int width,
                  Kind kind, bool sines);
  void set_neighbour(const HorizontalCoupling& coupling, int layer, const Batch& from_afar,
                     std::size_t parameters, Batch& to_next, Batch& to_previous) const;

  const Streams* streams_;
  const LayerMedium* medium_;
  std::vector<std::size_t> scatterers_;
  LaneModes modes_;
  StreamSources beam_;         // at the rays, per unit of the sun's beam
  StreamColumns beam_source_;  // its source function
  // What the light that enters each layer from its far end becomes at the near end, derived by the
  // sun's place as the next and as the previous mode need it: [kind][down, up][layer].
  std::array<std::array<std::vector<Batch>, 2>, 2> to_next_, to_previous_;
  // That light itself, for the suns that are shifted and for the next repetition.
  std::array<std::array<std::vector<Batch>, 2>, 2> from_afar_;
};

}  // namespace skyfit
