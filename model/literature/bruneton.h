// SPDX-License-Identifier: Apache-2.0
// `bruneton`: Bruneton & Neyret 2008, "Precomputed Atmospheric Scattering", with the mappings of
// Bruneton 2017. The three faults that Sperlhofer 2011, section 5.1, repairs do not appear, by
// other cures: optical depths in the place of transmittances (no noise near the eye; he evaluates
// transmittances in closed form), rays to ground and sky in halves of the table (no seam at the
// horizon; he takes two samples beside it), single Mie scattering of every wavelength (none after
// sunset that is not there; he fades it).
// Five orders of scattering (his four are single scattering and three iterations) and of reflection
// by a Lambertian ground; ozone as in Bruneton 2017.
// Deviations: quadrature (table_rays.h); azimuths of incoming light by sixteen cosines, 16 x 32
// directions as published; sums over directions are scaled to keep the energy of a forward peak.
// What is left out: orders beyond the fifth, refraction; suns below 102 deg (at the ray's
// beginning) fade by e per degree. What the tables cost is about a second per wavelength on one
// core, seven derivatives three seconds.
#pragma once

#include "model/literature/bruneton_tables.h"
#include "model/literature/tabulated_model.h"

namespace skyfit {

struct BrunetonMethod {
  static constexpr std::string_view kName = "bruneton";
  static constexpr SkyRayMapping kSkyRays = SkyRayMapping::kBruneton;
  static constexpr int kBatch = literature::kTablesAtOnce;
  using Geometry = literature::BrunetonGeometry;
  template <int N>
  using Tables = literature::BrunetonTables<N>;
  template <class T>
  static Atmosphere<T> see(const Atmosphere<T>& atmosphere) {
    return atmosphere;
  }
  static bool can_fit(const Parameter&) { return true; }
};
using BrunetonModel = literature::TabulatedModel<BrunetonMethod>;

}  // namespace skyfit
