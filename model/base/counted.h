// SPDX-License-Identifier: Apache-2.0
// A number of things in a sentence.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace skyfit {

// "1 scan", "3 scans".
inline std::string counted(std::ptrdiff_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

}  // namespace skyfit
