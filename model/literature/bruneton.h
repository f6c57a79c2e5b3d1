// SPDX-License-Identifier: Apache-2.0
// `bruneton`: Bruneton & Neyret 2008, "Precomputed Atmospheric Scattering", with the mappings of
// Bruneton 2017. The three faults that Sperlhofer 2011, section 5.1, repairs do not appear, by
// other cures: optical depths in the place of transmittances (no noise near the eye; he evaluates
// transmittances in closed form); floats, and coordinates from heights above the ground in the
// place of radii (no seam at the horizon; he takes two samples beside it); single Mie scattering of
// every wavelength (none after sunset that is not there; he fades it).
// Choices (BrunetonChoices), each without one of the cures, as published before his repairs:
// ":half-transmittance", the transmittance of a path as the quotient of two look-ups in half
// floats; ":half-inscatter", in-scatter in half floats, looked up by radii in single precision,
// which finds the ground, or not, by itself, and before surfaces the difference of two such
// look-ups; ":mie-from-rayleigh", single Mie scattering by the proportion rule. What the choices
// leave as it is: tables are made in full precision and rounded when they are finished. In frames
// the sky's light on the ground and the light before clouds are read at exact coordinates; by the
// first two choices no path is taken from render/shaders/aerial_volume.glsl; the table of
// transmittances, from which the sun's light is read too, as by him, has the renderer's sizes and
// mapping (model/tables/tables.h). The proportion is formed texel by texel at 680 nm, where his
// shader forms it after the look-up; his wavelengths are not stated.
// Five orders of scattering (his four are single scattering and three iterations) and of reflection
// by a Lambertian ground; ozone as in Bruneton 2017.
// Deviations: quadrature (table_rays.h); azimuths of incoming light by sixteen cosines, 16 x 32
// directions as published; sums over directions are scaled to keep the energy of a forward peak.
// What is left out: orders beyond the fifth, refraction; suns below 102 deg (at the ray's
// beginning) fade by e per degree. What the tables cost is about a second per wavelength on one
// core, seven derivatives three seconds.
#pragma once

#include <string>

#include "model/literature/bruneton_tables.h"
#include "model/literature/tabulated_model.h"

namespace skyfit {

struct BrunetonMethod {
  static constexpr std::string_view kName = "bruneton";
  // What stands behind "bruneton:".
  static constexpr std::string_view kHalfTransmittance = "half-transmittance",
                                    kHalfInScatter = "half-inscatter",
                                    kMieFromRayleigh = "mie-from-rayleigh";
  static constexpr double kRedNm = 680;
  static constexpr SkyRayMapping kSkyRays = SkyRayMapping::kBruneton;
  static constexpr int kBatch = literature::kTablesAtOnce;
  using Geometry = literature::BrunetonGeometry;
  template <int N>
  using Tables = literature::BrunetonTables<N>;

  // `red_node`: at kRedNm.
  BrunetonMethod(const BrunetonChoices& with, const WavelengthNode& red_node);

  template <class T>
  static Atmosphere<T> see(const Atmosphere<T>& atmosphere) {
    return atmosphere;
  }
  static bool can_fit(const Parameter&) { return true; }
  void mark(SkyRayTables& tables) const { tables.bruneton = choices; }
  template <int N>
  Tables<N> tables(const Geometry& geometry, const Atmosphere<Dual<N>>& air,
                   const WavelengthNode& node, std::span<const View> views) const {
    const auto at = [&](const WavelengthNode& where) {
      return Tables<N>(geometry, literature::clear_air(geometry.shells(), air, where), views,
                       choices);
    };
    Tables<N> made = at(node);
    if (choices.mie == BrunetonMie::kFromRayleigh) made.take_mie_from_rayleigh(at(red));
    return made;
  }

  BrunetonChoices choices;
  WavelengthNode red;
  std::string name;
};
using BrunetonModel = literature::TabulatedModel<BrunetonMethod>;

// Of names of variants; others are not looked for.
BrunetonChoices bruneton_choices(std::span<const std::string_view> names);

}  // namespace skyfit
