// SPDX-License-Identifier: Apache-2.0
// The files of the engines of engines.cc. Their public sources are named in each .cc.
#pragma once

#include "fit/exchange/engines.h"
#include "model/base/preset_reader.h"

namespace skyfit::fit {

std::string unreal_text(const EngineAtmosphere& engine, const ExportFacts& facts);
std::optional<EngineAtmosphere> read_unreal(std::string_view text, std::string_view source,
                                            std::vector<std::string>& notes);

void restrict_to_unity(EngineAtmosphere& engine);
std::string unity_text(const EngineAtmosphere& engine, const ExportFacts& facts);
std::optional<EngineAtmosphere> read_unity(std::string_view text, std::string_view source,
                                           std::vector<std::string>& notes);

std::string bruneton_text(const EngineAtmosphere& engine, const ExportFacts& facts);
std::optional<EngineAtmosphere> read_bruneton(std::string_view text, std::string_view source,
                                              std::vector<std::string>& notes);

void restrict_to_blender(EngineAtmosphere& engine);
std::string blender_text(const EngineAtmosphere& engine, const ExportFacts& facts);
std::optional<EngineAtmosphere> read_blender(std::string_view text, std::string_view source,
                                             std::vector<std::string>& notes);
void restrict_to_blender_multiple(EngineAtmosphere& engine);
std::string blender_multiple_text(const EngineAtmosphere& engine, const ExportFacts& facts);
std::optional<EngineAtmosphere> read_blender_multiple(std::string_view text,
                                                      std::string_view source,
                                                      std::vector<std::string>& notes);

// Of a field of an object, or a default where it has none; throws as PresetReader does, and unless
// the numbers are finite and >= 0.
double number_or(const PresetReader& object, std::string_view field, double if_none);
Rgb rgb_or(const PresetReader& object, std::string_view field, const Rgb& if_none);

// A script and how its comments begin.
struct Script {
  std::string_view text, source, comment;
};

// Whether the name is assigned anywhere in the script, comments not counted.
bool is_assigned(const Script& script, std::string_view name);

// What the last line assigns; empty where there is none.
std::string assigned_text(const Script& script, std::string_view name);

// The number that the last line `.. name .. = number` assigns. Throws std::invalid_argument
// `source:line: name = text: expected a number from 0 to ..` where it is not one, and where the
// name is missing, unless there is an `if_none`.
double assigned_number(const Script& script, std::string_view name, double highest,
                       std::optional<double> if_none = {});

}  // namespace skyfit::fit
