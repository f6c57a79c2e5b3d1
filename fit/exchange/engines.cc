// SPDX-License-Identifier: Apache-2.0
#include "fit/exchange/engines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <stdexcept>

#include "fit/exchange/engine_files.h"
#include "model/base/pattern.h"
#include "model/base/text.h"

namespace skyfit::fit {
namespace {

std::vector<Parameter> aerosol() {
  return {Parameter::kMieScattering, Parameter::kMieAngstromExponent, Parameter::kMiePhaseG,
          Parameter::kMieScaleHeight};
}

std::vector<Parameter> grey_aerosol() {
  return {Parameter::kMieScattering, Parameter::kMiePhaseG, Parameter::kMieScaleHeight};
}

std::vector<Parameter> amounts() {
  return {Parameter::kRayleighScattering, Parameter::kMieScattering};
}

constexpr PhaseType kHg = PhaseType::kHenyeyGreenstein, kCs = PhaseType::kCornetteShanks;

constexpr std::array<Engine, 5> kEngines = {{
    {"unreal", "Unreal Engine, component SkyAtmosphere (JSON of its properties)", ".json", kHg,
     [](EngineAtmosphere&) {}, aerosol, unreal_text, false, read_unreal},
    {"unity", "Unity HDRP, Physically Based Sky (JSON of its properties)", ".json", kCs,
     restrict_to_unity, grey_aerosol, unity_text, false, read_unity},
    {"bruneton", "Bruneton 2017, atmosphere among the arguments of Model (JSON)", ".json", kCs,
     [](EngineAtmosphere&) {}, aerosol, bruneton_text, true, read_bruneton},
    {"blender", "Blender, sky texture node, single scattering or Nishita (Python)", ".py", kCs,
     restrict_to_blender, amounts, blender_text, false, read_blender},
    {"blender-multiple", "Blender 5, sky texture node, multiple scattering (Python)", ".py", kHg,
     restrict_to_blender_multiple, amounts, blender_multiple_text, false, read_blender_multiple},
}};

}  // namespace

std::span<const Engine> engines() { return kEngines; }

const Engine& engine_named(std::string_view name) {
  const auto found = std::ranges::find(kEngines, name, &Engine::name);
  if (found == kEngines.end()) throw std::logic_error(fmt::format("no engine {}", name));
  return *found;
}

double number_or(const PresetReader& object, std::string_view field, double if_none) {
  if (!object.has(field)) return if_none;
  const double value = object.number(field);
  if (!std::isfinite(value) || value < 0) object.fail_value(field, "a number >= 0");
  return value;
}

Rgb rgb_or(const PresetReader& object, std::string_view field, const Rgb& if_none) {
  if (!object.has(field)) return if_none;
  const std::vector<double> values = object.numbers(field);
  if (values.size() != 3) object.fail_value(field, "three numbers");
  for (const double value : values) {
    if (!std::isfinite(value) || value < 0) object.fail_value(field, "numbers >= 0");
  }
  return {values[0], values[1], values[2]};
}

namespace {

struct Assignment {
  int line = 0;  // 0: none
  std::string value;
};

// The last one; a program would use it.
Assignment last_assignment(const Script& script, std::string_view name) {
  // What stands before the name is a path to it, what stands behind it may be .value.
  const std::regex pattern("(^|[^A-Za-z0-9_])" + std::string(name) +
                           R"(["'\]\s]*(\.value)?\s*[=:]\s*([^=;,}]*))");
  Assignment found;
  int line = 0;
  for (std::string_view row : split(script.text, '\n')) {
    ++line;
    row = row.substr(0, row.find(script.comment));
    const auto match = first_match(row, pattern);
    if (!match) continue;
    const std::string value(trim((*match)[3].str()));
    // `name = settings.name` refers to a line that has the value.
    if (!value.ends_with(fmt::format(".{}", name))) found = {line, value};
  }
  return found;
}

}  // namespace

bool is_assigned(const Script& script, std::string_view name) {
  return last_assignment(script, name).line > 0;
}

std::string assigned_text(const Script& script, std::string_view name) {
  return last_assignment(script, name).value;
}

double assigned_number(const Script& script, std::string_view name, double highest,
                       std::optional<double> if_none) {
  const Assignment found = last_assignment(script, name);
  if (found.line == 0 && if_none) return *if_none;
  if (found.line == 0) {
    throw std::invalid_argument(fmt::format("{}: {}: not there, expected a number from 0 to {:g}",
                                            script.source, name, highest));
  }
  char* end = nullptr;
  const double value = std::strtod(found.value.c_str(), &end);
  if (found.value.empty() || *end != '\0' || !(value >= 0 && value <= highest)) {
    throw std::invalid_argument(fmt::format("{}:{}: {} = {}: expected a number from 0 to {:g}",
                                            script.source, found.line, name, printable(found.value),
                                            highest));
  }
  return value;
}

}  // namespace skyfit::fit
