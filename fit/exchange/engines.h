// SPDX-License-Identifier: Apache-2.0
// Other people's programs that take an atmosphere of EngineAtmosphere's form as parameters: one row
// each. programs.h lists them with all others.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fit/exchange/engine_form.h"
#include "model/atmosphere/parameters.h"

namespace skyfit::fit {

// What a file says beside the atmosphere.
struct ExportFacts {
  std::string preset, loss;
  double sun_zenith = 0, sun_azimuth = 0;  // radians, azimuth clockwise from north
  Star star;
};

struct Engine {
  std::string_view name, meaning;
  std::string_view extension;
  PhaseType lobe;
  // What the engine fixes is set; the rest stays.
  void (*restrict_to)(EngineAtmosphere& engine);
  std::vector<Parameter> (*free)();  // that it leaves open
  std::string (*write)(const EngineAtmosphere& engine, const ExportFacts& facts);
  bool has_textures;  // those of bruneton_textures.h
  // Nothing when the text is another program's. Throws std::invalid_argument in one line that names
  // source, field, value and expectation. `notes`: what it says that an atmosphere does not hold.
  std::optional<EngineAtmosphere> (*read)(std::string_view text, std::string_view source,
                                          std::vector<std::string>& notes);
};

std::span<const Engine> engines();

// Throws std::logic_error where there is none of that name.
const Engine& engine_named(std::string_view name);

}  // namespace skyfit::fit
