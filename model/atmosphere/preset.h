// SPDX-License-Identifier: Apache-2.0
// preset.json: the only thing that crosses from the fit to the renderer. Versions 1 and 2 are read,
// version 2 is written; docs/preset.md says what it holds.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "model/atmosphere/atmosphere.h"
#include "model/atmosphere/table_format.h"
#include "model/base/input_file.h"

namespace skyfit {

struct Preset {
  std::string name;
  Atmosphere<double> atmosphere;
  nlohmann::json fit;  // null, or what it was fitted to, version, RMS, sigmas, covariance
  std::string note{};  // for the reader, such as where the values come from; may be empty
};

// Parse and write. `reader` reads the CSVs that a preset names (refs::load_table_csv), relative to
// the folder of `source` and within it unless they may lie anywhere; without it they are refused.
// Unknown names, missing names, wrong types
// and unphysical values throw std::invalid_argument with one line `source: path.to.field = value:
// expected ...`; `source` is the file name that the message shows.
Preset parse_preset(std::string_view text, std::string_view source, const TableReader& reader = {},
                    NamedFiles named = NamedFiles::kInItsFolder);
std::string preset_to_json(const Preset& preset);

// Throws std::runtime_error when the file cannot be read.
Preset load_preset(const std::filesystem::path& file, const TableReader& reader = {},
                   NamedFiles named = NamedFiles::kInItsFolder);

}  // namespace skyfit
