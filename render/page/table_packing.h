// SPDX-License-Identifier: Apache-2.0
// Look-up tables as text within a page, which tables.js decodes: values in even steps, each as its
// difference from what its neighbours predict, the bytes compressed (RFC 1951, raw deflate, which
// browsers read) and written in base64 (RFC 4648).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "model/tables/tables.h"

namespace skyfit {

// What the text holds: the values, or their natural logarithms (of values above 0; those at or
// below `least` become `least`).
struct Packing {
  double step = 1.0 / 256;  // of what is held; half of it is the largest error
  bool logarithm = false;
  double least = 0;  // with `logarithm` only
  int row = 0;       // texels of x that neighbour each other; 0: the whole width
};

// {width, height, depth, row, step, offset, logarithm, texels}. Throws std::runtime_error where the
// values span more than 65535 steps.
nlohmann::json packed(const Table& table, const Packing& packing);

// The table as the page has it after decoding, but for what its textures (16 bit floats) round.
Table as_decoded(const Table& table, const Packing& packing);

std::string base64(std::string_view bytes);

}  // namespace skyfit
