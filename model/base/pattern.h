// SPDX-License-Identifier: Apache-2.0
// Regular expressions on text that others wrote. std::regex of libstdc++ calls itself for every
// character that a repetition takes in, and some 30 000 of them end the program: longer text than
// kMostMatched characters is taken for no match.
#pragma once

#include <optional>
#include <regex>
#include <string_view>

namespace skyfit {

inline constexpr std::size_t kMostMatched = 4000;

// Of the whole text. Its parts point into the text.
std::optional<std::cmatch> whole_match(std::string_view text, const std::regex& pattern);

// Of the first part of the text that matches.
std::optional<std::cmatch> first_match(std::string_view text, const std::regex& pattern);

}  // namespace skyfit
