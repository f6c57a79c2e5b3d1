// SPDX-License-Identifier: Apache-2.0
// The renderer's tables of an atmosphere for other people's renderers: files, what their mappings
// need as JSON, and the shader functions that read them, as GLSL and as HLSL, made of
// render/shaders/sky_library.glsl. docs/tables.md says how to use them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "model/atmosphere/preset.h"
#include "model/tables/table_precision.h"
#include "render/color_space.h"
#include "render/engine/table_files.h"

namespace skyfit {

struct EngineTable {
  std::string_view name;     // of the texture in the shaders is NAME_table
  std::string_view meaning;  // what the texels hold, with the unit
  std::string_view axes;
  EncodedTable texels;
};

struct EngineTables {
  std::vector<EngineTable> tables;  // in the order of the shaders' texture units
  nlohmann::ordered_json parameters;
  std::string glsl, hlsl;
};

// `precision` is that of the tables of scattered light, kFloat or kHalf. Shaders return light in
// `primaries`: cd/m^2, lx.
EngineTables engine_tables(const Preset& preset, const AtmosphereTables& tables,
                           TablePrecision precision, Primaries primaries);

// All files that they may be, in any format: NAME.FORMAT of each table, tables.json, sky.glsl and
// sky.hlsl.
std::vector<std::string> engine_file_names();

// Into a directory that exists. Throws as the functions of table_files.h.
void write_engine_tables(const EngineTables& tables, const TableFormatEntry& format,
                         const std::filesystem::path& directory);

}  // namespace skyfit
