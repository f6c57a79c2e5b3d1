// SPDX-License-Identifier: Apache-2.0
// `bodare`: Bodare & Sandberg 2014, "Efficient and Dynamic Atmospheric Scattering": the tables of
// bodare_tables.h, which says its equations; five orders of scattering, where
// the source, which leaves the number open, times four; ozone. bodare_update.h
// spreads an update of the tables over frames.
// Left out: the azimuth between view and sun within the tables, light that the ground reflects into
// the air, the direction of what is scattered more than once, refraction. Aerosol has a table of
// its own; ":mie-from-rayleigh" forms it from that of air by the proportion of the two at 650 nm,
// his red, as published, at twice the cost here, where wavelengths stand alone. A view down reads
// the tables too, so that both halves are kept here (BodareTables::sky_rays() is what the paper
// keeps). Suns below 101 deg fade by e per degree; best near the sun's vertical plane. In frames
// the light before surfaces is summed along the path with the gathered light, in 16 steps
// (render/shaders/bodare_march.glsl), into the volume of render/shaders/aerial_volume.glsl, 32 x 32
// x 16 as published, over directions from the sun's azimuth in the place of the frustum. The
// ground's ambient light is the irradiance by the tables' sky, over the sun (his 1D table, after
// Elek) and over height, which he suggests.
#pragma once

#include "model/literature/bodare_tables.h"
#include "model/literature/tabulated_model.h"

namespace skyfit {

struct BodareMethod {
  static constexpr std::string_view kName = "bodare";
  static constexpr SkyRayMapping kSkyRays = SkyRayMapping::kBodare;
  static constexpr int kBatch = literature::kTablesAtOnce;
  using Geometry = literature::BodareGeometry;
  template <int N>
  using Tables = literature::BodareTables<N>;
  template <class T>
  static Atmosphere<T> see(const Atmosphere<T>& atmosphere) {
    return atmosphere;
  }
  static bool can_fit(const Parameter&) { return true; }
};
using BodareModel = literature::TabulatedModel<BodareMethod>;

struct BodareMieFromRayleighMethod : BodareMethod {
  static constexpr std::string_view kVariant = "mie-from-rayleigh",
                                    kName = "bodare:mie-from-rayleigh";
  static constexpr double kRedNm = 650;
  WavelengthNode red{kRedNm, 0};
  template <int N>
  literature::BodareTables<N> tables(const Geometry& geometry, const Atmosphere<Dual<N>>& air,
                                     const WavelengthNode& node,
                                     std::span<const View> views) const {
    const auto at = [&](const WavelengthNode& where) {
      return literature::BodareTables<N>(
          geometry, literature::clear_air(geometry.shells(), air, where), views);
    };
    literature::BodareTables<N> tables = at(node);
    tables.take_aerosol_from_air(at(red));
    return tables;
  }
};
using BodareMieFromRayleighModel = literature::TabulatedModel<BodareMieFromRayleighMethod>;

}  // namespace skyfit
