// SPDX-License-Identifier: Apache-2.0
#include "model/tables/table_cache.h"

#include <array>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "model/atmosphere/preset.h"

namespace skyfit {
namespace {

// Bytes of padding would differ from run to run.
static_assert(std::has_unique_object_representations_v<TableSizes> &&
              std::has_unique_object_representations_v<TableLight> &&
              std::has_unique_object_representations_v<BrunetonChoices> &&
              std::has_unique_object_representations_v<NielsenChoices> &&
              std::has_unique_object_representations_v<ONeilChoices>);
static_assert(sizeof(ColorRule) == (4 * 4 + 3 * 4) * sizeof(double));

CacheKey key_of(const TableInputs& inputs) {
  CacheKey key("tables");
  key.text(inputs.model).value(inputs.light).value(inputs.color).value(inputs.sizes);
  key.text(preset_to_json({{}, inputs.atmosphere, nullptr}));
  return key;
}

// What is computed, but what follows from the inputs at once.
struct Header {
  TableSizes sizes;
  SkyRayMapping mapping;
  NielsenChoices nielsen;
  ONeilChoices oneil;
  BrunetonChoices bruneton;
  FormulaSky formula;
  bool limited;
  double highest_m;
  int deck_node;
  std::array<std::array<int, 3>, 8> extents;
};

// The order of the parts behind the header, the name in the limits and the nodes of the heights.
template <class Tables>
auto all_tables(Tables& tables) {
  // One name for each member: a new one must be thought of here.
  auto& [atmosphere, phases, color, sizes, heights, optical_depth, irradiance, rayleigh_like,
         single, phase, sky_rays] = tables;
  return std::array{&optical_depth, &irradiance,   &rayleigh_like,    &single,
                    &phase,         &sky_rays.air, &sky_rays.aerosol, &sky_rays.gathered};
}
constexpr std::size_t kBefore = 3;

void keep(ContentCache& cache, const CacheKey& key, const AtmosphereTables& tables) {
  const auto& [mapping, air, aerosol, nielsen, oneil, formula, limits, gathered, bruneton] =
      tables.sky_rays;
  Header header{};
  header.sizes = tables.sizes;
  header.mapping = mapping;
  header.nielsen = nielsen;
  header.oneil = oneil;
  header.bruneton = bruneton;
  header.formula = formula;
  header.limited = limits.has_value();
  header.highest_m = limits ? limits->highest_m : 0;
  header.deck_node = tables.heights.deck_node();
  const std::string model = limits ? limits->model : "";
  std::vector<std::span<const std::byte>> parts = {
      std::as_bytes(std::span(&header, 1)), std::as_bytes(std::span(model)),
      std::as_bytes(std::span(tables.heights.nodes()))};
  for (std::size_t i = 0; const Table* table : all_tables(tables)) {
    header.extents[i++] = {table->width, table->height, table->depth};
    parts.push_back(std::as_bytes(std::span(table->rgba)));
  }
  cache.keep(key, parts);
}

bool find(ContentCache& cache, const CacheKey& key, AtmosphereTables& tables) {
  Header header{};
  std::string model;
  std::vector<double> nodes;
  const auto room = [&](std::size_t part, std::uint64_t bytes) -> std::span<std::byte> {
    if (part == 0) return std::as_writable_bytes(std::span(&header, 1));
    if (part == 1) {
      model.resize(bytes);
      return std::as_writable_bytes(std::span(model));
    }
    if (part == 2) {
      nodes.resize(bytes / sizeof(double));
      return std::as_writable_bytes(std::span(nodes));
    }
    const auto all = all_tables(tables);
    if (part >= kBefore + all.size()) return {};
    const auto [width, height, depth] = header.extents[part - kBefore];
    Table& table = *all[part - kBefore];
    table = {width, height, depth, {}};
    table.rgba.resize(bytes / sizeof(float));
    return std::as_writable_bytes(std::span(table.rgba));
  };
  if (!cache.find(key, room)) return false;
  tables.sizes = header.sizes;
  if (header.deck_node >= 0)
    tables.heights = HeightAxis(std::move(nodes), static_cast<std::size_t>(header.deck_node));
  tables.sky_rays.mapping = header.mapping;
  tables.sky_rays.nielsen = header.nielsen;
  tables.sky_rays.oneil = header.oneil;
  tables.sky_rays.bruneton = header.bruneton;
  tables.sky_rays.formula = header.formula;
  if (header.limited) tables.sky_rays.limits = DaylightLimits{model, header.highest_m};
  return true;
}

}  // namespace

AtmosphereTables cached_tables(ContentCache& cache, const TableInputs& inputs,
                               const std::function<AtmosphereTables()>& compute) {
  const CacheKey key = key_of(inputs);
  AtmosphereTables kept;
  if (find(cache, key, kept)) {
    kept.atmosphere = inputs.atmosphere;
    kept.color = inputs.color;
    kept.phases = phase_classes(inputs.atmosphere);
    return kept;
  }
  AtmosphereTables computed = compute();
  keep(cache, key, computed);
  return computed;
}

}  // namespace skyfit
