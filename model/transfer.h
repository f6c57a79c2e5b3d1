// SPDX-License-Identifier: Apache-2.0
// Which radiative transfer a model solves and a reference was computed with.
#pragma once

#include <string_view>

namespace skyfit {

// Of light with its polarisation (Stokes vectors), or as if light had none.
enum class Transfer { kVector, kScalar };

// As presets and reports write it.
constexpr std::string_view transfer_name(Transfer transfer) {
  return transfer == Transfer::kVector ? "vector" : "scalar";
}

}  // namespace skyfit
