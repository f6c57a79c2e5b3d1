// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/preset.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "model/atmosphere/preset_tables.h"
#include "model/base/preset_reader.h"

namespace skyfit {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr int kPresetVersion = 1;
constexpr std::string_view kExponential = "exponential";

template <class Enum>
struct Named {
  std::string_view name;
  Enum value;
};
constexpr std::array<Named<PhaseType>, 4> kPhaseTypes = {
    {{"cornette-shanks", PhaseType::kCornetteShanks},
     {"henyey-greenstein", PhaseType::kHenyeyGreenstein},
     {"two-lobe", PhaseType::kTwoLobe},
     {kTabulated, PhaseType::kTabulated}}};
constexpr std::array<Named<PhaseType>, 2> kLobeTypes = {kPhaseTypes[0], kPhaseTypes[1]};
constexpr std::array<Named<OzoneProfile>, 3> kOzoneProfiles = {
    {{"tent", OzoneProfile::kTent},
     {kExponential, OzoneProfile::kExponential},
     {kTabulated, OzoneProfile::kTabulated}}};

template <class Enum, std::size_t N>
Enum read_choice(const PresetReader& object, std::string_view field,
                 const std::array<Named<Enum>, N>& choices) {
  const std::string text = object.text(field);
  std::string names;
  for (const auto& choice : choices) {
    if (choice.name == text) return choice.value;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", choice.name);
  }
  object.fail_value(field, "one of " + names);
}

template <class Enum, std::size_t N>
std::string_view name_of(Enum value, const std::array<Named<Enum>, N>& choices) {
  for (const auto& choice : choices) {
    if (choice.value == value) return choice.name;
  }
  throw std::invalid_argument("an enumerator without a name");
}

PowerLaw<double> read_power_law(const PresetReader& parent) {
  const PresetReader object = parent.object("scattering_per_m");
  object.expect_only({"wavelength_nm", "value", "exponent"});
  return {object.number("wavelength_nm"), object.number("value"), object.number("exponent")};
}

TabulatedProfile read_table(const PresetReader& profile, const PresetTables& tables) {
  if (profile.text("type") != kTabulated) profile.fail_value("type", kTabulated);
  return tables.read<LinearProfile>(profile, kProfileFormat);
}

// The profile of the air or the aerosol: a scale height or a table, not both.
template <class Species>
void read_profile(const PresetReader& object, const PresetTables& tables, Species& species) {
  constexpr std::string_view kScaleHeight = "scale_height_m", kProfile = "profile";
  if (!object.has_object(kProfile)) {
    if (object.has(kProfile) && object.text(kProfile) != kExponential)
      object.fail_value(kProfile, "exponential or an object");
    species.scale_height_m = object.number(kScaleHeight);
    return;
  }
  if (object.has(kScaleHeight))
    object.fail_value(kScaleHeight, "no scale height beside a tabulated profile");
  species.profile = read_table(object.object(kProfile), tables);
}

Rayleigh<double> read_rayleigh(const PresetReader& object, const PresetTables& tables) {
  object.expect_only(
      {"scattering_per_m", "scale_height_m", "depolarisation", "site_pressure_hpa", "profile"});
  Rayleigh<double> rayleigh;
  rayleigh.scattering_per_m = read_power_law(object);
  if (object.has("depolarisation")) rayleigh.depolarisation = object.number("depolarisation");
  if (object.has("site_pressure_hpa"))
    rayleigh.site_pressure_hpa = object.number("site_pressure_hpa");
  read_profile(object, tables, rayleigh);
  return rayleigh;
}

AerosolPhase<double> read_phase(const PresetReader& object, const PresetTables& tables) {
  AerosolPhase<double> phase;
  phase.type = read_choice(object, "type", kPhaseTypes);
  if (phase.type == PhaseType::kTabulated) {
    phase.table = tables.read<TabulatedPhase>(object, kPhaseFormat);
  } else if (phase.type == PhaseType::kTwoLobe) {
    object.expect_only({"type", "lobe", "g1", "g2", "weight"});
    if (object.has("lobe")) phase.lobe = read_choice(object, "lobe", kLobeTypes);
    phase.g1 = object.number("g1");
    phase.g2 = object.number("g2");
    phase.weight = object.number("weight");
  } else {
    object.expect_only({"type", "g"});
    phase.g = object.number("g");
  }
  return phase;
}

Mie<double> read_mie(const PresetReader& object, const PresetTables& tables) {
  object.expect_only(
      {"scattering_per_m", "single_scattering_albedo", "scale_height_m", "profile", "phase"});
  Mie<double> mie;
  mie.scattering_per_m = read_power_law(object);
  mie.single_scattering_albedo = object.number("single_scattering_albedo");
  read_profile(object, tables, mie);
  mie.phase = read_phase(object.object("phase"), tables);
  return mie;
}

Ozone<double> read_ozone(const PresetReader& object, const PresetTables& tables) {
  object.expect_only({"column_du", "profile"});
  const double column = object.number("column_du");
  if (!object.has_object("profile"))
    return {column, read_choice(object, "profile", kOzoneProfiles), nullptr};
  return {column, OzoneProfile::kTabulated, read_table(object.object("profile"), tables)};
}

Preset read_preset(const PresetReader& root, const PresetTables& tables) {
  root.expect_only(
      {"skyfit_preset", "name", "planet", "rayleigh", "mie", "ozone", "ground", "fit"});
  if (root.number("skyfit_preset") != kPresetVersion) {
    root.fail_value("skyfit_preset",
                    fmt::format("{}, the version this program reads", kPresetVersion));
  }
  Preset preset;
  preset.name = root.text("name");
  const PresetReader planet = root.object("planet");
  planet.expect_only({"bottom_radius_m", "top_radius_m"});
  preset.atmosphere.bottom_radius_m = planet.number("bottom_radius_m");
  preset.atmosphere.top_radius_m = planet.number("top_radius_m");
  preset.atmosphere.rayleigh = read_rayleigh(root.object("rayleigh"), tables);
  preset.atmosphere.mie = read_mie(root.object("mie"), tables);
  preset.atmosphere.ozone = read_ozone(root.object("ozone"), tables);
  const PresetReader ground = root.object("ground");
  ground.expect_only({"albedo", "spectrum"});
  preset.atmosphere.ground_albedo = ground.number("albedo");
  if (ground.has("spectrum")) {
    const PresetReader spectrum = ground.object("spectrum");
    if (spectrum.text("type") != kTabulated) spectrum.fail_value("type", kTabulated);
    preset.atmosphere.ground_spectrum = tables.read<GroundSpectrum>(spectrum, kGroundFormat);
  }
  if (root.has("fit")) preset.fit = root.object("fit").value();
  return preset;
}

ordered_json to_json(const PowerLaw<double>& law) {
  return {{"wavelength_nm", law.wavelength_nm}, {"value", law.value}, {"exponent", law.exponent}};
}

ordered_json to_json(const AerosolPhase<double>& phase) {
  const std::string_view type = name_of(phase.type, kPhaseTypes);
  if (phase.type == PhaseType::kTabulated) return table_to_json(phase.table->table(), kPhaseFormat);
  if (phase.type == PhaseType::kTwoLobe) {
    return {{"type", type},
            {"lobe", name_of(phase.lobe, kLobeTypes)},
            {"g1", phase.g1},
            {"g2", phase.g2},
            {"weight", phase.weight}};
  }
  return {{"type", type}, {"g", phase.g}};
}

template <class Species>
void add_profile(const Species& species, ordered_json& object) {
  if (species.profile) {
    object["profile"] = table_to_json(species.profile->table(), kProfileFormat);
  } else {
    object["profile"] = kExponential;
    object["scale_height_m"] = species.scale_height_m;
  }
}

ordered_json to_json(const Rayleigh<double>& rayleigh) {
  ordered_json object = {{"scattering_per_m", to_json(rayleigh.scattering_per_m)},
                         {"depolarisation", rayleigh.depolarisation}};
  if (rayleigh.site_pressure_hpa != kStandardPressureHpa)
    object["site_pressure_hpa"] = rayleigh.site_pressure_hpa;
  add_profile(rayleigh, object);
  return object;
}

ordered_json to_json(const Mie<double>& mie) {
  ordered_json object = {{"scattering_per_m", to_json(mie.scattering_per_m)},
                         {"single_scattering_albedo", mie.single_scattering_albedo}};
  add_profile(mie, object);
  object["phase"] = to_json(mie.phase);
  return object;
}

ordered_json to_json(const Ozone<double>& ozone) {
  ordered_json object = {{"column_du", ozone.column_du},
                         {"profile", name_of(ozone.profile, kOzoneProfiles)}};
  if (ozone.profile == OzoneProfile::kTabulated)
    object["profile"] = table_to_json(ozone.table->table(), kProfileFormat);
  return object;
}

}  // namespace

Preset parse_preset(std::string_view text, std::string_view source, const TableReader& reader) {
  const PresetDocument document(text, source);
  const PresetTables tables(std::filesystem::path(source).parent_path(), reader);
  Preset preset = read_preset(document.root(), tables);
  try {
    validate(preset.atmosphere);
  } catch (const std::invalid_argument& error) {
    // validate() starts with the path of the field.
    const std::string_view message = error.what();
    throw std::invalid_argument(
        fmt::format("{}: {}", document.place(message.substr(0, message.find(' '))), message));
  }
  return preset;
}

std::string preset_to_json(const Preset& preset) {
  const Atmosphere<double>& a = preset.atmosphere;
  validate(a);
  ordered_json root = {
      {"skyfit_preset", kPresetVersion},
      {"name", preset.name},
      {"planet", {{"bottom_radius_m", a.bottom_radius_m}, {"top_radius_m", a.top_radius_m}}},
      {"rayleigh", to_json(a.rayleigh)},
      {"mie", to_json(a.mie)},
      {"ozone", to_json(a.ozone)},
      {"ground", {{"albedo", a.ground_albedo}}}};
  if (a.ground_spectrum)
    root["ground"]["spectrum"] = table_to_json(a.ground_spectrum->table(), kGroundFormat);
  if (!preset.fit.is_null()) root["fit"] = preset.fit;
  // A name that is not UTF-8 is written with replacement characters.
  return root.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

Preset load_preset(const std::filesystem::path& file, const TableReader& reader) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream && stream.peek() != std::ifstream::traits_type::eof()) text << stream.rdbuf();
  if (!stream || text.view().empty()) {
    const bool empty = errno == 0;
    throw std::runtime_error(fmt::format("{}: cannot be read ({}), expected a preset",
                                         file.string(),
                                         empty ? "it is empty" : std::strerror(errno)));
  }
  return parse_preset(text.view(), file.string(), reader);
}

}  // namespace skyfit
