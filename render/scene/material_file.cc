// SPDX-License-Identifier: Apache-2.0
#include "render/scene/material_file.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "model/base/preset_reader.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

// Of usual lengths.
double far_over_near() { return OwnMaterial{}.far_m / OwnMaterial{}.near_m; }

double length_m(const PresetReader& reader, std::string_view field, double longest,
                std::string_view limit) {
  const double value = reader.number(field);
  if (!(value >= kShortestRepeat && value <= longest))
    reader.fail_value(field,
                      fmt::format("metres, {:.9g} to {:.9g}{}", kShortestRepeat, longest, limit));
  return value;
}

OwnMaterial read_material(const PresetReader& reader, const fs::path& folder, NamedFiles allowed,
                          const fs::path& color_map) {
  reader.expect_only({"color", "normal", "near_m", "far_m"});
  const auto picture = [&](std::string_view field) {
    if (!reader.has(field)) return fs::path();
    const auto file = named_file(folder, reader.text(field), allowed);
    if (!file) reader.fail_value(field, kNamedFile);
    require_regular_file(*file, fmt::format("a picture for {}", reader.place(field)),
                         kMostImageBytes);
    return *file;
  };
  OwnMaterial material;
  if (reader.has("color") && !color_map.empty())
    reader.fail_value("color", "none with --color-map, which has the ground's colours");
  material.color = picture("color");
  material.normal = picture("normal");
  const bool has_far = reader.has("far_m");
  if (reader.has("near_m")) {
    material.near_m = has_far
                          ? length_m(reader, "near_m", kLongestRepeat, "")
                          : length_m(reader, "near_m", std::floor(kLongestRepeat / far_over_near()),
                                     " without far_m");
  }
  material.far_m =
      has_far ? length_m(reader, "far_m", kLongestRepeat, "") : far_over_near() * material.near_m;
  if (material.far_m < material.near_m) reader.fail_value("far_m", "near_m or more");
  return material;
}

}  // namespace

OwnMaterials read_materials(const fs::path& folder, NamedFiles allowed, const fs::path& color_map) {
  const fs::path file = folder / kMaterialFile;
  OwnMaterials own;
  if (folder.empty() || !fs::exists(file)) return own;
  const PresetDocument document(read_file(file, "the materials of a ground (JSON)"), file.string());
  const PresetReader root = document.root();
  root.expect_only({"skyfit_materials", "soil", "rock"});
  if (root.number("skyfit_materials") != 1) root.fail_value("skyfit_materials", "1");
  if (root.has("soil")) own.soil = read_material(root.object("soil"), folder, allowed, color_map);
  if (root.has("rock")) own.rock = read_material(root.object("rock"), folder, allowed, color_map);
  return own;
}

}  // namespace skyfit
