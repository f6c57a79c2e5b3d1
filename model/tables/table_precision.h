// SPDX-License-Identifier: Apache-2.0
// How a renderer keeps the tables of scattered light, which are nearly all of its memory: as single
// or half precision floats, or in 8 bits (Sperlhofer 2011, 5.2.2). Deviation: his 8 bits hold the
// light, these hold its logarithm where the table does, so that dusk is not lost.
// The small tables always are floats: differences of optical depths are taken, and irradiances
// span more than half precision does.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "model/tables/tables.h"

namespace skyfit {

enum class TablePrecision { kFloat, kHalf, k8Bit };

struct TablePrecisionEntry {
  std::string_view name;
  TablePrecision precision;
  std::string_view meaning;
};
std::span<const TablePrecisionEntry> table_precisions();

// value = scale * texel + offset; a texel of 8 bits counts from 0 to 1.
struct TexelCode {
  float scale = 1, offset = 0;
};

// RGBA, x fastest, little-endian.
struct EncodedTable {
  int width = 0, height = 0, depth = 0;
  TablePrecision precision = TablePrecision::kFloat;
  TexelCode code;
  std::vector<std::byte> texels;
};

std::size_t bytes_of_texel(TablePrecision precision);

enum class TableHolds { kValues, kLogarithms };

// kHalf: logarithms as their distance from the largest, values as shares of it, so that bright
// light is the most precise; k8Bit: 255 even steps from the least to the largest. Rounded to the
// nearest.
EncodedTable encoded(const Table& table, TableHolds holds, TablePrecision precision);
Table decoded(const EncodedTable& table);

// The tables as they are read in a precision.
AtmosphereTables in_precision(const AtmosphereTables& tables, TablePrecision precision);

// What tables of whole rays hold; and whether they are kept in a precision: those of
// SkyRayMapping::kHillaire are small, others have none.
TableHolds sky_rays_hold(SkyRayMapping mapping);
bool sky_rays_encoded(SkyRayMapping mapping);

// Of all tables.
std::size_t table_bytes(const AtmosphereTables& tables, TablePrecision precision);

// A fifth of the texels.
inline constexpr TableSizes kSmallTableSizes = {.optical_depth_mu = 128,
                                                .optical_depth_r = 64,
                                                .irradiance_mu_s = 48,
                                                .irradiance_r = 12,
                                                .scattering_r = 32,
                                                .scattering_ground = 10,
                                                .scattering_sky = 40,
                                                .scattering_mu_s = 44,
                                                .scattering_azimuth = 14,
                                                .outside_sky = 50,
                                                .outside_mu_s = 64,
                                                .outside_azimuth = 24};

struct TableSizesEntry {
  std::string_view name;
  TableSizes sizes;
  std::string_view meaning;
};
// `full` is what the renderer takes by default.
std::span<const TableSizesEntry> table_sizes();

}  // namespace skyfit
