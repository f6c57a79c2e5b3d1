// SPDX-License-Identifier: Apache-2.0
// Files that people have beside measured skies, and that are none.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace skyfit::refs {

// What a text is, where it is known to be no sky: "is .., skyfit reads ..". Nothing else is tested
// than the marks of those formats.
std::optional<std::string> other_format(std::string_view text);

}  // namespace skyfit::refs
