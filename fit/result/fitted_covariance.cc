// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fit/result/record.h"
#include "model/base/preset_reader.h"

namespace skyfit::fit {
namespace {

using nlohmann::json;

[[noreturn]] void fail_covariance(std::string_view source, std::string_view what) {
  throw std::invalid_argument(fmt::format("{}: fit.covariance{}", source, what));
}

std::vector<Parameter> read_parameters(const json& names, const Atmosphere<double>& atmosphere,
                                       std::string_view source) {
  std::vector<Parameter> parameters;
  for (const json& name : names) {
    const std::string text = name.is_string() ? name.get<std::string>() : json_excerpt(name);
    const auto fail = [&](std::string_view expected) {
      fail_covariance(source, fmt::format(".parameters: {}: {}", text, expected));
    };
    const Parameter parameter = [&] {
      try {
        return parameter_from_name(text);
      } catch (const std::invalid_argument& error) {
        fail_covariance(source, fmt::format(".parameters: {}", error.what()));
      }
    }();
    if (!has_parameter(atmosphere, parameter)) fail("expected a parameter that the preset has");
    if (std::ranges::count(parameters, parameter) > 0) fail("expected each name once");
    parameters.push_back(parameter);
  }
  return parameters;
}

// Nothing but a square of finite numbers with the given side, variances >= 0.
Eigen::MatrixXd read_matrix(const json& rows, const std::vector<Parameter>& parameters,
                            std::string_view source) {
  const std::size_t side = parameters.size();
  const auto is_row = [&](const json& row) { return row.is_array() && row.size() == side; };
  if (!is_row(rows) || !std::ranges::all_of(rows, is_row)) {
    fail_covariance(source,
                    fmt::format(".matrix: expected {0} rows of {0} numbers, one for each of "
                                "fit.covariance.parameters",
                                side));
  }
  Eigen::MatrixXd matrix(side, side);
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j) {
      const json& value = rows[i][j];
      if (!value.is_number() || (i == j && value < 0)) {
        fail_covariance(
            source,
            fmt::format(".matrix[{}][{}] = {}: expected a finite number{}; fit again with "
                        "{} fixed or under a prior",
                        i, j, json_excerpt(value), i == j ? " >= 0" : "", parameters[i].name()));
      }
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = value;
    }
  }
  return matrix;
}

}  // namespace

FittedCovariance fitted_covariance(const Preset& preset, std::string_view source) {
  if (!preset.fit.is_object() || !preset.fit.contains("covariance")) {
    fail_covariance(source, " is missing: expected a preset that skyfit fit wrote");
  }
  const json& record = preset.fit.at("covariance");
  if (!record.is_object() || !record.contains("parameters") || !record.contains("matrix") ||
      !record.at("parameters").is_array() || record.at("parameters").empty()) {
    fail_covariance(source,
                    ": expected a list of parameters and their matrix, which skyfit fit writes for "
                    "those that are free and not at a bound");
  }
  const std::vector<Parameter> parameters =
      read_parameters(record.at("parameters"), preset.atmosphere, source);
  return {parameters, read_matrix(record.at("matrix"), parameters, source)};
}

}  // namespace skyfit::fit
