// SPDX-License-Identifier: Apache-2.0
// Azimuth modes of the diffuse field, eight at a time (of any modes and wavelengths), solved
// directly: no orders of scattering, no iteration. Unknown are the radiances D (seen when looking
// up) and U (down) of the rays of a streams at the levels. Within a layer the source of diffuse
// light is linear in optical depth along each ray,
//   D_i = t D_{i+1} + near J_i + far J_{i+1} + beam,   U_{i+1} = t U_i + near J_{i+1} + far J_i +
//   beam,
// with J = sum_l Lambda_l omega_l M_l, M the moments of D and U; the source that the sun's beam
// makes is integrated with the beam's own exponential (model/solver/layer_medium.h). What lies
// below a level answers light with U_i = R_i D_i + s_i; R is carried upward (adding of layers, van
// de Hulst 1980, in the form of a block elimination), and every column of sources - the suns, and
// the derivatives by every parameter - then costs two sweeps of small matrix products.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/solver/layer_medium.h"
#include "model/solver/sun_grid.h"

namespace skyfit {

// Normalised Legendre functions Lambda_lm of one mode.
struct ModeBasis {
  std::vector<double> at_rays;  // [level][ray][l - m]
  std::vector<double> at_suns;  // [sun][l - m]
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
};

class FourierModes {
 public:
  // The mode of each lane; its wavelength is that of the medium's lane.
  using Modes = std::array<int, batch::kBatchWidth>;
  FourierModes(const Streams& streams, const LayerMedium& medium,
               const std::vector<ModeBasis>& bases, const Modes& modes);

  // As if the sky were the same everywhere: the sun turns with the zenith.
  void solve();
  // One step of an iteration that takes the light of neighbouring places under their own sun: first
  // every pack of the same medium prepares, then each couples to all of them. `packs` hold
  // `at_once` modes each, ascending, in lanes of `width` wavelengths.
  void prepare_coupling(const HorizontalCoupling& coupling);
  void couple(const HorizontalCoupling& coupling,
              const std::vector<std::optional<FourierModes>>& packs, int at_once, int width);
  // One more order of scattering or reflection, values only: what advance() was called k times for
  // is the field of light that met air or ground k times. Not to be mixed with solve().
  void advance();

  // Of the diffuse field: appends the moments of a lane's mode at a level, [l - m][sun][slice],
  // slice 0 the value, 1 + p derivatives.
  void append_moments(int lane, int level, LargeArray& out) const;
  void append_ground_irradiance(int lane, LargeArray& out) const;  // [sun][slice], mode 0

 private:
  static constexpr std::size_t kBatchWidth = batch::kBatchWidth;

  // The fields that a set of columns of sources leaves behind, per level.
  struct Columns {
    std::size_t count = 0;
    std::vector<Batch> down, up;  // (rays x count)
  };
  using Parities = std::array<Batch, 2>;  // by parity of l - m

  std::size_t rays(int level) const { return static_cast<std::size_t>(streams_->count(level)); }
  int levels() const { return streams_->levels(); }
  std::size_t suns() const { return medium_->suns; }

  void set_basis(const std::vector<ModeBasis>& bases);
  void scattering(int level, Batch& same, Batch& other) const;
  void eliminate();
  void eliminate_layer(int layer, const Batch& same, const Batch& other, const Batch& same_above,
                       const Batch& other_above);
  // The sources of light with given moments, per unit of each scatterer's share, and the same by
  // the medium's phase tangents.
  struct Sources {
    std::vector<Columns> scatterer, phase;
  };
  Columns at_rays(const std::vector<Parities>& moments, std::size_t columns) const;
  std::vector<Parities> scattered(const std::vector<Parities>& moments) const;
  Columns sources_by(const Parities& chi, const std::vector<Parities>& moments) const;
  Sources sources_of(const std::vector<Parities>& moments) const;
  Columns source_function(const Sources& sources) const;
  void beam_sources();
  void add_diffuse_sources(const Columns& source, std::size_t columns);
  Columns substitute(const Batch& ground, std::size_t columns) const;
  std::vector<Parities> analyse(const Columns& columns) const;
  Batch irradiance(const Batch& down, std::size_t columns) const;
  Batch at_every_ground_ray(const Batch& radiance) const;
  Batch reflected(Batch irradiance) const;
  Batch beam_on_ground() const;
  void set_tangent_sources();
  void solve_values();
  void solve_tangents();
  // Of the light that leaves a layer along the rays that look up, or down; `near` false leaves out
  // the sources at the near end.
  Batch layer_tangent(int layer, bool looks_up, const Sources& diffuse, bool near) const;
  void set_neighbour(const HorizontalCoupling& coupling, int layer, const Batch& from_afar,
                     std::size_t parameters, Batch& to_next, Batch& to_previous) const;
  void add_coupling(const HorizontalCoupling& coupling,
                    const std::vector<std::optional<FourierModes>>& packs, int at_once, int width,
                    std::size_t columns, std::size_t kind);

  const Streams* streams_;
  const LayerMedium* medium_;
  Modes modes_;
  std::array<std::size_t, 2> rows_{};
  std::vector<Parities> synthesis_, analysis_, omega_;  // per level
  std::vector<Parities> chi_;                           // per scatterer: [l]
  std::vector<Parities> chi_tangent_;                   // per phase tangent
  Parities sun_basis_;                                  // [l][sun]
  Batch albedo_, albedo_tangent_;                       // over pi; 0 in modes above 0
  std::vector<Batch> reflection_, forward_, backward_;
  std::vector<Batch> down_source_, up_source_;  // per layer
  Sources beam_;                                // at the rays, per unit of the sun's beam
  Columns beam_source_;                         // its source function
  Columns values_, tangents_;
  // What the light that enters each layer from its far end becomes at the near end, derived by the
  // sun's place as the next and as the previous mode need it: [values, tangents][down, up][layer].
  std::array<std::array<std::vector<Batch>, 2>, 2> to_next_, to_previous_;
  std::vector<Parities> moments_, moment_tangents_;  // diffuse, per level
  Batch ground_, ground_tangent_;                    // diffuse irradiance
};

}  // namespace skyfit
