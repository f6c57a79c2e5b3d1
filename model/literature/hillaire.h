// SPDX-License-Identifier: Apache-2.0
// `hillaire`: Hillaire 2020, "A Scalable and Production Ready Sky and Atmosphere Rendering
// Technique" (EGSR), the method of Unreal Engine's SkyAtmosphere: the look-ups of
// hillaire_tables.h, which says its equations. Sizes are those of his published code; 30 steps
// along a view ray are the number that it gives its sky view, before it takes 4 to 14 by the ray's
// length.
// Deviations: wavelength by wavelength in the place of RGB; optical depths of the transmittance's
// texels are exact, in the place of 40 steps; the multiple scattering looks at its steps at 0.3 of
// them, as view rays do (his end there and leave out the last 0.7 of a step); the sun's disc sets
// over its diameter; a look-up of the sky view keeps to its side of the horizon.
// Left out: every direction of what is scattered more than once, polarisation, refraction; the
// ground reflects the sun alone, in frames the sky as well. Rays from outside the atmosphere and to
// the ground are marched. In a frame the sky view and the volume of the air before the ground
// (render/shaders/aerial_volume.glsl in the place of his over the frustum) are filled by the same
// steps; the light before clouds and the irradiance are the renderer's tables of it.
#pragma once

#include "model/literature/hillaire_tables.h"
#include "model/literature/tabulated_model.h"

namespace skyfit {

struct HillaireMethod {
  static constexpr std::string_view kName = "hillaire";
  static constexpr SkyRayMapping kSkyRays = SkyRayMapping::kHillaire;
  static constexpr int kBatch = literature::kTablesAtOnce;
  using Geometry = literature::HillaireGeometry;
  template <int N>
  using Tables = literature::HillaireTables<N>;
  template <class T>
  static Atmosphere<T> see(const Atmosphere<T>& atmosphere) {
    return atmosphere;
  }
  static bool can_fit(const Parameter&) { return true; }
};
using HillaireModel = literature::TabulatedModel<HillaireMethod>;

}  // namespace skyfit
