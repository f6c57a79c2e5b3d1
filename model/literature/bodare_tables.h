// SPDX-License-Identifier: Apache-2.0
// The tables of Bodare & Sandberg 2014 at one wavelength, with derivatives: in-scatter 32 x 128 x
// 32 (height, view, sun) of air and of aerosol without their phase functions, gathering 32 x 32
// (height, sun), all orders summed; mappings in model/shared/bodare_mapping.glsl. Values per unit
// solar irradiance.
//   R1 = beta_R integral rho_R T(sun) T ds, M1 likewise, view and sun in one plane;
//   G_k(h, s) = integral over the sphere of (F_R R_{k-1} + F_M M_{k-1}) sin(theta) dtheta dphi;
//   R_k = beta_R integral rho_R G_k T ds, M_k likewise;
//   G = sum_k G_k, with which a path to a surface is summed step by step (his 6.4.2);
//   L = F_R(nu) sum_k R_k + F_M(nu) sum_k M_k,
// F_M the aerosol's phase function and F_R that of Elek 2009, (8/10) (7/5 + nu / 2) / (4 pi), which
// integrates to 1.12 as published. (Algorithm 3 as printed has no sine and runs theta over 2 pi.)
// A table is filled step by step, so that a renderer can spread the work over frames.
#pragma once

#include <vector>

#include "model/literature/evaluate.h"
#include "model/literature/grid.h"
#include "model/literature/sun_columns.h"
#include "model/literature/table_rays.h"

namespace skyfit::literature {

struct BodareSizes {
  static constexpr int height = 32, view = 128, sun = 32;  // the second half of the views: the sky
};

class BodareGeometry {
 public:
  explicit BodareGeometry(const Atmosphere<double>& atmosphere);

  // A node of a ray and the cosines of the sun there, for every sun of the tables.
  struct Node {
    RayNode at;
    std::vector<double> mu_s;
  };
  using Ray = std::vector<Node>;

  const Shells& shells() const { return shells_; }
  const Ray& ray(int height, int view) const {
    return rays_[static_cast<std::size_t>(height * BodareSizes::view + view)];
  }
  double height(int texel) const;
  Between height_texel(double height) const;
  Between view_texel(double height, double mu, bool ground) const;
  static Between sun_texel(double mu_s);
  static double sun(int texel);

 private:
  Shells shells_;
  std::vector<Ray> rays_;
};

template <int N>
class BodareTables {
 public:
  static constexpr int kOrders = 5;  // of scattering, the single one included

  // Empty tables, to be filled step by step. `geometry` is that of the atmosphere, and outlives the
  // tables.
  BodareTables(const BodareGeometry& geometry, const ClearAir<N>& air);
  // Filled ones, whatever the views. Runs on the threads of the task arena.
  BodareTables(const BodareGeometry& geometry, const ClearAir<N>& air, std::span<const View> views);

  // The steps, in their order: slices of heights [first, last) of the single scattering; for every
  // further order one gathering and its slices; at the end the light on the
  // ground.
  void scatter_once(int first, int last);
  void gather();
  void scatter_gathered(int first, int last);
  void add_order();  // after the slices of an order, the first included
  void finish();

  // Of the whole ray.
  RayLight<N> light(const View& view) const;

  struct InScatter {
    Dual<N> air, aerosol;  // without their phase functions
  };
  InScatter in_scatter(double height, double mu, double mu_s, bool ground) const;
  Dual<N> ground_irradiance(double mu_s) const;  // by the sky

  // His equation 19, of finished tables: aerosol in the proportion to air that the tables `red`
  // have (mie_from_rayleigh.h); he forms it in the shader, after the look-up.
  void take_aerosol_from_air(const BodareTables& red);

  // G: all light but the sun's that falls on a place, times the phase functions.
  Dual<N> gathered(double height, double mu_s) const;

  // [height][view][sun], views from the horizon to the zenith; G [height][sun].
  SkyRayTexels sky_rays() const;

  // Of finished tables: all rays, and the light on the ground.
  std::size_t bytes() const;

 private:
  using Table = Grid<N, 3>;  // [height][view][sun]
  void make_mean_phases();
  void light_ground();
  template <class Row, class Light>
  void scatter(int first, int last, const Row& row_of, const Light& light_at);
  Dual<N> azimuth_sum(int sun, int theta, const Dual<N>& air, const Dual<N>& aerosol) const;

  const BodareGeometry& geometry_;
  ClearAir<N> air_;
  SunColumns<N> sun_;
  Table air_order_, aerosol_order_, air_sum_, aerosol_sum_;
  Grid<N, 2> gathered_, gathered_sum_;  // [height][sun], of one order and G
  std::vector<Dual<N>> mean_aerosol_;   // integral of F_M over the azimuth, [sun][theta]
  std::vector<double> mean_air_;        // of F_R
  std::vector<Dual<N>> ground_;         // [sun]
};

extern template class BodareTables<0>;
extern template class BodareTables<kTablesAtOnce>;

}  // namespace skyfit::literature
