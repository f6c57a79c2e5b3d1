// SPDX-License-Identifier: Apache-2.0
// The tables of Schafhitzel, Falk & Ertl 2007 at one wavelength, with derivatives: single
// scattering 128^3 (height, view, sun) of air and aerosol without their phase functions, view and
// sun in one plane; height and both angles spaced evenly (schafhitzel.h says why); phase functions
// 1D over the angle. Values per unit solar irradiance. Optical depths are evaluated in closed form
// in the place of the 2D texture.
#pragma once

#include <vector>

#include "model/literature/evaluate.h"
#include "model/literature/grid.h"
#include "model/literature/sun_columns.h"
#include "model/literature/table_rays.h"

namespace skyfit::literature {

struct SchafhitzelSizes {
  static constexpr int table = 128;   // each of height, view and sun
  static constexpr int phase = 1024;  // angles, 0 .. pi
};

// Nothing of the tables depends on the wavelength but the shells.
class SchafhitzelGeometry {
 public:
  explicit SchafhitzelGeometry(const Atmosphere<double>& atmosphere)
      : shells_(shells_of(atmosphere, Keep::kScatterers)) {}
  const Shells& shells() const { return shells_; }

 private:
  Shells shells_;
};

template <int N>
class SchafhitzelTables {
 public:
  // The texels that the views read; all of them when there are no views. Runs on the threads of the
  // task arena. `geometry` is that of the atmosphere, and outlives the tables.
  SchafhitzelTables(const SchafhitzelGeometry& geometry, const ClearAir<N>& air,
                    std::span<const View> views);

  // Of the whole ray.
  RayLight<N> light(const View& view) const;

  struct InScatter {
    Dual<N> air, aerosol;  // without their phase functions
  };
  InScatter in_scatter(double height, double view_zenith, double sun_zenith) const;

  SkyRayTexels sky_rays() const;  // [height][view][sun]: all views, the horizon is between texels

  std::size_t bytes() const;

 private:
  std::array<Between, 3> place(double height, double view_zenith, double sun_zenith) const;
  std::array<Between, 3> place(const View& view) const;
  void fill_ray(int height, int view, const SunColumns<N>& sun, const std::vector<char>& wanted);

  const SchafhitzelGeometry& geometry_;
  ClearAir<N> air_;
  Grid<N, 3> air_table_, aerosol_table_;  // [height][view][sun]
  Grid<N, 1> air_phase_, aerosol_phase_;  // 1/sr over the angle
};

extern template class SchafhitzelTables<0>;
extern template class SchafhitzelTables<kTablesAtOnce>;

}  // namespace skyfit::literature
