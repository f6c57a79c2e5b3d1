// SPDX-License-Identifier: Apache-2.0
// Small pieces of text: how they are cut, and how text that others wrote may be shown.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit {

// The text without spaces, tabs, carriage returns and newlines at either end.
std::string_view trim(std::string_view text);

// The parts between the separators: always one more than there are separators.
std::vector<std::string_view> split(std::string_view text, char separator);

// With a to z in the place of A to Z.
std::string lower_case(std::string_view text);

// The text on one line, in valid UTF-8 and without anything that steers a terminal or hides other
// text: newlines and tabs become spaces; other control characters, bytes that are no UTF-8 and the
// marks that turn the direction of writing become '?'.
std::string printable(std::string_view text);

// At most this many characters of foreign text stand in a message.
inline constexpr std::size_t kMostShown = 80;

// printable(text), cut after kMostShown characters, where "..." says so.
std::string excerpt(std::string_view text);

// A field of a CSV file, in quotes where it has to be (RFC 4180).
std::string csv_field(const std::string& text);

// excerpt(text) between double quotes; std::quoted() is another thing.
std::string in_quotes(std::string_view text);

}  // namespace skyfit
