// SPDX-License-Identifier: Apache-2.0
// Validation against the part of JSON Schema (draft 2020-12) that data_refs/preset.schema.json
// uses.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace skyfit::refs {

// Whether `value` is valid under `schema`; `root` holds what "$ref" names. Throws
// std::invalid_argument at a keyword that this does not know, so that none is passed over.
bool is_valid(const nlohmann::json& value, const nlohmann::json& schema,
              const nlohmann::json& root);

}  // namespace skyfit::refs
