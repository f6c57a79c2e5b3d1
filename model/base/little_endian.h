// SPDX-License-Identifier: Apache-2.0
// Numbers as the bytes of little-endian files.
#pragma once

#include <bit>
#include <string>

namespace skyfit {

static_assert(std::endian::native == std::endian::little);

template <class... Numbers>
void append_numbers(std::string& bytes, Numbers... numbers) {
  const auto one = [&](auto number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  (one(numbers), ...);
}

}  // namespace skyfit
