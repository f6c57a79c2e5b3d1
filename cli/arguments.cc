// SPDX-License-Identifier: Apache-2.0
#include "cli/arguments.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <optional>

#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::cli {
namespace {

constexpr double kGridTolerance = 1e-6;  // of a step; decimal steps are not exact in binary
constexpr std::string_view kListForm = "expected a,b,c or start:stop:step with finite numbers";

std::optional<double> finite_number(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::vector<double> range(std::string_view option, std::string_view text, double start, double stop,
                          double step) {
  if (step == 0) throw UsageError(option, text, "expected a step that is not zero");
  const double steps = (stop - start) / step;
  if (steps < 0)
    throw UsageError(option, text,
                     "expected a step that leads from start to stop, its sign is wrong");
  if (!(steps < kMaxListValues)) {
    throw UsageError(option, text, fmt::format("expected at most {} values", kMaxListValues));
  }
  const auto last = static_cast<std::size_t>(std::floor(steps + kGridTolerance));
  std::vector<double> values(last + 1);
  for (std::size_t i = 0; i <= last; ++i) values[i] = start + static_cast<double>(i) * step;
  if (last > 0 && std::abs(steps - static_cast<double>(last)) <= kGridTolerance)
    values.back() = stop;
  return values;
}

// Splits `name=rest`; the parameter must exist.
std::pair<Parameter, std::string_view> named(std::string_view option, std::string_view text,
                                             std::string_view form) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) throw UsageError(option, text, form);
  return {parse_parameters(option, trim(text.substr(0, equals))).front(), text.substr(equals + 1)};
}

// `name=first:second`, each text one or several separated by commas. `add` says whether the name is
// new, or nothing where the numbers do not go together.
void parse_pairs(std::string_view option, const std::vector<std::string>& texts,
                 std::string_view form,
                 const std::function<std::optional<bool>(const Parameter&, double, double)>& add) {
  for (const std::string& text : texts) {
    for (const std::string_view item : split(text, ',')) {
      const auto [parameter, rest] = named(option, item, form);
      const std::size_t colon = rest.find(':');
      if (colon == std::string_view::npos) throw UsageError(option, item, form);
      const auto first = finite_number(rest.substr(0, colon));
      const auto second = finite_number(rest.substr(colon + 1));
      if (!first || !second) throw UsageError(option, item, form);
      const std::optional<bool> is_new = add(parameter, *first, *second);
      if (!is_new) throw UsageError(option, item, form);
      if (!*is_new) throw UsageError(option, item, "expected each name once");
    }
  }
}

}  // namespace

UsageError::UsageError(std::string_view option, std::string_view text, std::string_view expected)
    : std::invalid_argument(fmt::format("{} \"{}\": {}", option, text, expected)),
      option_(option),
      expected_(expected) {}

UsageError::UsageError(std::string_view option, std::string_view expected)
    : std::invalid_argument(fmt::format("{}: {}", option, expected)),
      option_(option),
      expected_(expected) {}

double parse_number(std::string_view option, std::string_view text) {
  const auto value = finite_number(text);
  if (!value) throw UsageError(option, text, "expected a finite number");
  return *value;
}

std::vector<double> parse_list(std::string_view option, std::string_view text) {
  const bool is_range = text.find(':') != std::string_view::npos;
  std::vector<double> values;
  for (const std::string_view part : split(text, is_range ? ':' : ',')) {
    const auto value = finite_number(part);
    if (!value) throw UsageError(option, text, kListForm);
    values.push_back(*value);
  }
  if (is_range && values.size() != 3) throw UsageError(option, text, kListForm);
  if (is_range) values = range(option, text, values[0], values[1], values[2]);
  if (values.size() > kMaxListValues) {
    throw UsageError(option, text.substr(0, 20),
                     fmt::format("expected at most {} values", kMaxListValues));
  }
  return values;
}

std::vector<double> parse_list_within(std::string_view option, std::string_view text, double lower,
                                      double upper, std::string_view meaning) {
  std::vector<double> values = parse_list(option, text);
  for (const double value : values) {
    if (value >= lower && value <= upper) continue;
    throw UsageError(
        option, text,
        fmt::format("{:.9g}: expected {} from {:.9g} to {:.9g}", value, meaning, lower, upper));
  }
  return values;
}

double parse_number_within(std::string_view option, std::string_view text, double lower,
                           double upper, std::string_view meaning) {
  const auto values = parse_list_within(option, text, lower, upper, meaning);
  if (values.size() != 1) throw UsageError(option, text, fmt::format("expected {}", meaning));
  return values.front();
}

double parse_angle(std::string_view option, std::string_view text, double lower, double upper) {
  const auto values = parse_list_within(option, text, lower, upper, "an angle in degrees");
  if (values.size() != 1) throw UsageError(option, text, "expected one angle in degrees");
  return radians(values.front());
}

std::vector<double> parse_tuple(std::string_view option, std::string_view text, std::size_t least,
                                std::size_t most, std::string_view form) {
  std::vector<double> values;
  for (const std::string_view part : split(text, ',')) {
    const auto value = finite_number(part);
    if (!value) throw UsageError(option, text, fmt::format("expected {}", form));
    values.push_back(*value);
  }
  if (values.size() < least || values.size() > most)
    throw UsageError(option, text, fmt::format("expected {}", form));
  return values;
}

std::pair<std::string, std::string> parse_ends(std::string_view option, std::string_view text,
                                               std::string_view form) {
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos)
    throw UsageError(option, text, fmt::format("expected {}", form));
  return {std::string(text.substr(0, dots)), std::string(text.substr(dots + 2))};
}

ImageSize parse_image_size(std::string_view option, std::string_view text) {
  const std::string form =
      fmt::format("expected WIDTHxHEIGHT in pixels, each from 1 to {}, at most {} pixels together",
                  kMaxImageSide, kMaxImagePixels);
  const auto sides = split(text, 'x');
  if (sides.size() != 2) throw UsageError(option, text, form);
  std::array<int, 2> side{};
  for (int i = 0; i < 2; ++i) {
    const char* const end = sides[i].data() + sides[i].size();
    const auto [parsed, error] = std::from_chars(sides[i].data(), end, side[i]);
    if (error != std::errc() || parsed != end || side[i] < 1 || side[i] > kMaxImageSide) {
      throw UsageError(option, text, form);
    }
  }
  if (static_cast<long>(side[0]) * side[1] > kMaxImagePixels) throw UsageError(option, text, form);
  return {side[0], side[1]};
}

std::vector<Parameter> parse_parameters(std::string_view option, std::string_view text) {
  std::vector<Parameter> parameters;
  for (const std::string_view name : split(text, ',')) {
    if (trim(name).empty()) throw UsageError(option, text, "expected names of parameters");
    try {
      parameters.push_back(parameter_from_name(trim(name)));
    } catch (const std::invalid_argument& error) {
      throw UsageError(option, text, error.what());
    }
  }
  return parameters;
}

std::map<Parameter, double> parse_fixed(std::string_view option,
                                        const std::vector<std::string>& texts) {
  std::map<Parameter, double> fixed;
  for (const std::string& text : texts) {
    for (const std::string_view item : split(text, ',')) {
      const auto [parameter, rest] = named(option, item, "expected name=value");
      const auto value = finite_number(rest);
      if (!value) throw UsageError(option, item, "expected name=value with a finite number");
      if (!fixed.emplace(parameter, *value).second)
        throw UsageError(option, item, "expected each name once");
    }
  }
  return fixed;
}

std::map<Parameter, Prior> parse_priors(std::string_view option,
                                        const std::vector<std::string>& texts) {
  std::map<Parameter, Prior> priors;
  parse_pairs(option, texts, "expected name=mean:sigma with finite numbers, sigma > 0",
              [&](const Parameter& parameter, double mean, double sigma) {
                return sigma > 0
                           ? std::optional(priors.emplace(parameter, Prior{mean, sigma}).second)
                           : std::nullopt;
              });
  return priors;
}

std::map<Parameter, Bounds> parse_bounds(std::string_view option,
                                         const std::vector<std::string>& texts) {
  std::map<Parameter, Bounds> bounds;
  parse_pairs(option, texts, "expected name=lower:upper with finite numbers, lower < upper",
              [&](const Parameter& parameter, double lower, double upper) {
                return lower < upper
                           ? std::optional(bounds.emplace(parameter, Bounds{lower, upper}).second)
                           : std::nullopt;
              });
  return bounds;
}

double radians(double degrees) { return degrees * kRadiansPerDegree; }
double degrees(double radians) { return radians * kDegreesPerRadian; }
double whole_degrees(double radians) {
  constexpr double kDigits = 1e10;
  return std::round(degrees(radians) * kDigits) / kDigits;
}

}  // namespace skyfit::cli
