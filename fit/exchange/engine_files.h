// SPDX-License-Identifier: Apache-2.0
// The files of the engines of engines.cc. Their public sources are named in each .cc.
#pragma once

#include "fit/exchange/engines.h"
#include "model/base/preset_reader.h"

namespace skyfit::fit {

std::string unreal_text(const EngineAtmosphere& engine, const ExportFacts& facts);
std::optional<EngineAtmosphere> read_unreal(std::string_view text, std::string_view source,
                                            std::vector<std::string>& notes);

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

void restrict_to_threejs(EngineAtmosphere& engine);
std::string threejs_text(const EngineAtmosphere& engine, const ExportFacts& facts);
std::optional<EngineAtmosphere> read_threejs(std::string_view text, std::string_view source,
                                             std::vector<std::string>& notes);

// Of a field of an object, or a default where it has none; throws as PresetReader does, and unless
// the numbers are finite and >= 0.
double number_or(const PresetReader& object, std::string_view field, double if_none);
Rgb rgb_or(const PresetReader& object, std::string_view field, const Rgb& if_none);

// The number behind `name =` or `name:` in a text; nothing where it is not there.
std::optional<double> assigned_number(std::string_view text, std::string_view name);

}  // namespace skyfit::fit
