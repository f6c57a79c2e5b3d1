// SPDX-License-Identifier: Apache-2.0
#include "model/preset.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "model/preset_reader.h"

namespace skyfit {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr int kPresetVersion = 1;

template <class Enum>
struct Named {
  std::string_view name;
  Enum value;
};
constexpr std::array<Named<PhaseType>, 3> kPhaseTypes = {
    {{"cornette-shanks", PhaseType::kCornetteShanks},
     {"henyey-greenstein", PhaseType::kHenyeyGreenstein},
     {"two-lobe", PhaseType::kTwoLobe}}};
constexpr std::array<Named<OzoneProfile>, 2> kOzoneProfiles = {
    {{"tent", OzoneProfile::kTent}, {"exponential", OzoneProfile::kExponential}}};

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

Rayleigh<double> read_rayleigh(const PresetReader& object) {
  object.expect_only({"scattering_per_m", "scale_height_m"});
  return {read_power_law(object), object.number("scale_height_m")};
}

AerosolPhase<double> read_phase(const PresetReader& object) {
  AerosolPhase<double> phase;
  phase.type = read_choice(object, "type", kPhaseTypes);
  if (phase.type == PhaseType::kTwoLobe) {
    object.expect_only({"type", "g1", "g2", "weight"});
    phase.g1 = object.number("g1");
    phase.g2 = object.number("g2");
    phase.weight = object.number("weight");
  } else {
    object.expect_only({"type", "g"});
    phase.g = object.number("g");
  }
  return phase;
}

Mie<double> read_mie(const PresetReader& object) {
  object.expect_only({"scattering_per_m", "single_scattering_albedo", "scale_height_m", "phase"});
  return {read_power_law(object), object.number("single_scattering_albedo"),
          object.number("scale_height_m"), read_phase(object.object("phase"))};
}

Ozone<double> read_ozone(const PresetReader& object) {
  object.expect_only({"column_du", "profile"});
  return {object.number("column_du"), read_choice(object, "profile", kOzoneProfiles)};
}

Preset read_preset(const PresetReader& root) {
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
  preset.atmosphere.rayleigh = read_rayleigh(root.object("rayleigh"));
  preset.atmosphere.mie = read_mie(root.object("mie"));
  preset.atmosphere.ozone = read_ozone(root.object("ozone"));
  const PresetReader ground = root.object("ground");
  ground.expect_only({"albedo"});
  preset.atmosphere.ground_albedo = ground.number("albedo");
  if (root.has("fit")) preset.fit = root.object("fit").value();
  return preset;
}

ordered_json to_json(const PowerLaw<double>& law) {
  return {{"wavelength_nm", law.wavelength_nm}, {"value", law.value}, {"exponent", law.exponent}};
}

ordered_json to_json(const AerosolPhase<double>& phase) {
  const std::string_view type = name_of(phase.type, kPhaseTypes);
  if (phase.type == PhaseType::kTwoLobe) {
    return {{"type", type}, {"g1", phase.g1}, {"g2", phase.g2}, {"weight", phase.weight}};
  }
  return {{"type", type}, {"g", phase.g}};
}

}  // namespace

Preset parse_preset(std::string_view text, std::string_view source) {
  const PresetDocument document(text, source);
  Preset preset = read_preset(document.root());
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
      {"rayleigh",
       {{"scattering_per_m", to_json(a.rayleigh.scattering_per_m)},
        {"scale_height_m", a.rayleigh.scale_height_m}}},
      {"mie",
       {{"scattering_per_m", to_json(a.mie.scattering_per_m)},
        {"single_scattering_albedo", a.mie.single_scattering_albedo},
        {"scale_height_m", a.mie.scale_height_m},
        {"phase", to_json(a.mie.phase)}}},
      {"ozone",
       {{"column_du", a.ozone.column_du}, {"profile", name_of(a.ozone.profile, kOzoneProfiles)}}},
      {"ground", {{"albedo", a.ground_albedo}}}};
  if (!preset.fit.is_null()) root["fit"] = preset.fit;
  // A name that is not UTF-8 is written with replacement characters.
  return root.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

Preset load_preset(const std::filesystem::path& file) {
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
  return parse_preset(text.view(), file.string());
}

}  // namespace skyfit
