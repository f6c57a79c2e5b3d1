// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "fit/fit.h"
#include "fit/result/preset_record.h"
#include "model/atmosphere/derived.h"

namespace skyfit::fit {
namespace {

using nlohmann::json;

json parameters_json(const FitResult& result) {
  json rows = json::array();
  for (const FittedParameter& row : result.parameters) {
    const ParameterInfo info = parameter_info(row.id);
    rows.push_back(
        {{"name", info.name},
         {"unit", info.unit},
         {"meaning", info.meaning},
         {"free", row.free},
         {"start", finite_or_null(row.start)},
         {"fitted", row.fitted},
         {"sigma", row.free ? finite_or_null(row.sigma) : json(nullptr)},
         {"lower", info.lower},
         {"upper", info.upper},
         {"at_bound", row.at_bound},
         {"identifiable", row.free ? json(row.identifiable) : json(nullptr)},
         {"prior", row.prior ? json{{"mean", row.prior->mean}, {"sigma", row.prior->sigma}}
                             : json(nullptr)}});
  }
  return rows;
}

json rms_json(const RmsSummary& rms) {
  return {{"all", finite_or_null(rms.all)},
          {"exclude_sun_3_deg", finite_or_null(rms.cone3)},
          {"exclude_sun_10_deg", finite_or_null(rms.cone10)},
          {"sun_zenith_up_to_70_deg", finite_or_null(rms.sun_below_70)}};
}

json per_sun_json(const FitResult& result) {
  json rows = json::array();
  for (std::size_t i = 0; i < result.per_sun.size(); ++i) {
    rows.push_back({{"sun_zenith_deg", result.per_sun[i].sun_zenith * 180 / std::numbers::pi},
                    {"rms_log_percent", result.per_sun[i].rms_log_percent},
                    {"start_rms_log_percent", result.start_per_sun[i].rms_log_percent},
                    {"scale", result.per_sun[i].scale}});
  }
  return rows;
}

json starts_json(const FitResult& result) {
  json rows = json::array();
  for (const StartSummary& start : result.starts) {
    rows.push_back({{"start", start.name},
                    {"cost", finite_or_null(start.cost)},
                    {"iterations", start.iterations},
                    {"best", start.best}});
  }
  return rows;
}

json names_json(const std::vector<Parameter>& parameters) {
  json names = json::array();
  for (const Parameter id : parameters) names.push_back(id.name());
  return names;
}

}  // namespace

nlohmann::json report_json(const FitResult& result) {
  const nlohmann::json& fit = result.preset.fit;
  return {{"name", result.preset.name},
          {"skyfit_version", fit["skyfit_version"]},
          {"reference", fit["reference"]},
          {"model", fit["model"]},
          {"start", fit["start"]},
          {"rms_log_percent", finite_or_null(result.rms_log_percent)},
          {"rms_log_percent_fitted", rms_json(result.fitted_rms)},
          {"rms_log_percent_start", rms_json(result.start_rms)},
          {"per_sun", per_sun_json(result)},
          {"parameters", parameters_json(result)},
          {"covariance_parameters", names_json(result.covariance_parameters)},
          {"covariance", matrix_json(result.covariance)},
          {"correlation", matrix_json(result.correlation)},
          {"condition_number", finite_or_null(result.condition_number)},
          {"singular", !std::isfinite(result.condition_number)},
          {"sigma_from_residuals", result.sigma_from_residuals},
          {"sigma_log_percent", finite_or_null(result.sigma_log_percent)},
          {"effective_samples", finite_or_null(result.effective_samples)},
          {"chi_square_per_dof", finite_or_null(result.chi_square_per_dof)},
          {"samples", result.samples},
          {"scans", result.scans},
          {"converged", result.converged},
          {"termination", result.termination},
          {"iterations", result.iterations},
          {"model_evaluations", result.model_evaluations},
          {"derivative_evaluations", result.derivative_evaluations},
          {"starts", starts_json(result)},
          {"aerosol_optical_depth_550nm", aerosol_optical_depth(result.preset.atmosphere)},
          {"rayleigh_optical_depth_550nm", rayleigh_optical_depth(result.preset.atmosphere)},
          {"aerosol_mean_cosine", aerosol_mean_cosine(result.preset.atmosphere)},
          {"wall_seconds", result.wall_seconds}};
}

}  // namespace skyfit::fit
