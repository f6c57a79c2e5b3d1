// SPDX-License-Identifier: Apache-2.0
// Azimuth modes of the diffuse field, eight at a time (of any modes and wavelengths), solved
// directly: no orders of scattering, no iteration. Unknown are the radiances D (seen when looking
// up) and U (down) of the rays of a streams at the levels, linked by the layers
// (model/solver/stream_light.h) and by J = sum_l Lambda_l omega_l M_l, M the moments of D and U;
// the source that the sun's beam makes is integrated with the beam's own exponential
// (model/solver/layer_medium.h). What lies
// below a level answers light with U_i = R_i D_i + s_i; R is carried upward (adding of layers, van
// de Hulst 1980, in the form of a block elimination), and every column of sources - the suns, and
// the derivatives by every parameter - then costs two sweeps of small matrix products. Polarisation
// adds a source to the modes 0 to 2 (model/solver/polarised_modes.h).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/solver/polarised_modes.h"
#include "model/solver/stream_light.h"

namespace skyfit {

// Normalised Legendre functions Lambda_lm of one mode.
struct ModeBasis {
  std::vector<double> at_rays;  // [level][ray][l - m]
  std::vector<double> at_suns;  // [sun][l - m]
};

class FourierModes {
 public:
  // `polarised` is the medium of Q and U; null leaves polarisation out.
  FourierModes(const Streams& streams, const LayerMedium& medium, const LayerMedium* polarised,
               const std::vector<ModeBasis>& bases, const LaneModes& modes);

  // As if the sky were the same everywhere: the sun turns with the zenith.
  void solve();
  // One step of an iteration that takes the light of neighbouring places under their own sun: first
  // every pack of the same medium prepares, then each couples to all of them. `packs` hold
  // `at_once` modes each, ascending, in lanes of `width` wavelengths.
  void prepare_coupling(const HorizontalCoupling& coupling, double share);
  void couple(const HorizontalCoupling& coupling,
              const std::vector<std::optional<FourierModes>>& packs, int at_once, int width);
  // One more order of scattering or reflection, values only: what advance() was called k times for
  // is the field of light that met air or ground k times. Not to be mixed with solve().
  void advance();

  // Of the diffuse field: appends the moments of a lane's mode at a level, [l - m][sun][slice],
  // slice 0 the value, 1 + p derivatives; after them, of a polarised field in the modes 0 to 2, the
  // second moment of Q and U, and with matrices b_l and c_l, see FieldShape.
  void append_moments(int lane, int level, LargeArray& out) const;
  void append_ground_irradiance(int lane, LargeArray& out) const;  // [sun][slice], mode 0

 private:
  static constexpr std::size_t kBatchWidth = batch::kBatchWidth;

  std::size_t rays(int level) const { return static_cast<std::size_t>(streams_->count(level)); }
  int levels() const { return streams_->levels(); }
  std::size_t suns() const { return medium_->suns; }

  void set_basis(const std::vector<ModeBasis>& bases);
  void scattering(int level, Batch& same, Batch& other) const;
  void eliminate();
  void eliminate_layer(int layer, const Batch& same, const Batch& other, const Batch& same_above,
                       const Batch& other_above);
  StreamColumns at_rays(const LevelMoments& moments, std::size_t columns) const;
  LevelMoments scattered(const LevelMoments& moments, std::size_t columns) const;
  StreamColumns sources_by(const Parities& chi, const LevelMoments& moments) const;
  StreamSources sources_of(const LevelMoments& moments) const;
  StreamSources diffuse_sources() const;
  void set_beam();
  StreamColumns substitute(const Batch& ground, std::size_t columns) const;
  LevelMoments analyse(const StreamColumns& columns) const;
  Batch irradiance(const Batch& down, std::size_t columns) const;
  Batch at_every_ground_ray(const Batch& radiance) const;
  Batch reflected(Batch irradiance) const;
  Batch beam_on_ground() const;
  void set_beam_sources();
  void set_tangent_sources();
  void set_polarised_response();
  void solve_values();
  void solve_tangents();
  StreamColumns source_of_polarised(StreamLight::Kind kind, std::size_t columns) const;
  void solve_light(StreamLight::Kind kind, const Batch& ground, std::size_t columns);

  const Streams* streams_;
  const LayerMedium* medium_;
  LaneModes modes_;
  std::array<std::size_t, 2> rows_{};
  LevelMoments synthesis_, analysis_, omega_;
  std::vector<Parities> chi_;          // per scatterer: [l]
  std::vector<Parities> chi_tangent_;  // per phase tangent
  Parities sun_basis_;                 // [l][sun]
  Batch albedo_, albedo_tangent_;      // over pi; 0 in modes above 0
  std::vector<Batch> reflection_, forward_, backward_;
  StreamLight light_;
  std::optional<PolarisedModes> polarised_;
  LevelMoments moments_, moment_tangents_;  // diffuse
  Batch ground_, ground_tangent_;           // diffuse irradiance
};

}  // namespace skyfit
