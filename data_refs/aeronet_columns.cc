// SPDX-License-Identifier: Apache-2.0
#include "data_refs/aeronet_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>

#include "data_refs/csv.h"
#include "model/base/pattern.h"
#include "model/base/text.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kRadiance = "radiance_for";

// Without what stands in parentheses, such as a unit.
std::string_view without_unit(std::string_view name) { return name.substr(0, name.find('(')); }

bool is_of_radiance(std::string_view title) {
  static const std::regex pattern(R"(\s*(sky[ _]?)?radiance.*)");
  return whole_match(lower_case(title), pattern).has_value();
}

}  // namespace

std::string plain_name(std::string_view column) {
  std::string name = lower_case(column.substr(0, column.find('(')));
  std::erase_if(name, [](char c) { return c == '_' || c == ' ' || c == '-'; });
  return name;
}

bool names_columns(std::string_view line) {
  const std::string text = lower_case(line);
  return text.find("date(") != text.npos && text.find("time(") != text.npos &&
         text.find("wavelength") != text.npos && text.find("wavelengths_of_aod") == text.npos &&
         (text.find("solar_zenith_angle") != text.npos ||
          text.find("solarzenithangle") != text.npos);
}

std::optional<double> finite_number(std::string_view text) {
  const std::optional<double> number = csv_number(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<double> number_at_end(std::string_view name) {
  return finite_number(without_unit(name.substr(name.rfind('_') + 1)));
}

std::optional<ScanPath> path_named(std::string_view type) {
  std::string name = plain_name(type);
  for (const std::string_view polarised : {"polarized", "polarised"}) {
    if (name.starts_with(polarised)) name.erase(0, polarised.size());
  }
  if (name.starts_with("almucantar") || name == "alm" || name == "alp")
    return ScanPath::kAlmucantar;
  if (name.starts_with("principalplane") || name == "ppl" || name == "ppp")
    return ScanPath::kPrincipalPlane;
  return {};
}

std::optional<ScanPath> path_in_head(std::string_view head) {
  const std::size_t almucantar = head.find("almucantar"), plane = head.find("principal");
  if (almucantar == plane) return {};  // neither
  return almucantar < plane ? ScanPath::kAlmucantar : ScanPath::kPrincipalPlane;
}

bool names_scattering(std::string_view name) {
  return lower_case(name).find("scatter") != std::string::npos;
}

bool is_of_scattering(const std::string& column, const std::string& title) {
  return std::ranges::any_of(std::array{column, title}, [](const std::string& name) {
    return names_scattering(name) && !is_of_radiance(name);
  });
}

std::optional<double> angle_of(const std::string& column, const std::string& title, bool titled) {
  if (is_of_scattering(column, title)) return {};
  if (titled && !is_of_radiance(title)) return {};
  if (!lower_case(column).starts_with(kRadiance)) return finite_number(without_unit(column));
  return number_at_end(column);
}

std::string unit_in(std::string_view name) {
  const std::size_t open = name.find_first_of("([");
  if (open == name.npos || lower_case(name.substr(0, open)).find("radiance") == name.npos)
    return {};
  const std::size_t close = name.find_first_of(")]", open);
  return std::string(trim(name.substr(open + 1, close - open - 1)));
}

std::vector<std::string> group_titles(const std::vector<std::string>& fields, std::size_t columns) {
  constexpr std::size_t kFewestColumns = 6;
  std::vector<std::string> titles(columns);
  if (fields.size() < kFewestColumns || !fields.front().empty()) return titles;
  for (std::size_t i = 1; i < columns; ++i)
    titles[i] = i < fields.size() && !fields[i].empty() ? fields[i] : titles[i - 1];
  return titles;
}

}  // namespace skyfit::refs
