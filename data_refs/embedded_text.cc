// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <stdexcept>

#include "data_refs/embedded.h"

namespace skyfit::refs {

std::string_view embedded_text(std::string_view name) {
  for (const EmbeddedFile& file : embedded_files()) {
    if (file.name == name) return file.text;
  }
  throw std::out_of_range(fmt::format("{}: not compiled in", name));
}

}  // namespace skyfit::refs
