// SPDX-License-Identifier: Apache-2.0
// The tables of Bruneton & Neyret 2008 at one wavelength, with derivatives; mappings and sizes of
// Bruneton 2017 (model/shared/bruneton_mapping.glsl): transmittance 256 x 64 (mu, r), irradiance
// 64 x 16 (mu_s, r), in-scatter 32 x 128 x 32 x 8 (r, mu, mu_s, nu). Values per unit solar
// irradiance.
#pragma once

#include <cstdint>
#include <vector>

#include "model/literature/evaluate.h"
#include "model/literature/grid.h"
#include "model/literature/table_rays.h"

namespace skyfit::literature {

struct BrunetonSizes {
  static constexpr int transmittance_mu = 256, transmittance_r = 64;
  static constexpr int irradiance_mu_s = 64, irradiance_r = 16;
  static constexpr int r = 32, mu = 128, mu_s = 32, nu = 8;
};

// Everything that depends on radii and scale heights alone, for all wavelengths and orders.
class BrunetonGeometry {
 public:
  explicit BrunetonGeometry(const Atmosphere<double>& atmosphere);

  struct Node {
    RayNode at;
    Between r, mu;                   // in the tables; mu as texel and part, see BrunetonSizes::mu
    std::vector<std::uint16_t> sun;  // of every texel [mu_s][nu] of the ray, see SlabShape
  };
  // Sun and angle of a texel, the angle as near to it as the two zenith angles allow.
  struct RaySun {
    double mu_s, nu;
  };
  struct Ray {
    double height, mu;
    bool ground;
    std::vector<Node> nodes;
    std::vector<RaySun> suns;  // [mu_s][nu]
  };
  // The cosine of the sun's zenith angle at a node of the ray.
  double sun_along(const Ray& ray, const RayNode& node, const RaySun& sun) const {
    const double r0 = bottom() + ray.height, r = bottom() + node.height;
    return std::clamp((r0 * sun.mu_s + node.s * sun.nu) / r, -1.0, 1.0);
  }
  const Shells& shells() const { return shells_; }
  double bottom() const { return shells_.bottom_radius; }
  double thickness() const { return shells_.top; }
  const Ray& ray(int r, int mu) const {
    return rays_[static_cast<std::size_t>(r * BrunetonSizes::mu + mu)];
  }
  // Where a ray stands on the axis mu: the first half of the texels are rays to the ground.
  Between mu_texel(double height, double mu, bool ground) const;
  Between r_texel(double height, int size) const;
  // Where suns stand on the axis mu_s.
  Between sun_texel(double mu_s) const;
  double sun_of_texel(int mu_s) const { return suns_[static_cast<std::size_t>(mu_s)]; }

 private:
  Shells shells_;
  std::vector<Ray> rays_;
  std::vector<double> suns_;         // cosines of the texels
  std::vector<float> sun_position_;  // on the axis, for cosines spaced evenly
};

template <int N>
class BrunetonTables {
 public:
  static constexpr int kOrders = 5;  // of scattering, the single one included

  // Runs on the threads of the task arena. `geometry` is that of the atmosphere, and outlives the
  // tables; every one is filled, whatever the views. Half floats are rounded to when the tables are
  // finished; derivatives are those of the numbers before.
  BrunetonTables(const BrunetonGeometry& geometry, const ClearAir<N>& air,
                 std::span<const View> views, const BrunetonChoices& choices = {});

  // Single Mie scattering in the proportion that the tables `red` have (mie_from_rayleigh.h);
  // published code forms it after the look-up.
  void take_mie_from_rayleigh(const BrunetonTables& red);

  // Of the whole ray.
  RayLight<N> light(const View& view) const;
  // The same without the ground, and at the coordinates of in_scatter() whatever the choices.
  RayLight<N> scattered(const View& view) const;

  // What the tables hold at a place inside the atmosphere; cosines of view and sun zenith and of
  // the angle between them.
  Dual<N> optical_depth(double height, double mu) const;  // to the top; the ray misses the ground
  struct InScatter {
    Dual<N> rayleigh_like;  // single Rayleigh + all further light / Rayleigh phase function
    Dual<N> single_mie;     // over the aerosol's phase function
  };
  InScatter in_scatter(double height, double mu, double mu_s, double nu, bool ground) const;
  // At the coordinates by radii in single precision, km, as published; they know themselves, or do
  // not, whether the ray meets the ground.
  InScatter in_scatter_by_radii(double height, double mu, double mu_s, double nu) const;
  // Of the path from a height to the ground, as published: the quotient of two look-ups of
  // transmittances to the top in half floats, at most 1.
  Dual<N> half_transmittance_to_ground(const ViewRay& ray) const;
  // On the horizontal, facing up; with derivatives (N > 0) of the ground alone, height 0.
  Dual<N> sky_irradiance(double height, double mu_s) const;

  // [r][mu][nu][mu_s]; of mu as SkyRayMapping::kBruneton says, rays to the sky from the horizon up.
  SkyRayTexels sky_rays() const;

  std::size_t bytes() const;

 private:
  template <int>
  friend class BrunetonSolver;
  void round_to_half();
  InScatter in_scatter_at(const Between& r, const Between& mu, double mu_s, double nu) const;
  Dual<N> half_transmittance(double height, double mu) const;
  RayLight<N> with_phases(const View& view, const InScatter& in) const;

  const BrunetonGeometry& geometry_;
  ClearAir<N> air_;
  BrunetonChoices choices_;
  Grid<N, 2> optical_depth_;               // [r][mu]
  Grid<N, 2> half_transmittance_;          // the same, where it is chosen
  Grid<N, 2> irradiance_;                  // [r][mu_s]
  Grid<N, 4> rayleigh_like_, single_mie_;  // [r][mu][mu_s][nu]
};

extern template class BrunetonTables<0>;
extern template class BrunetonTables<kTablesAtOnce>;

}  // namespace skyfit::literature
