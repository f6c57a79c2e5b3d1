// SPDX-License-Identifier: Apache-2.0
#include "data_refs/units.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "model/base/pattern.h"

namespace skyfit::refs {
namespace {

constexpr auto kSpectral = Quantity::kSpectralRadiance;
constexpr std::array kUnits = {
    Unit{"W m-2 sr-1 nm-1", kSpectral, 1},      Unit{"mW m-2 sr-1 nm-1", kSpectral, 1e-3},
    Unit{"W m-2 sr-1 um-1", kSpectral, 1e-3},   Unit{"uW cm-2 sr-1 nm-1", kSpectral, 1e-2},
    Unit{"mW cm-2 sr-1 um-1", kSpectral, 1e-2}, Unit{"cd m-2", Quantity::kLuminance, 1},
    Unit{"kcd m-2", Quantity::kLuminance, 1e3}, Unit{"relative", Quantity::kRelativeLuminance, 1}};

// What is written otherwise: the micro sign and the Greek letter, superscripts, a slash the wrong
// way round.
constexpr std::pair<std::string_view, std::string_view> kSpellings[] = {
    {"\u00b5", "u"}, {"\u03bc", "u"}, {"\u00b2", "^2"}, {"\u207b", "^-"}, {"^-^", "^-"},
    {"\u00b9", "1"}, {"\\", "/"},     {"\u00b7", " "},  {"**", "^"}};

using Exponents = std::map<std::string, int>;

// "W/(m^2 sr)" is W: 1, m: -2, sr: -1; nothing when the text is no product of powers.
std::optional<Exponents> exponents(std::string_view text) {
  if (text.size() > kMostMatched) return {};
  static const std::regex factor(R"(([A-Za-z]+)(?:\^?(-?\d))?)");
  Exponents result;
  int sign = 1;
  bool in_parentheses = false;
  while (!text.empty()) {
    std::cmatch match;
    if (std::regex_search(text.begin(), text.end(), match, factor,
                          std::regex_constants::match_continuous)) {
      result[match[1]] += sign * (match[2].matched ? std::stoi(match[2]) : 1);
      text.remove_prefix(static_cast<std::size_t>(match.length()));
      if (!in_parentheses) sign = 1;
      continue;
    }
    switch (text.front()) {
      case ' ':
      case '*':
        break;
      case '/':
        sign = -1;
        break;
      case '(':
        in_parentheses = true;
        break;
      case ')':
        in_parentheses = false;
        sign = 1;
        break;
      default:
        return {};
    }
    text.remove_prefix(1);
  }
  return result;
}

}  // namespace

std::span<const Unit> units() { return kUnits; }

std::string unit_names(std::initializer_list<Quantity> quantities) {
  std::vector<std::string_view> names;
  for (const Unit& unit : kUnits) {
    if (quantities.size() == 0 || std::ranges::count(quantities, unit.quantity) > 0)
      names.push_back(unit.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::optional<Unit> find_unit(std::string_view text) {
  std::string plain(text);
  for (const auto& [spelling, ours] : kSpellings) {
    for (std::size_t at = plain.find(spelling); at != plain.npos; at = plain.find(spelling))
      plain.replace(at, spelling.size(), ours);
  }
  const std::optional<Exponents> wanted = exponents(plain);
  if (!wanted) return {};
  const auto unit = std::ranges::find_if(
      kUnits, [&](const Unit& candidate) { return exponents(candidate.name) == wanted; });
  return unit == kUnits.end() ? std::nullopt : std::optional<Unit>(*unit);
}

std::string_view quantity_name(Quantity quantity) {
  switch (quantity) {
    case Quantity::kLuminance:
      return "luminance";
    case Quantity::kRelativeLuminance:
      return "relative luminance";
    case Quantity::kSpectralRadiance:
      return "spectral radiance";
    case Quantity::kIlluminance:
      return "illuminance";
    case Quantity::kIrradiance:
      return "irradiance";
  }
  return {};
}

}  // namespace skyfit::refs
