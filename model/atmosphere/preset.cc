// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/preset.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "model/atmosphere/preset_choices.h"
#include "model/atmosphere/preset_constituents.h"
#include "model/atmosphere/preset_tables.h"
#include "model/atmosphere/preset_v1.h"
#include "model/base/preset_reader.h"
#include "model/base/text.h"

namespace skyfit {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr int kPresetVersion = 2;

std::vector<Constituent<double>> read_constituents(const PresetReader& root,
                                                   const PresetTables& tables) {
  std::vector<Constituent<double>> list;
  for (const PresetReader& object : root.objects("constituents"))
    list.push_back(read_constituent(object, tables));
  return list;
}

Star read_star(const PresetReader& object, const PresetTables& tables) {
  object.expect_only({"spectrum", "distance_au", "angular_diameter_deg", "limb_darkening"});
  Star star;
  if (object.has("spectrum")) {
    const PresetReader spectrum = object.object("spectrum");
    star.spectrum = read_choice(spectrum, "type", kStarSpectra);
    if (star.spectrum == StarSpectrum::kTabulated) {
      star.table = tables.read_with(spectrum, kIrradianceFormat, [](const TwoColumns& columns) {
        return std::make_shared<const SpectrumTable>(columns, kIrradianceFormat);
      });
    } else if (star.spectrum == StarSpectrum::kBlackBody) {
      spectrum.expect_only({"type", "temperature_k"});
      star.temperature_k = spectrum.number("temperature_k");
    } else {
      spectrum.expect_only({"type"});
    }
  }
  if (object.has("distance_au")) {
    if (star.spectrum != StarSpectrum::kSolar)
      object.fail_value("distance_au", "no distance of a star whose spectrum holds at the planet");
    star.distance_au = object.number("distance_au");
  }
  if (object.has("angular_diameter_deg"))
    star.angular_diameter_deg = object.number("angular_diameter_deg");
  if (object.has("limb_darkening")) {
    const std::vector<double> u = object.numbers("limb_darkening");
    if (u.size() != 2) object.fail_value("limb_darkening", "two numbers");
    star.limb_darkening = {u[0], u[1]};
  }
  return star;
}

ordered_json star_to_json(const Star& star) {
  ordered_json spectrum = {{"type", name_of(star.spectrum, kStarSpectra)}};
  if (star.spectrum == StarSpectrum::kTabulated)
    spectrum = table_to_json(star.table->table(), kIrradianceFormat);
  if (star.spectrum == StarSpectrum::kBlackBody) spectrum["temperature_k"] = star.temperature_k;
  ordered_json object = {{"spectrum", spectrum}};
  if (star.spectrum == StarSpectrum::kSolar) object["distance_au"] = star.distance_au;
  object["angular_diameter_deg"] = star.angular_diameter_deg;
  object["limb_darkening"] = star.limb_darkening;
  return object;
}

Preset read_preset(const PresetReader& root, const PresetTables& tables) {
  const double version = root.number("skyfit_preset");
  if (version != 1 && version != kPresetVersion) {
    root.fail_value("skyfit_preset",
                    fmt::format("1 or {}, the versions this program reads", kPresetVersion));
  }
  const bool first = version == 1;
  if (first) {
    root.expect_only(
        {"skyfit_preset", "name", "planet", "rayleigh", "mie", "ozone", "ground", "fit"});
  } else {
    root.expect_only(
        {"skyfit_preset", "name", "note", "planet", "star", "ground", "constituents", "fit"});
  }
  Preset preset;
  preset.name = printable(root.text("name"));  // it is shown
  const PresetReader planet = root.object("planet");
  planet.expect_only({"bottom_radius_m", "top_radius_m"});
  preset.atmosphere.bottom_radius_m = planet.number("bottom_radius_m");
  preset.atmosphere.top_radius_m = planet.number("top_radius_m");
  preset.atmosphere.constituents =
      first ? read_constituents_v1(root, tables) : read_constituents(root, tables);
  if (root.has("note")) preset.note = root.text("note");
  const PresetReader ground = root.object("ground");
  if (first) {
    ground.expect_only({"albedo", "spectrum"});
  } else {
    ground.expect_only({"albedo", "spectrum", "sea"});
    if (ground.has("sea")) preset.atmosphere.sea = ground.flag("sea");
    if (root.has("star")) preset.atmosphere.star = read_star(root.object("star"), tables);
  }
  preset.atmosphere.ground_albedo = ground.number("albedo");
  if (ground.has("spectrum")) {
    const PresetReader spectrum = ground.object("spectrum");
    if (spectrum.text("type") != kTabulated) spectrum.fail_value("type", kTabulated);
    preset.atmosphere.ground_spectrum = tables.read<GroundSpectrum>(spectrum, kGroundFormat);
  }
  if (root.has("fit")) preset.fit = root.object("fit").value();
  return preset;
}

// The path of a field in the document from one that validate() names by its constituent.
std::string document_path(const Atmosphere<double>& atmosphere, std::string_view path) {
  const std::string_view name = path.substr(0, path.find('.'));
  const auto& list = atmosphere.constituents;
  const auto at = std::ranges::find(list, name, &Constituent<double>::name);
  if (at == list.end()) return std::string(path);
  return fmt::format("constituents[{}]{}", at - list.begin(), path.substr(name.size()));
}

}  // namespace

Preset parse_preset(std::string_view text, std::string_view source, const TableReader& reader,
                    NamedFiles named) {
  const PresetDocument document(text, source);
  const PresetTables tables(std::filesystem::path(source).parent_path(), reader, named);
  Preset preset = read_preset(document.root(), tables);
  try {
    validate(preset.atmosphere);
  } catch (const std::invalid_argument& error) {
    // validate() starts with the path of the field.
    const std::string_view message = error.what();
    const std::string_view path = message.substr(0, message.find(' '));
    const bool first = document.root().number("skyfit_preset") == 1;
    throw std::invalid_argument(fmt::format(
        "{}: {}",
        document.place(first ? std::string(path) : document_path(preset.atmosphere, path)),
        message));
  }
  return preset;
}

std::string preset_to_json(const Preset& preset) {
  const Atmosphere<double>& a = preset.atmosphere;
  validate(a);
  ordered_json root = {
      {"skyfit_preset", kPresetVersion},
      {"name", preset.name},
      {"note", preset.note},
      {"planet", {{"bottom_radius_m", a.bottom_radius_m}, {"top_radius_m", a.top_radius_m}}},
      {"star", star_to_json(a.star)},
      {"ground", {{"albedo", a.ground_albedo}, {"sea", a.sea}}},
      {"constituents", ordered_json::array()}};
  for (const Constituent<double>& c : a.constituents)
    root["constituents"].push_back(constituent_to_json(c));
  if (preset.note.empty()) root.erase("note");
  if (a.ground_spectrum)
    root["ground"]["spectrum"] = table_to_json(a.ground_spectrum->table(), kGroundFormat);
  if (!preset.fit.is_null()) root["fit"] = preset.fit;
  // A name that is not UTF-8 is written with replacement characters.
  return root.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

Preset load_preset(const std::filesystem::path& file, const TableReader& reader, NamedFiles named) {
  const std::string text = read_file(file, "a preset");
  if (text.empty())
    throw std::runtime_error(
        fmt::format("{}: cannot be read (it is empty), expected a preset", file.string()));
  return parse_preset(text, file.string(), reader, named);
}

}  // namespace skyfit
