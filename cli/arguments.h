// SPDX-License-Identifier: Apache-2.0
// What the options of the command line mean. Every function throws UsageError with one line that
// names the option, the text and what was expected, such as `--size "0x10": expected WIDTHxHEIGHT,
// each from 1 to 16384`.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/atmosphere/parameters.h"

namespace skyfit::cli {

class UsageError : public std::invalid_argument {
 public:
  UsageError(std::string_view option, std::string_view text, std::string_view expected);
  UsageError(std::string_view option, std::string_view expected);  // of one without a value

  const std::string& option() const { return option_; }
  const std::string& expected() const { return expected_; }

 private:
  std::string option_, expected_;
};

// A line per row of a registry, its name and its meaning, for help texts.
template <class Rows>
std::string named_lines(const Rows& rows) {
  std::size_t longest = 0;
  for (const auto& row : rows) longest = std::max(longest, row.name.size());
  std::string text;
  for (const auto& row : rows)
    text += fmt::format("  {:<{}}{}\n", row.name, longest + 2, row.meaning);
  return text;
}

inline constexpr std::size_t kMaxListValues = 1'000'000;

// A finite decimal number and nothing else.
double parse_number(std::string_view option, std::string_view text);

// `a,b,c` or `start:stop:step`; stop is part of the list when it lies on the grid (within a
// millionth of a step), and is then exact. Order and repetition are kept.
std::vector<double> parse_list(std::string_view option, std::string_view text);

// A list whose values lie in lower..upper, both included.
std::vector<double> parse_list_within(std::string_view option, std::string_view text, double lower,
                                      double upper, std::string_view meaning);

// One number, within lower..upper.
double parse_number_within(std::string_view option, std::string_view text, double lower,
                           double upper, std::string_view meaning);

// One angle in degrees within lower..upper; radians.
double parse_angle(std::string_view option, std::string_view text, double lower, double upper);

// `a,b,c`: from `least` to `most` numbers, whose meaning `form` shows.
std::vector<double> parse_tuple(std::string_view option, std::string_view text, std::size_t least,
                                std::size_t most, std::string_view form);

// `low..high`; both as they stand.
std::pair<std::string, std::string> parse_ends(std::string_view option, std::string_view text,
                                               std::string_view form);

struct ImageSize {
  int width = 0, height = 0;
};
inline constexpr int kMaxImageSide = 16384;       // what a texture of the renderer can hold
inline constexpr long kMaxImagePixels = 1 << 26;  // 64 Mpixel, 4 GB of render targets
ImageSize parse_image_size(std::string_view option, std::string_view text);

// `name,name`
std::vector<Parameter> parse_parameters(std::string_view option, std::string_view text);
// `name=value`, each text one or several separated by commas.
std::map<Parameter, double> parse_fixed(std::string_view option,
                                        const std::vector<std::string>& texts);
// `name=mean:sigma`, each text one or several separated by commas.
std::map<Parameter, Prior> parse_priors(std::string_view option,
                                        const std::vector<std::string>& texts);

// `name=lower:upper`, each text one or several separated by commas.
std::map<Parameter, Bounds> parse_bounds(std::string_view option,
                                         const std::vector<std::string>& texts);

double radians(double degrees);
double degrees(double radians);
// Sheds the noise of the way through radians: 5 degrees read 5 again, not 5.000000000000001.
double whole_degrees(double radians);

}  // namespace skyfit::cli
