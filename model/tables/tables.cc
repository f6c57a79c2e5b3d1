// SPDX-License-Identifier: Apache-2.0
#include "model/tables/tables.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "model/atmosphere/parameter_field.h"
#include "model/atmosphere/phase_moments.h"
#include "model/geometry/ray.h"
#include "model/numerics/half.h"
#include "model/numerics/hemisphere.h"
#include "model/shared/shared.h"
#include "model/sky_model.h"
#include "model/tables/scattering_tables.h"
#include "model/tables/table_lookup.h"
#include "model/tables/texel_rays.h"

namespace skyfit {
namespace {

Shared<double> shared;  // stateless

Table make_table(int width, int height, int depth) {
  Table table{width, height, depth, {}};
  table.rgba.resize(4 * static_cast<std::size_t>(width) * height * depth);
  return table;
}

SkyRayTables outside_tables(const RayTexels& texels, const PhaseClasses& phases) {
  const int classes = static_cast<int>(phases.others.size());
  return {SkyRayMapping::kFromOutside, make_table(texels.mu_s, texels.azimuth, texels.rows()),
          make_table(texels.mu_s, texels.azimuth, classes * texels.rows())};
}

void store(Table& table, int x, int y, const NodeValues& value) {
  const std::size_t texel = static_cast<std::size_t>(y) * table.width + x;
  for (std::size_t k = 0; k < 4; ++k) table.rgba[4 * texel + k] = static_cast<float>(value[k]);
}

bool is_tabulated(const PhaseFunction<double>& phase) {
  return phase.type == PhaseType::kTabulated || depends_on_wavelength(phase.type);
}

// Even steps of the angle, in which the logarithm is piecewise linear.
Table phase_table(const PhaseClasses& phases, const ColorRule& color) {
  constexpr int kSteps = 4095;  // of 0.044 degrees
  if (std::ranges::none_of(phases.others, is_tabulated)) return make_table(1, 1, 1);
  Table table = make_table(kSteps + 1, static_cast<int>(phases.others.size()), 1);
  for (std::size_t y = 0; y < phases.others.size(); ++y) {
    if (!is_tabulated(phases.others[y])) continue;
    for (int i = 0; i <= kSteps; ++i) {
      NodeValues value;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto phase = phase_at(phases.others[y], color.nodes[k].wavelength_nm);
        value[k] = std::log(phase_value(phase, std::cos(std::numbers::pi * i / kSteps)));
      }
      store(table, i, static_cast<int>(y), value);
    }
  }
  return table;
}

NodeOptics optics_of(const Shells& shells, const Atmosphere<double>& atmosphere,
                     const ColorRule& color, int moments) {
  const Atmosphere<Dual<0>> plain = seeded<0>(atmosphere, {});
  NodeOptics optics;
  for (std::size_t k = 0; k < 4; ++k)
    optics[k] = optics_at<0>(shells, plain, color.nodes[k], moments);
  return optics;
}

void make_optical_depth(const Shells& shells, const NodeOptics& optics, AtmosphereTables& tables) {
  const int columns = tables.sizes.optical_depth_mu, rows = tables.sizes.optical_depth_r;
  tables.optical_depth = make_table(columns, rows, 1);
  tbb::parallel_for(0, rows, [&](int y) {
    const double h = tables.heights.height(y / (rows - 1.0), shells.top);
    for (int x = 0; x < columns; ++x) {
      const double mu =
          shared.mu_from_upward_unit(x / (columns - 1.0), h, shells.bottom_radius, shells.top);
      const PathColumns path = shells.columns_to_top(h, mu);
      NodeValues tau;
      for (std::size_t k = 0; k < 4; ++k) tau[k] = optics[k].optical_depth(path).v;
      store(tables.optical_depth, x, y, tau);
    }
  });
}

void keep_transmittances_in_half_floats(Table& optical_depth) {
  for (float& value : optical_depth.rgba)
    value = static_cast<float>(rounded_to_half(std::exp(-double{value})));
}

// Of an observer's sky: the values [point][node] of its directions.
using SkyLight =
    std::function<std::vector<double>(double height, double mu_s, std::span<const SkySample> sky)>;

void make_irradiance(double top, const SkyLight& light, AtmosphereTables& tables) {
  const int columns = tables.sizes.irradiance_mu_s, rows = tables.sizes.irradiance_r;
  tables.irradiance = make_table(columns, rows, 1);
  tbb::parallel_for(0, columns, [&](int x) {
    constexpr int kPolar = 16, kAzimuth = 8;
    for (int y = 0; y < rows; ++y) {
      const double h = tables.heights.height(y / (rows - 1.0), top);
      const double mu_s =
          shared.mu_s_from_sun_height(h, shared.sun_from_unit(x / (columns - 1.0), kTableLowestSun),
                                      tables.atmosphere.bottom_radius_m);
      const std::vector<SkySample> sky = sky_samples(mu_s, kPolar, kAzimuth);
      NodeValues sum{};
      const std::vector<double> values = light(h, mu_s, sky);
      for (std::size_t i = 0; i < sky.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) sum[k] += sky[i].weight * values[4 * i + k];
      store(tables.irradiance, x, y, sum);
    }
  });
}

SkyLight looked_up(const AtmosphereTables& tables) {
  return [&](double height, double mu_s, std::span<const SkySample> sky) {
    std::vector<double> values;
    for (const SkySample& sample : sky) {
      const NodeValues l = lookup_radiance(tables, height, sample.mu, mu_s, sample.nu, false);
      values.insert(values.end(), l.begin(), l.end());
    }
    return values;
  };
}

// Of a model by day: above its highest observer as his, of a sun below the horizon none.
SkyLight of_daylight(const SkyModel& model, const AtmosphereTables& tables) {
  return [&](double height, double mu_s, std::span<const SkySample> sky) {
    if (mu_s <= 0) return std::vector<double>(4 * sky.size());
    std::vector<SkyPoint> points;
    for (const SkySample& sample : sky) {
      points.push_back({std::min(height, tables.sky_rays.limits->highest_m), std::acos(mu_s),
                        std::acos(sample.mu),
                        std::acos(shared.cosine_of_azimuth(sample.mu, mu_s, sample.nu))});
    }
    return model.radiance(tables.atmosphere, tables.color.nodes, points, {}).value;
  };
}

// A model's light on all rays from a height, into the texels from `first` on.
void tabulate_rays(const SkyModel& model, const Atmosphere<double>& atmosphere,
                   const ColorRule& color, const Shells& shells, const RayTexels& texels,
                   double height, double deck, const PhaseClasses& phases, Table& rayleigh_like,
                   Table& single, std::size_t first) {
  std::vector<SkyPoint> points;
  std::vector<double> length_km, nus;
  for (int row = 0; row < texels.rows(); ++row) {
    const TexelRay texel = texel_ray(shells, texels, row, height, deck);
    const double r0 = shells.bottom_radius + texel.ray.entry_height,
                 r = shells.bottom_radius + texel.sun_point.height, mu = texel.sun_point.mu;
    // A ray along the horizon is kept on its side of it.
    constexpr double kSide = 1e-9;
    const double start_mu =
        std::clamp(texel.ray.entry_mu + (texel.ray.hits_ground ? -kSide : kSide), -1.0, 1.0);
    for (const TexelSun& sun : texel_suns(texels, shells.bottom_radius, texel.sun_point.height)) {
      const double nu =
          std::clamp(mu * sun.mu_s + std::sqrt(std::max(1 - mu * mu, 0.0)) * sun.across, -1.0, 1.0);
      const double mu_s = std::clamp((r * sun.mu_s - texel.sun_point.s * nu) / r0, -1.0, 1.0);
      points.push_back({texel.ray.entry_height, std::acos(mu_s), std::acos(start_mu),
                        std::acos(shared.cosine_of_azimuth(start_mu, mu_s, nu))});
      length_km.push_back(1e-3 * texel.ray.length);
      nus.push_back(nu);
    }
  }
  const ScatteredLight light = model.scattered_light(atmosphere, color.nodes, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double air_phase = shared.rayleigh_phase(phases.depolarisation, nus[i]);
    for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) {
      const auto logarithm = [&](double radiance, double phase) {
        return static_cast<float>(
            std::log(std::max(radiance / (phase * length_km[i]), kDarkestScattering)));
      };
      rayleigh_like.rgba[4 * first + k] = logarithm(light.air[k], air_phase);
      // A model that can be tabulated has one aerosol at most.
      const auto phase = phase_at(phases.others[0], color.nodes[k % 4].wavelength_nm);
      single.rgba[4 * first + k] = logarithm(light.aerosol[k], phase_value(phase, nus[i]));
    }
  }
}

// Of a closed form nothing is read but the irradiance.
TableSizes sizes_beside_closed_form(TableSizes sizes) {
  sizes.scattering_r = sizes.scattering_ground = sizes.scattering_sky = sizes.scattering_mu_s =
      sizes.scattering_azimuth = 2;
  return sizes;
}

// Where the renderer sums light along rays itself, the scattering tables hold that in the
// irradiance and before clouds alone.
TableSizes sizes_beside(const std::optional<SkyRayTables>& own, TableSizes sizes) {
  if (own && is_closed_form(own->mapping)) return sizes_beside_closed_form(sizes);
  if (!own || (own->mapping != SkyRayMapping::kONeil && own->mapping != SkyRayMapping::kHillaire &&
               own->mapping != SkyRayMapping::kBodare))
    return sizes;
  sizes.scattering_r = std::min(sizes.scattering_r, 16);
  sizes.scattering_ground = std::min(sizes.scattering_ground, 16);
  sizes.scattering_sky = std::min(sizes.scattering_sky, 24);
  sizes.scattering_mu_s = std::min(sizes.scattering_mu_s, 32);
  sizes.scattering_azimuth = std::min(sizes.scattering_azimuth, 8);
  return sizes;
}

void tabulate(const SkyModel& model, std::optional<SkyRayTables> own, const Shells& shells,
              AtmosphereTables& tables, const std::function<void(double)>& progress) {
  const RayTexels texels = tables.sizes.scattering();
  const std::size_t slice = static_cast<std::size_t>(texels.rows()) * texels.row();
  const int slices = tables.sizes.scattering_r;
  const double deck = tables.heights.deck(shells.top);
  for (int i = 0; i < slices; ++i) {
    tabulate_rays(model, tables.atmosphere, tables.color, shells, texels,
                  tables.heights.height(i / (slices - 1.0), shells.top), deck, tables.phases,
                  tables.rayleigh_like, tables.single, slice * static_cast<std::size_t>(i));
    progress((i + 1.0) / (slices + 1));
  }
  if (own) {
    tables.sky_rays = std::move(*own);
  } else {
    tables.sky_rays = outside_tables(tables.sizes.outside(), tables.phases);
    tabulate_rays(model, tables.atmosphere, tables.color, shells, tables.sizes.outside(),
                  shells.top, deck, tables.phases, tables.sky_rays.air, tables.sky_rays.aerosol, 0);
  }
  progress(1);
}

void set_heights(HeightAxis axis, AtmosphereTables& tables) {
  TableSizes& sizes = tables.sizes;
  for (int* heights : {&sizes.optical_depth_r, &sizes.irradiance_r, &sizes.scattering_r})
    *heights = axis.texels(*heights);
  tables.heights = std::move(axis);
}

// `model`: null for the light of the reference.
AtmosphereTables build(const SkyModel* model, const Atmosphere<double>& atmosphere,
                       const ColorRule& color, const TableSizes& sizes,
                       const std::function<void(double)>& progress, const TableLight& light,
                       const std::optional<HeightAxis>& heights_wanted) {
  AtmosphereTables tables;
  tables.atmosphere = atmosphere;
  tables.color = color;
  std::optional<SkyRayTables> own;
  if (model != nullptr) {
    model->prepare(atmosphere, color.nodes);
    own = model->sky_rays(atmosphere, color.nodes);
  }
  tables.sizes = sizes_beside(own, sizes);
  tables.phases = phase_classes(atmosphere);
  tables.phase = phase_table(tables.phases, color);
  const Atmosphere<double> effective =
      model != nullptr ? model->effective_atmosphere(atmosphere) : atmosphere;
  const Shells shells = shells_of(effective, Keep::kWhatMatters);
  const ReferenceOptions options = options_for(effective, {});
  const NodeOptics optics = optics_of(shells, effective, color, options.moments);
  const bool closed = own && is_closed_form(own->mapping),
             half_transmittances =
                 own && own->bruneton.transmittance == BrunetonTransmittance::kInHalfFloats;
  if (!closed)
    set_heights(heights_wanted.value_or(HeightAxis(shells, tables.sizes.scattering_r)), tables);
  const RayTexels texels = tables.sizes.scattering();
  const int heights = tables.sizes.scattering_r;
  tables.rayleigh_like = make_table(texels.mu_s * texels.azimuth, texels.rows(), heights);
  tables.single = make_table(texels.mu_s * texels.azimuth, texels.rows(),
                             heights * static_cast<int>(tables.phases.others.size()));
  constexpr double kBefore = 0.15, kScattering = 0.75;  // shares of the time
  const auto of_scattering = [&](double part) {
    if (progress) progress(kBefore + kScattering * part);
  };
  if (closed) {
    tables.sky_rays = std::move(*own);
  } else if (model != nullptr) {
    tabulate(*model, std::move(own), shells, tables, of_scattering);
  } else {
    tables.sky_rays = outside_tables(sizes.outside(), tables.phases);
    make_scattering_tables(shells, optics, tables, options, light, of_scattering);
  }
  make_optical_depth(shells, optics, tables);
  make_irradiance(shells.top, closed ? of_daylight(*model, tables) : looked_up(tables), tables);
  if (half_transmittances) keep_transmittances_in_half_floats(tables.optical_depth);
  if (progress) progress(1);
  return tables;
}

}  // namespace

AtmosphereTables compute_tables(const Atmosphere<double>& atmosphere, const ColorRule& color,
                                const TableSizes& sizes, int threads,
                                const std::function<void(double)>& progress,
                                const TableLight& light, const std::optional<HeightAxis>& heights) {
  validate(atmosphere);
  tbb::task_arena arena(threads);
  return arena.execute(
      [&] { return build(nullptr, atmosphere, color, sizes, progress, light, heights); });
}

AtmosphereTables compute_tables_of(const SkyModel& model, const Atmosphere<double>& atmosphere,
                                   const ColorRule& color, const TableSizes& sizes, int threads,
                                   const std::function<void(double)>& progress,
                                   const std::optional<HeightAxis>& heights) {
  if (model.name() == "reference" || model.name() == "tables")
    return compute_tables(atmosphere, color, sizes, threads, progress, {model.transfer()}, heights);
  validate(atmosphere);
  tbb::task_arena arena(threads);
  return arena.execute(
      [&] { return build(&model, atmosphere, color, sizes, progress, {}, heights); });
}

}  // namespace skyfit
