// SPDX-License-Identifier: Apache-2.0
#include "render/scene/material_file.h"

#include <fmt/format.h>

#include <stdexcept>

#include "model/base/preset_reader.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

double length_m(const PresetReader& reader, std::string_view field, double usual) {
  if (!reader.has(field)) return usual;
  const double value = reader.number(field);
  if (!(value >= kShortestRepeat && value <= kLongestRepeat))
    reader.fail_value(field,
                      fmt::format("metres, {:.9g} to {:.9g}", kShortestRepeat, kLongestRepeat));
  return value;
}

OwnMaterial read_material(const PresetReader& reader, const fs::path& folder, NamedFiles allowed) {
  reader.expect_only({"color", "normal", "near_m", "far_m"});
  const auto picture = [&](std::string_view field) {
    if (!reader.has(field)) return fs::path();
    const auto file = named_file(folder, reader.text(field), allowed);
    if (!file) reader.fail_value(field, kNamedFile);
    require_regular_file(*file, fmt::format("a picture for {}", kMaterialFile), kMostImageBytes);
    return *file;
  };
  OwnMaterial material;
  material.color = picture("color");
  material.normal = picture("normal");
  material.near_m = length_m(reader, "near_m", material.near_m);
  // Without one of its own it is as many times as long as that of usual lengths.
  material.far_m =
      length_m(reader, "far_m", material.near_m * (OwnMaterial{}.far_m / OwnMaterial{}.near_m));
  if (material.far_m < material.near_m) reader.fail_value("far_m", "near_m or more");
  return material;
}

}  // namespace

OwnMaterials read_materials(const fs::path& folder, NamedFiles allowed) {
  const fs::path file = folder / kMaterialFile;
  OwnMaterials own;
  if (folder.empty() || !fs::exists(file)) return own;
  const PresetDocument document(read_file(file, "the materials of a ground (JSON)"), file.string());
  const PresetReader root = document.root();
  root.expect_only({"skyfit_materials", "soil", "rock"});
  if (root.number("skyfit_materials") != 1) root.fail_value("skyfit_materials", "1");
  if (root.has("soil")) own.soil = read_material(root.object("soil"), folder, allowed);
  if (root.has("rock")) own.rock = read_material(root.object("rock"), folder, allowed);
  return own;
}

}  // namespace skyfit
