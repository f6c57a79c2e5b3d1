// SPDX-License-Identifier: Apache-2.0
#include "model/tables/table_model.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "model/geometry/view.h"
#include "model/shared/shared.h"
#include "model/tables/table_lookup.h"

namespace skyfit {
namespace {

void check(bool good, std::string_view name, double value, std::string_view expected) {
  check_model_value("tables", good, name, value, expected);
}

void refuse_derivatives(std::span<const Parameter> derivatives) {
  if (!derivatives.empty())
    throw std::invalid_argument("tables model: has no derivatives; the reference model has");
}

NodeValues radiance_of(const AtmosphereTables& tables, const View& view, double eye_m) {
  const TablePlace place{view.ray.entry_height, view.ray.entry_mu, view.mu_s};
  NodeValues sum{};
  if (view.ray.length > 0) {
    const bool from_outside = eye_m > view.ray.entry_height && !view.ray.hits_ground;
    sum = from_outside ? lookup_radiance_from_outside(tables, place.mu, place.mu_s, view.nu)
                       : lookup_radiance(tables, place.height, place.mu, place.mu_s, view.nu,
                                         view.ray.hits_ground);
  }
  if (!view.ray.hits_ground) return sum;
  const TablePlace ground = place_along(tables, place, view.nu, view.ray.length);
  const NodeValues through = lookup_transmittance(tables, place, ground, true),
                   beam = lookup_sun_transmittance(tables, 0, ground.mu_s),
                   sky = lookup_irradiance(tables, 0, ground.mu_s);
  for (std::size_t k = 0; k < 4; ++k) {
    const double reflected =
        ground_albedo_at(tables.atmosphere, tables.color.nodes[k].wavelength_nm) / std::numbers::pi;
    sum[k] += through[k] * reflected * (beam[k] * std::max(ground.mu_s, 0.0) + sky[k]);
  }
  return sum;
}

}  // namespace

TableModel::TableModel(int threads, Transfer transfer) : threads_(threads), transfer_(transfer) {
  check(threads >= 1, "threads", threads, ">= 1");
}

SkyValues TableModel::radiance(const Atmosphere<double>& atmosphere,
                               std::span<const WavelengthNode> wavelengths,
                               std::span<const SkyPoint> points,
                               std::span<const Parameter> derivatives) const {
  refuse_derivatives(derivatives);
  validate(atmosphere);
  for (const SkyPoint& p : points) check_point("tables", p);
  SkyValues values{
      static_cast<int>(points.size()), static_cast<int>(wavelengths.size()), 0, {}, {}};
  values.value.resize(points.size() * wavelengths.size());
  const std::shared_ptr<const Kept> kept = tables_for(atmosphere, wavelengths);
  tbb::task_arena(threads_).execute([&] {
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
      const View view = view_of(atmosphere.bottom_radius_m,
                                atmosphere.top_radius_m - atmosphere.bottom_radius_m, points[i]);
      for (std::size_t four = 0; four < kept->tables.size(); ++four) {
        const NodeValues l = radiance_of(kept->tables[four], view, points[i].altitude_m);
        std::copy_n(l.begin(), std::min<std::size_t>(4, wavelengths.size() - 4 * four),
                    &values.value[i * wavelengths.size() + 4 * four]);
      }
    });
  });
  return values;
}

std::shared_ptr<const TableModel::Kept> TableModel::tables_for(
    const Atmosphere<double>& atmosphere, std::span<const WavelengthNode> wavelengths) const {
  {
    const std::lock_guard lock(mutex_);
    if (kept_ && kept_->atmosphere == atmosphere &&
        std::ranges::equal(kept_->wavelengths, wavelengths)) {
      return kept_;
    }
  }
  const auto made = std::make_shared<Kept>();
  made->atmosphere = atmosphere;
  made->wavelengths.assign(wavelengths.begin(), wavelengths.end());
  for (std::size_t first = 0; first < wavelengths.size(); first += 4) {
    ColorRule four{};  // no colours are asked for; the last wavelength fills the four
    for (std::size_t k = 0; k < 4; ++k)
      four.nodes[k] = wavelengths[std::min(first + k, wavelengths.size() - 1)];
    made->tables.push_back(
        compute_tables(atmosphere, four, TableSizes{}, threads_, {}, {transfer_}));
  }
  return made;
}

std::size_t TableModel::prepare(const Atmosphere<double>& atmosphere,
                                std::span<const WavelengthNode> wavelengths) const {
  validate(atmosphere);
  const std::shared_ptr<const Kept> made = tables_for(atmosphere, wavelengths);
  std::size_t bytes = 0;
  for (const AtmosphereTables& t : made->tables) {
    for (const Table* table : {&t.optical_depth, &t.irradiance, &t.rayleigh_like, &t.single,
                               &t.phase, &t.sky_rays.air, &t.sky_rays.aerosol})
      bytes += table->rgba.size() * sizeof(float);
  }
  const std::lock_guard lock(mutex_);
  kept_ = made;
  return bytes;
}

}  // namespace skyfit
