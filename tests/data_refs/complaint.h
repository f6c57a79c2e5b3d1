// SPDX-License-Identifier: Apache-2.0
// What a reader says against its input.
#pragma once

#include <exception>
#include <string>

namespace skyfit::refs {

// The message of what `read` throws, or "accepted".
template <class Read>
std::string complaint_of(Read read) {
  try {
    read();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace skyfit::refs
