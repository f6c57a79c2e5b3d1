// SPDX-License-Identifier: Apache-2.0
// Tables for rays that miss the ground and are seen whole: finer than those of all rays
// (model/tables/tables.h), or a model's own, so that a sky read from them is what the model says.
// Four wavelengths in RGBA, values per unit solar irradiance.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace skyfit {

// width varies fastest; depth = 1 for 2D.
struct Table {
  int width = 0, height = 0, depth = 0;
  std::vector<float> rgba;
};

// How the tables are read; render/shaders/sky_rays.glsl knows the same.
enum class SkyRayMapping {
  // Rays that enter at the top of the atmosphere, of an eye outside; what the tables hold and their
  // mappings are those of AtmosphereTables, x: mu_s, y: azimuth, z: mu.
  kFromOutside,
  // A model's own, for every eye: amplitudes without phase functions.
  // x: nu * mu_s (mu_s fastest), y: mu, of rays to the sky, or by BrunetonInScatter::kInHalfFloats
  // of all rays, those to the ground first, z: r; model/shared/bruneton_mapping.glsl.
  kBruneton,
  kBodare,       // x: sun, y: view, z: height; model/shared/bodare_mapping.glsl; `gathered`
  kSchafhitzel,  // the same, height and angles spaced evenly; all views
  kONeil,        // no tables: sums in the shader, of all rays
  // Sums in the shader with tables of their own; `air`: transmittance, x: mu, y: r; `aerosol`:
  // multiple scattering, 1/sr, x: mu_s, y: height; model/literature/hillaire_tables.h.
  kHillaire,
  // No tables: closed forms in the shader, of rays to the sky and of those to the ground.
  kNielsen,
  kHoffmanPreetham,
  kPreetham,
  kHosekWilkie,  // `air`: its curves, of X, Y and Z, x: numbers of the shape, y: control points
};
// A sky over the turbidity, and paths by the exponential densities of the preset.
constexpr bool is_formula(SkyRayMapping mapping) {
  return mapping == SkyRayMapping::kPreetham || mapping == SkyRayMapping::kHosekWilkie;
}
constexpr bool is_closed_form(SkyRayMapping mapping) {
  return mapping == SkyRayMapping::kNielsen || mapping == SkyRayMapping::kHoffmanPreetham ||
         is_formula(mapping);
}

// What kNielsen leaves open, see model/literature/nielsen.h.
enum class NielsenMean { kOfDensities, kOfHeights };
enum class NielsenAirPhase { kPublished, kRayleigh };
enum class NielsenSun { kPublished, kThroughTheSky };
struct NielsenChoices {
  NielsenMean mean = NielsenMean::kOfDensities;
  NielsenAirPhase phase = NielsenAirPhase::kPublished;
  NielsenSun sun = NielsenSun::kPublished;
};

// What kBruneton looks up, see model/literature/bruneton.h.
enum class BrunetonTransmittance { kOfOpticalDepths, kInHalfFloats };
enum class BrunetonInScatter { kExact, kInHalfFloats };
enum class BrunetonMie { kKept, kFromRayleigh };
struct BrunetonChoices {
  BrunetonTransmittance transmittance = BrunetonTransmittance::kOfOpticalDepths;
  BrunetonInScatter in_scatter = BrunetonInScatter::kExact;
  BrunetonMie mie = BrunetonMie::kKept;
};

// What kONeil sums, see model/literature/oneil.h.
enum class ONeilAirPhase { kRayleigh, kIsotropic };
enum class ONeilShadow { kOfThePlanet, kNone };
enum class ONeilDepths { kExact, kPolynomial };
struct ONeilChoices {
  int samples = 5;
  ONeilAirPhase phase = ONeilAirPhase::kRayleigh;
  ONeilShadow shadow = ONeilShadow::kOfThePlanet;
  ONeilDepths depths = ONeilDepths::kExact;
};

// What kPreetham and kHosekWilkie need of the preset and of the colour rule, see
// model/literature/turbidity_sky.h.
struct FormulaSky {
  double turbidity = 0;
  // [node]: per cd/m^2 of X, Y and Z.
  std::array<std::array<double, 3>, 4> radiance_from_xyz = {};
};

// The observers whom a model without twilight and space knows: those below a height, by day.
struct DaylightLimits {
  std::string model;
  double highest_m = 0;
};

struct SkyRayTables {
  SkyRayMapping mapping = SkyRayMapping::kFromOutside;
  Table air, aerosol;  // by which of them light was scattered last
  NielsenChoices nielsen = {};
  ONeilChoices oneil = {};
  FormulaSky formula = {};
  std::optional<DaylightLimits> limits = {};
  Table gathered = {};  // kBodare: all light but the sun's that falls on a place, x: sun, y: height
  BrunetonChoices bruneton = {};
};

}  // namespace skyfit
