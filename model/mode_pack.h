// SPDX-License-Identifier: Apache-2.0
// Azimuth modes of the diffuse field, eight at a time (of any modes and wavelengths), solved
// directly: no orders of scattering, no iteration. Unknown are the radiances D (seen when looking
// up) and U (down) of the rays of a fan at the levels. Within a layer the source is linear in
// optical depth along each ray,
//   D_i = t D_{i+1} + near J_i + far J_{i+1},   U_{i+1} = t U_i + near J_{i+1} + far J_i,
// with J = sum_l Lambda_l omega_l M_l, M the moments of D, U and the sun's beam. What lies below a
// level answers light with U_i = R_i D_i + s_i; R is carried upward (adding of layers, van de
// Hulst 1980, in the form of a block elimination), and every column of sources - the suns, and the
// derivatives by every parameter - then costs two sweeps of small matrix products.
#pragma once

#include <array>
#include <vector>

#include "model/dual.h"
#include "model/lanes.h"
#include "model/ray_fan.h"

namespace skyfit {

// Weights of a layer for one ray.
template <int N>
struct LayerWeights {
  Dual<N> t, near, far;
};

// What one wavelength brings to all its modes.
template <int N>
struct WaveMedium {
  std::vector<Dual<N>> omega;            // [level][l]: source per extinction of each moment
  std::vector<LayerWeights<N>> layers;   // [layer][ray]
  std::vector<Dual<N>> beam;             // [level][sun]: transmittance of the sun's beam
  Dual<N> ground_albedo;
};

// Normalised Legendre functions Lambda_lm of one mode.
struct ModeBasis {
  std::vector<double> at_rays;  // [level][ray][l - m]
  std::vector<double> at_suns;  // [sun][l - m]
};

struct ModeTask {
  int wave, mode;
};

template <int N>
class ModePack {
 public:
  using Tasks = std::array<ModeTask, lanes::kLanes>;
  struct Inputs {
    const RayFan& fan;
    int moments;                        // Legendre moments l = 0 .. moments - 1
    const std::vector<double>& sun_mu;  // cosines of the local suns
    int parameters;                     // of the derivatives to carry, the first ones of Dual<N>
    const std::vector<WaveMedium<N>>& media;
    const std::vector<ModeBasis>& bases;
  };
  ModePack(const Inputs& inputs, const Tasks& tasks);

  void solve();
  // One more order of scattering or reflection, values only: what advance() was called k times for
  // is the field of light that met air or ground k times. Not to be mixed with solve().
  void advance();

  // Of the diffuse field; l >= the task's mode; slice 0 is the value, 1 + p derivatives.
  double moment(int lane, int level, int l, int sun, int slice) const;
  double ground_irradiance(int lane, int sun, int slice) const;  // of a task with mode 0

 private:
  using Lanes = std::vector<double>;
  static constexpr std::size_t kLanes = lanes::kLanes;

  // The fields that a set of columns of sources leaves behind, per level.
  struct Columns {
    std::size_t count = 0;
    std::vector<Lanes> down, up;  // (rays x count)
  };

  std::size_t rays(int level) const { return static_cast<std::size_t>(in_.fan.count(level)); }
  std::size_t rows(int parity) const { return rows_[static_cast<std::size_t>(parity)]; }
  int levels() const { return in_.fan.levels(); }
  std::size_t suns() const { return in_.sun_mu.size(); }

  // Fills one element per lane from f(task).
  template <class F>
  void pack(double* element, const F& f) const {
    for (std::size_t lane = 0; lane < kLanes; ++lane) element[lane] = f(tasks_[lane]);
  }
  void set_basis();
  void set_layers();
  void set_direct_beam();
  void scattering(int level, Lanes& same, Lanes& other) const;
  void eliminate();
  void eliminate_layer(int layer, const Lanes& same, const Lanes& other, const Lanes& same_above,
                       const Lanes& other_above);
  enum class Light { kBeam, kDiffuse, kAll };
  Lanes light(int level, int parity, Light which) const;
  void to_rays(int level, const std::array<Lanes, 2>& moments, std::size_t columns, Lanes& down,
               Lanes& up) const;
  void sources(Light which, std::vector<Lanes>& down, std::vector<Lanes>& up) const;
  void layer_sources(const std::vector<Lanes>& down, const std::vector<Lanes>& up,
                     std::size_t columns);
  Columns substitute(const Lanes& ground, std::size_t columns) const;
  void analyse(const Columns& columns, std::vector<Lanes>& even, std::vector<Lanes>& odd) const;
  Lanes irradiance(const Lanes& down, std::size_t columns) const;
  Lanes at_every_ground_ray(const Lanes& radiance) const;
  Lanes reflected(Lanes irradiance) const;
  Lanes beam_on_ground() const;
  void solve_values();
  void solve_tangents();

  Inputs in_;
  Tasks tasks_;
  std::array<std::size_t, 2> rows_{};
  // Per level, by parity of l - m.
  std::vector<std::array<Lanes, 2>> synthesis_, analysis_, omega_, omega_tangent_;
  std::array<Lanes, 2> sun_basis_;  // [l][sun]
  struct Layer {
    Lanes t, near, far;                    // [ray]
    Lanes t_tangent, near_tangent, far_tangent;  // [ray][parameter]
  };
  std::vector<Layer> layers_;
  std::vector<Lanes> beam_, beam_tangent_;  // per level: [sun], [sun][parameter]
  Lanes albedo_, albedo_tangent_;           // over pi; 0 in modes above 0
  std::vector<Lanes> reflection_, forward_, backward_;
  std::vector<Lanes> down_source_, up_source_;  // per layer
  Columns values_;
  std::vector<Lanes> even_, odd_, even_tangent_, odd_tangent_;  // diffuse moments per level
  Lanes ground_, ground_tangent_;                               // diffuse irradiance
};

}  // namespace skyfit
