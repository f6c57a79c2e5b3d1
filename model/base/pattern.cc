// SPDX-License-Identifier: Apache-2.0
#include "model/base/pattern.h"

namespace skyfit {

std::optional<std::cmatch> whole_match(std::string_view text, const std::regex& pattern) {
  std::cmatch match;
  if (text.size() > kMostMatched ||
      !std::regex_match(text.data(), text.data() + text.size(), match, pattern))
    return std::nullopt;
  return match;
}

std::optional<std::cmatch> first_match(std::string_view text, const std::regex& pattern) {
  std::cmatch match;
  if (text.size() > kMostMatched ||
      !std::regex_search(text.data(), text.data() + text.size(), match, pattern))
    return std::nullopt;
  return match;
}

}  // namespace skyfit
