// SPDX-License-Identifier: Apache-2.0
// A sky model of tables that are computed for one wavelength at a time. Its method names
//   kName, kBatch (derivatives at once); where it has choices, name, which says them,
//   Geometry(Atmosphere<double>): all that does not depend on the wavelength,
//   Tables<N>(geometry, optics, views): the tables, of which those that the views need may do,
//   with light(view), sky_rays() and bytes(); no views: all of them; where it is cheaper,
//   scattered(view), which is light(view) without the ground and without interpolation,
//   kSkyRays: how sky_rays() are read; where it has choices, mark(sky_rays()), which says them,
//   see(Atmosphere<T>): the atmosphere as the method sees it,
//   where it takes more than one wavelength, tables<N>(geometry, see(atmosphere), node, views),
//   can_fit(Parameter).
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include "model/literature/evaluate.h"

namespace skyfit::literature {

template <class Method>
class TabulatedModel final : public SkyModel {
 public:
  explicit TabulatedModel(int threads, Method method = {})
      : threads_(threads), method_(std::move(method)) {
    check_model_value(Method::kName, threads >= 1, "threads", threads, ">= 1");
  }
  std::string_view name() const override {
    if constexpr (requires { method_.name; }) {
      return method_.name;
    } else {
      return Method::kName;
    }
  }
  Atmosphere<double> effective_atmosphere(const Atmosphere<double>& atmosphere) const override {
    return Method::see(atmosphere);
  }
  bool can_fit(const Parameter& parameter) const override { return Method::can_fit(parameter); }

  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override {
    check_request(Method::kName, atmosphere, points, derivatives);
    std::vector<View> views;
    for (const SkyPoint& point : points) views.push_back(view_of(atmosphere, point));
    const std::shared_ptr<const Kept> kept = kept_for(atmosphere);
    std::shared_ptr<const Geometry> geometry = kept ? kept->geometry : nullptr;
    return tbb::task_arena(threads_).execute([&] {
      return evaluate<Method::kBatch>(
          atmosphere, wavelengths, points.size(), derivatives,
          [&]<int N>(const Atmosphere<Dual<N>>& air, const WavelengthNode& node,
                     std::span<Dual<N>> out) {
            const auto look_up = [&](const Tables<N>& tables) {
              tbb::parallel_for(std::size_t{0}, views.size(),
                                [&](std::size_t i) { out[i] = tables.light(views[i]).sum(); });
            };
            if constexpr (N == 0) {
              if (const Tables<0>* tables = kept ? kept->at(node) : nullptr)
                return look_up(*tables);
            }
            if (!geometry) geometry = std::make_shared<const Geometry>(atmosphere);
            look_up(make_tables<N>(*geometry, Method::see(air), node, views));
          });
    });
  }

  // Of tables that prepare() has made.
  ScatteredLight scattered_light(const Atmosphere<double>& atmosphere,
                                 std::span<const WavelengthNode> wavelengths,
                                 std::span<const SkyPoint> points) const override {
    check_request(Method::kName, atmosphere, points, {});
    const std::shared_ptr<const Kept> kept = prepared(atmosphere);
    ScatteredLight light;
    light.air.resize(points.size() * wavelengths.size());
    light.aerosol.resize(light.air.size());
    tbb::task_arena(threads_).execute([&] {
      tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
        const View view = view_of(atmosphere, points[i]);
        for (std::size_t w = 0; w < wavelengths.size(); ++w) {
          const Tables<0>& tables = kept->prepared(wavelengths[w]);
          RayLight<0> of_ray;
          if constexpr (requires { tables.scattered(view); }) {
            of_ray = tables.scattered(view);
          } else {
            of_ray = tables.light(view);
          }
          light.air[i * wavelengths.size() + w] = of_ray.air.v;
          light.aerosol[i * wavelengths.size() + w] = of_ray.aerosol.v;
        }
      });
    });
    return light;
  }

  std::optional<SkyRayTables> sky_rays(const Atmosphere<double>& atmosphere,
                                       std::span<const WavelengthNode, 4> nodes) const override {
    const std::shared_ptr<const Kept> kept = prepared(atmosphere);
    SkyRayTables tables{Method::kSkyRays, {}, {}};
    if constexpr (requires { method_.mark(tables); }) method_.mark(tables);
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      const SkyRayTexels texels = kept->prepared(nodes[node]).sky_rays();
      for (const auto& [of_node, table] :
           {std::pair(&texels.air, &tables.air), std::pair(&texels.aerosol, &tables.aerosol),
            std::pair(&texels.gathered, &tables.gathered)}) {
        if (node == 0)
          *table = {of_node->width, of_node->height, of_node->depth,
                    std::vector<float>(4 * of_node->values.size())};
        for (std::size_t i = 0; i < of_node->values.size(); ++i)
          table->rgba[4 * i + node] = of_node->values[i];
      }
    }
    return tables;
  }

  std::size_t prepare(const Atmosphere<double>& atmosphere,
                      std::span<const WavelengthNode> wavelengths) const override {
    check_request(Method::kName, atmosphere, {}, {});
    if (const std::shared_ptr<const Kept> same = kept_for(atmosphere)) {
      if (std::ranges::all_of(wavelengths, [&](const auto& node) { return same->at(node); }))
        return same->bytes();
    }
    const auto kept = std::make_shared<Kept>();
    kept->atmosphere = atmosphere;
    tbb::task_arena(threads_).execute([&] {
      kept->geometry = std::make_shared<const Geometry>(atmosphere);
      const Atmosphere<Dual<0>> air = Method::see(seeded<0>(atmosphere, {}));
      for (const WavelengthNode& node : wavelengths) {
        kept->nodes.push_back(node);
        kept->tables.push_back(std::make_shared<const Tables<0>>(
            make_tables<0>(*kept->geometry, air, node, std::span<const View>{})));
      }
    });
    const std::size_t bytes = kept->bytes();
    const std::lock_guard lock(mutex_);
    kept_ = kept;
    return bytes;
  }

  // Finished tables of an atmosphere, one for each wavelength, in the place of those that prepare()
  // makes. `geometry` is theirs.
  void keep(const Atmosphere<double>& atmosphere,
            std::shared_ptr<const typename Method::Geometry> geometry,
            std::vector<WavelengthNode> wavelengths,
            std::vector<std::shared_ptr<const typename Method::template Tables<0>>> tables) const {
    auto kept = std::make_shared<Kept>(
        Kept{atmosphere, std::move(geometry), std::move(wavelengths), std::move(tables)});
    const std::lock_guard lock(mutex_);
    kept_ = std::move(kept);
  }

 private:
  using Geometry = typename Method::Geometry;
  template <int N>
  using Tables = typename Method::template Tables<N>;

  template <int N>
  Tables<N> make_tables(const Geometry& geometry, const Atmosphere<Dual<N>>& seen,
                        const WavelengthNode& node, std::span<const View> views) const {
    if constexpr (requires { method_.template tables<N>(geometry, seen, node, views); }) {
      return method_.template tables<N>(geometry, seen, node, views);
    } else {
      return Tables<N>(geometry, clear_air(geometry.shells(), seen, node), views);
    }
  }

  struct Kept {
    Atmosphere<double> atmosphere;
    std::shared_ptr<const Geometry> geometry;
    std::vector<WavelengthNode> nodes;
    std::vector<std::shared_ptr<const Tables<0>>> tables;

    std::size_t bytes() const {
      std::size_t sum = 0;
      for (const auto& of_node : tables) sum += of_node->bytes();
      return sum;
    }
    const Tables<0>* at(const WavelengthNode& node) const {
      const auto found = std::find(nodes.begin(), nodes.end(), node);
      return found == nodes.end() ? nullptr : tables[found - nodes.begin()].get();
    }
    const Tables<0>& prepared(const WavelengthNode& node) const {
      if (const Tables<0>* tables_of_node = at(node)) return *tables_of_node;
      throw std::logic_error("tabulated model: expected a wavelength that prepare() was told of");
    }
  };
  std::shared_ptr<const Kept> kept_for(const Atmosphere<double>& atmosphere) const {
    const std::lock_guard lock(mutex_);
    return kept_ && kept_->atmosphere == atmosphere ? kept_ : nullptr;
  }

  std::shared_ptr<const Kept> prepared(const Atmosphere<double>& atmosphere) const {
    if (std::shared_ptr<const Kept> kept = kept_for(atmosphere)) return kept;
    throw std::logic_error("tabulated model: expected an atmosphere that prepare() was told of");
  }

  int threads_;
  Method method_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const Kept> kept_;
};

}  // namespace skyfit::literature
