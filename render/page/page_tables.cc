// SPDX-License-Identifier: Apache-2.0
#include "render/page/page_tables.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>

#include "model/atmosphere/derived.h"
#include "model/solver/reference_model.h"
#include "model/tables/table_precision.h"
#include "render/page/changes.h"
#include "render/page/page_errors.h"

namespace skyfit {
namespace {

void check(const Atmosphere<double>& atmosphere, const PageSlider& slider) {
  for (const double value : slider.tabulated()) {
    try {
      const auto other = changed(atmosphere, slider.parameter, value);
      validate(other);
      require_same_classes(atmosphere, other);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(
          fmt::format("the slider {} = {:.6g}: {}", slider.parameter.name(), value, error.what()));
    }
  }
}

class PageMeasure {
 public:
  PageMeasure(const SkyPageRequest& request, const AtmosphereTables& tables)
      : request_(request), tables_(tables) {}

  // Of the preset, from a height.
  WorstError error_from(double altitude_m) const {
    const Atmosphere<double>& atmosphere = request_.preset.atmosphere;
    const double top = atmosphere.top_radius_m - atmosphere.bottom_radius_m;
    return worst(atmosphere, {}, std::min(altitude_m, 0.9 * top));
  }

  // At the tabulated values, and half-way between neighbours of these and the preset's.
  void measure(SliderTables& slider) const {
    const auto [first, second] = slider.slider.tabulated();
    std::array values = {first, slider.slider.value, second};
    std::ranges::sort(values);
    slider.tabulated_error = std::max(error_at(slider, first), error_at(slider, second));
    slider.half_way_error =
        std::max(error_at(slider, slider.slider.half_way(values[0], values[1])),
                 error_at(slider, slider.slider.half_way(values[1], values[2])));
  }

 private:
  double error_at(const SliderTables& slider, double value) const {
    const auto shares = change_shares(slider.slider, value);
    const std::array<WeightedTables, 2> weighted = {
        {{slider.changes[0], shares[0]}, {slider.changes[1], shares[1]}}};
    return worst(changed(request_.preset.atmosphere, slider.slider.parameter, value), weighted, 0)
        .error;
  }

  WorstError worst(const Atmosphere<double>& atmosphere, std::span<const WeightedTables> changes,
                   double altitude_m) const {
    const std::vector<SkyPoint> points = compared_points(altitude_m);
    return largest_error(points,
                         table_luminances(tables_, changes, phase_classes(atmosphere), points),
                         reference_luminances(atmosphere, request_.spectra, points, 1));
  }

  const SkyPageRequest& request_;
  const AtmosphereTables& tables_;
};

}  // namespace

TableSizes page_sizes(const Atmosphere<double>& atmosphere) {
  TableSizes sizes = kSmallTableSizes;
  sizes.outside_sky = 4;
  sizes.outside_mu_s = 8;
  sizes.outside_azimuth = 4;
  const auto is_thick_layer = [&](const Constituent<double>& c) {
    constexpr double kThick = 1, kGreen = 550;  // nm
    return c.profile.type == ProfileType::kLayer &&
           vertical_optical_depth(atmosphere, c, {kGreen, 0}) > kThick;
  };
  sizes.scattering_r = 24;
  if (std::ranges::any_of(atmosphere.constituents, is_thick_layer)) return sizes;
  const bool has_narrow_lobe = options_for(atmosphere, {}).moments > ReferenceOptions{}.moments;
  sizes.scattering_r = has_narrow_lobe ? 24 : 26;
  sizes.scattering_mu_s = has_narrow_lobe ? 52 : 48;
  sizes.scattering_azimuth = has_narrow_lobe ? 20 : 16;
  if (has_narrow_lobe) sizes.scattering_sky = 42;
  return sizes;
}

Packing scattering_packing(const TableSizes& sizes) {
  return {.step = 1.0 / 160, .row = sizes.scattering_mu_s};
}

PageTables page_tables(const SkyPageRequest& request) {
  const Atmosphere<double>& atmosphere = request.preset.atmosphere;
  for (const PageSlider& slider : request.sliders) check(atmosphere, slider);
  const ColorRule color = color_rule(request.spectra);
  PageTables page;
  page.tables = compute_tables(atmosphere, color, page_sizes(atmosphere), request.threads, {});
  const Packing packing = scattering_packing(page.tables.sizes);
  page.tables.rayleigh_like = as_decoded(page.tables.rayleigh_like, packing);
  page.tables.single = as_decoded(page.tables.single, packing);
  const PageMeasure measure(request, page.tables);
  for (std::size_t i = 0; i < page.errors.size(); ++i)
    page.errors[i] = measure.error_from(kComparedAltitudes_m[i]);
  std::atomic<int> done = 0;
  const auto report = [&] {
    request.progress(static_cast<double>(++done) / static_cast<double>(1 + request.sliders.size()));
  };
  report();
  const AtmosphereTables before =
      compute_tables(atmosphere, color, kComparedSizes, request.threads, {}, {}, HeightAxis());
  for (const PageSlider& slider : request.sliders) page.sliders.push_back({slider, {}});
  tbb::task_arena arena(request.threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, page.sliders.size(), [&](std::size_t i) {
      SliderTables& slider = page.sliders[i];
      for (const double value : slider.slider.tabulated()) {
        const auto other = changed(atmosphere, slider.slider.parameter, value);
        slider.changes.push_back(table_change(
            before, compute_tables(other, color, kComparedSizes, 1, {}, {}, HeightAxis())));
      }
      measure.measure(slider);
      report();
    });
  });
  return page;
}

}  // namespace skyfit
