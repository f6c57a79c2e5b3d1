// SPDX-License-Identifier: Apache-2.0
#include "model/tables.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/hemisphere.h"
#include "model/parameter_field.h"
#include "model/ray.h"
#include "model/scattering_tables.h"
#include "model/shared/shared.h"
#include "model/table_lookup.h"

namespace skyfit {
namespace {

Shared<double> shared;  // stateless

Table make_table(int width, int height, int depth) {
  Table table{width, height, depth, {}};
  table.rgba.resize(4 * static_cast<std::size_t>(width) * height * depth);
  return table;
}

void store(Table& table, int x, int y, const NodeValues& value) {
  const std::size_t texel = static_cast<std::size_t>(y) * table.width + x;
  for (std::size_t k = 0; k < 4; ++k) table.rgba[4 * texel + k] = static_cast<float>(value[k]);
}

// Even steps of the angle, in which the logarithm is piecewise linear.
Table phase_table(const AerosolPhase<double>& phase) {
  constexpr int kSteps = 4095;  // of 0.044 degrees
  if (phase.type != PhaseType::kTabulated) return make_table(1, 1, 1);
  Table table = make_table(kSteps + 1, 1, 1);
  for (int i = 0; i <= kSteps; ++i) {
    const double value = std::log(phase.table->phase(std::numbers::pi * i / kSteps));
    store(table, i, 0, {value, value, value, value});
  }
  return table;
}

NodeOptics optics_of(const Atmosphere<double>& atmosphere, const ColorRule& color) {
  const Atmosphere<Dual<0>> plain = seeded<0>(atmosphere, {});
  NodeOptics optics;
  for (std::size_t k = 0; k < 4; ++k)
    optics[k] = optics_at<0>(plain, color.nodes[k], kSourceOptions.moments);
  return optics;
}

double height_of_row(int row, int rows, double top) {
  return std::min(shared.height_from_unit(row / (rows - 1.0), top), top);
}

void make_optical_depth(const Shells& shells, const NodeOptics& optics, AtmosphereTables& tables) {
  const int columns = tables.sizes.optical_depth_mu, rows = tables.sizes.optical_depth_r;
  tables.optical_depth = make_table(columns, rows, 1);
  tbb::parallel_for(0, rows, [&](int y) {
    const double h = height_of_row(y, rows, shells.top);
    for (int x = 0; x < columns; ++x) {
      const double mu =
          shared.mu_from_upward_unit(x / (columns - 1.0), h, shells.bottom_radius, shells.top);
      const PathColumns path = shells.columns_to_top(h, mu);
      NodeValues tau;
      for (std::size_t k = 0; k < 4; ++k) {
        tau[k] = optics[k].air.v * path.air.value +
                 optics[k].aerosol_extinction_true.v * path.aerosol.value +
                 optics[k].ozone.v * path.ozone.value;
      }
      store(tables.optical_depth, x, y, tau);
    }
  });
}

void make_irradiance(double top, AtmosphereTables& tables) {
  const int columns = tables.sizes.irradiance_mu_s, rows = tables.sizes.irradiance_r;
  tables.irradiance = make_table(columns, rows, 1);
  tbb::parallel_for(0, columns, [&](int x) {
    constexpr int kPolar = 16, kAzimuth = 8;
    const double mu_s = shared.sun_from_unit(x / (columns - 1.0), kTableLowestSun);
    const std::vector<SkySample> sky = sky_samples(mu_s, kPolar, kAzimuth);
    for (int y = 0; y < rows; ++y) {
      const double h = height_of_row(y, rows, top);
      NodeValues sum{};
      for (const SkySample& sample : sky) {
        const NodeValues l = lookup_radiance(tables, h, sample.mu, mu_s, sample.nu, false);
        for (std::size_t k = 0; k < 4; ++k) sum[k] += sample.weight * l[k];
      }
      store(tables.irradiance, x, y, sum);
    }
  });
}

AtmosphereTables build(const Atmosphere<double>& atmosphere, const ColorRule& color,
                       const TableSizes& sizes, const std::function<void(double)>& progress) {
  AtmosphereTables tables;
  tables.atmosphere = atmosphere;
  tables.color = color;
  tables.sizes = sizes;
  tables.phase = phase_table(atmosphere.mie.phase);
  const Shells shells = shells_of(atmosphere);
  const NodeOptics optics = optics_of(atmosphere, color);
  const int width = sizes.scattering_mu_s * sizes.scattering_azimuth;
  const int height = sizes.scattering_ground + sizes.scattering_sky;
  tables.rayleigh_like = make_table(width, height, sizes.scattering_r);
  tables.single_mie = make_table(width, height, sizes.scattering_r);
  constexpr double kBefore = 0.15, kScattering = 0.75;  // shares of the time
  make_scattering_tables(shells, optics, tables, [&](double part) {
    if (progress) progress(kBefore + kScattering * part);
  });
  make_optical_depth(shells, optics, tables);
  make_irradiance(shells.top, tables);
  if (progress) progress(1);
  return tables;
}

}  // namespace

AtmosphereTables compute_tables(const Atmosphere<double>& atmosphere, const ColorRule& color,
                                const TableSizes& sizes, int threads,
                                const std::function<void(double)>& progress) {
  validate(atmosphere);
  tbb::task_arena arena(threads);
  return arena.execute([&] { return build(atmosphere, color, sizes, progress); });
}

}  // namespace skyfit
