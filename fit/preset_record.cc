// SPDX-License-Identifier: Apache-2.0
#include "fit/preset_record.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace skyfit::fit {
namespace {

using nlohmann::json;

std::string quantity_name(refs::Quantity quantity) {
  return quantity == refs::Quantity::kLuminance ? "luminance_cd_m2" : "relative_luminance";
}

json sun_list(const FitResult& result) {
  json suns = json::array();
  for (const RmsOfSun& sun : result.per_sun) {
    suns.push_back(sun.sun_zenith * 180 / std::numbers::pi);
  }
  return suns;
}

json parameter_records(const FitResult& result) {
  json records = json::object();
  for (const FittedParameter& row : result.parameters) {
    if (!row.free) continue;
    const ParameterInfo& info = parameter_info(row.id);
    json record = {{"unit", info.unit},
                   {"sigma", finite_or_null(row.sigma)},
                   {"at_bound", row.at_bound},
                   {"identifiable", row.identifiable}};
    record["prior"] =
        row.prior ? json{{"mean", row.prior->mean}, {"sigma", row.prior->sigma}} : json(nullptr);
    records[std::string(info.name)] = record;
  }
  return records;
}

json covariance_record(const FitResult& result) {
  json names = json::array();
  for (const Parameter id : result.covariance_parameters) names.push_back(parameter_info(id).name);
  return {{"parameters", names}, {"matrix", matrix_json(result.covariance)}};
}

}  // namespace

nlohmann::json finite_or_null(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

nlohmann::json matrix_json(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) return nullptr;
  json rows = json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    json row = json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(finite_or_null(matrix(i, j)));
    rows.push_back(row);
  }
  return rows;
}

Preset fitted_preset(const Atmosphere<double>& atmosphere, const refs::Reference& reference,
                     const SkyModel& model, const FitOptions& options, const FitResult& result) {
  Preset preset;
  preset.name = fmt::format("{}, {}", reference.name, phase_kind(atmosphere.mie.phase.type));
  preset.atmosphere = atmosphere;
  preset.fit = {
      {"reference",
       {{"name", reference.name},
        {"description", reference.description},
        {"quantity", quantity_name(reference.quantity)},
        {"samples", result.samples},
        {"sun_zenith_deg", sun_list(result)},
        {"exclude_sun_deg", options.exclude_sun * 180 / std::numbers::pi}}},
      {"skyfit_version", SKYFIT_VERSION},
      {"model", model.name()},
      {"start", options.start ? options.start->name : "defaults"},
      {"rms_log_percent", finite_or_null(result.rms_log_percent)},
      {"sigma_log_percent", finite_or_null(result.sigma_log_percent)},
      {"sigma_from_residuals", result.sigma_from_residuals},
      {"effective_samples", finite_or_null(result.effective_samples)},
      {"condition_number", finite_or_null(result.condition_number)},
      {"converged", result.converged},
      {"parameters", parameter_records(result)},
      {"covariance", covariance_record(result)},
  };
  return preset;
}

}  // namespace skyfit::fit
