// SPDX-License-Identifier: Apache-2.0
// `schafhitzel`: Schafhitzel, Falk & Ertl 2007, "Real-Time Rendering of Planets with Atmospheres":
// single scattering from the table of schafhitzel_tables.h, on any planet.
// Left out: absorption and ozone, every further scattering, the azimuth between view and sun within
// the table; the ground reflects the sun alone. The source contradicts itself on the angles of its
// table: it fills it by functions of the angle that it does not state and reads it by cosines. Here
// the angles are spaced evenly, which blurs the horizon over 1.4 deg; that is ours, not the
// paper's.
#pragma once

#include "model/literature/schafhitzel_tables.h"
#include "model/literature/tabulated_model.h"

namespace skyfit {

struct SchafhitzelMethod {
  static constexpr std::string_view kName = "schafhitzel";
  static constexpr SkyRayMapping kSkyRays = SkyRayMapping::kSchafhitzel;
  static constexpr int kBatch = literature::kTablesAtOnce;
  using Geometry = literature::SchafhitzelGeometry;
  template <int N>
  using Tables = literature::SchafhitzelTables<N>;
  template <class T>
  static Atmosphere<T> see(const Atmosphere<T>& atmosphere) {
    return literature::without_absorption(atmosphere);
  }
  static bool can_fit(const Parameter& parameter) {
    return literature::can_fit_without_absorption(parameter);
  }
};
using SchafhitzelModel = literature::TabulatedModel<SchafhitzelMethod>;

}  // namespace skyfit
