// SPDX-License-Identifier: Apache-2.0
#include "fit/result/record.h"

#include <fmt/format.h>

#include <cmath>

#include "data_refs/sample_csv_columns.h"
#include "fit/result/findings.h"
#include "model/atmosphere/derived.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

using nlohmann::json;

json errors_json(const Errors& errors) {
  return {{"rms_log_percent", finite_or_null(errors.rms_log)},
          {"luminance_error_percent", finite_or_null(errors.luminance)},
          {"spectral_error_percent", finite_or_null(errors.spectral)},
          {"mean_bias_percent", finite_or_null(errors.mean_bias)}};
}

json rms_json(const RmsSummary& rms) {
  return {{"all", finite_or_null(rms.all)},
          {"exclude_sun_3_deg", finite_or_null(rms.cone3)},
          {"exclude_sun_10_deg", finite_or_null(rms.cone10)},
          {"sun_zenith_up_to_70_deg", finite_or_null(rms.sun_below_70)}};
}

// By the columns of a CSV of samples.
json polarisation_json(const Result& result) {
  json kinds = json::object();
  for (const PolarisationErrors& errors : result.polarisation) {
    kinds[std::string(refs::sample_csv::polarisation_column(errors.what))] = {
        {"readings", errors.readings},
        {"rms_percentage_points_start", errors.start_rms},
        {"rms_percentage_points", errors.rms},
        {"sigma_percentage_points", errors.sigma}};
  }
  return kinds;
}

json irradiances_json(const Result& result) {
  json kinds = json::object();
  for (const IrradianceErrors& errors : result.irradiances) {
    kinds[std::string(kIrradianceNames[errors.what])] = {{"samples", errors.samples},
                                                         {"rms_percent_start", errors.start_rms},
                                                         {"rms_percent", errors.rms},
                                                         {"mean_bias_percent", errors.mean_bias},
                                                         {"sigma_percent", errors.sigma}};
  }
  return kinds;
}

json reference_json(const Result& result) {
  json suns = json::array();
  for (const ScanOutcome& scan : result.scans)
    suns.push_back(scan.info.sun_zenith * kDegreesPerRadian);
  json reference = {{"name", result.reference.name},
                    {"description", result.reference.description},
                    {"quantity", refs::sample_csv::value_column(result.reference.quantity)},
                    {"samples", result.samples},
                    {"sun_zenith_deg", suns},
                    {"exclude_sun_deg", result.exclude_sun * kDegreesPerRadian}};
  if (result.reference.irradiance_quantity) {
    reference["irradiance_quantity"] =
        refs::sample_csv::value_column(*result.reference.irradiance_quantity);
  }
  return reference;
}

json likelihood_json(const Result& result) {
  const Likelihood& likelihood = result.likelihood;
  return {
      {"link", link_name(likelihood.link)},         {"scale", scale_name(likelihood.scale)},
      {"pointing", pointing_name(result.pointing)}, {"noise_relative", likelihood.noise.relative},
      {"noise_floor", likelihood.noise.floor},      {"noise_is_known", likelihood.noise_is_known},
      {"loss", loss_name(likelihood.loss)},         {"loss_width", likelihood.loss_width}};
}

json unknowns_json(const Result& result) {
  json rows = json::array();
  for (const UnknownRow& row : result.unknowns) {
    const double unit = row.unknown.unit_value();
    const std::optional<Prior>& prior = row.unknown.prior;
    rows.push_back(
        {{"name", row.unknown.name()},
         {"unit", row.unknown.unit()},
         {"scan", row.unknown.scan == kAllScans ? json(nullptr) : json(row.unknown.scan + 1)},
         {"start", finite_or_null(row.start)},
         {"fitted", row.fitted},
         {"sigma", finite_or_null(row.sigma)},
         {"lower", row.unknown.lower / unit},
         {"upper", row.unknown.upper / unit},
         {"at_bound", row.at_bound},
         {"identifiable", row.identifiable},
         {"prior", prior ? json{{"mean", prior->mean / unit}, {"sigma", prior->sigma / unit}}
                         : json(nullptr)}});
  }
  return rows;
}

json fixed_json(const Result& result) {
  json rows = json::array();
  for (const FixedRow& row : result.fixed) {
    rows.push_back({{"name", row.parameter.name()},
                    {"unit", parameter_info(row.parameter).unit},
                    {"start", finite_or_null(row.start)},
                    {"value", row.value}});
  }
  return rows;
}

json scans_json(const Result& result) {
  json rows = json::array();
  for (const ScanOutcome& scan : result.scans) {
    json row = {{"name", scan.info.name},
                {"number", scan.info.number},
                {"time_utc", scan.info.time_utc},
                {"sun_zenith_deg", scan.info.sun_zenith * kDegreesPerRadian},
                {"directions", scan.directions},
                {"samples", scan.samples},
                {"start", errors_json(scan.start_errors)}};
    row.update(errors_json(scan.errors));
    for (const InstrumentInfo& info : instrument_table()) {
      row[std::string(info.name)] =
          finite_or_null(scan.instrument[static_cast<std::size_t>(info.id)] / info.unit_value);
    }
    rows.push_back(row);
  }
  return rows;
}

json starts_json(const Result& result) {
  json rows = json::array();
  for (const StartSummary& start : result.starts) {
    rows.push_back({{"name", start.name},
                    {"cost", finite_or_null(start.cost)},
                    {"iterations", start.iterations},
                    {"best", start.best}});
  }
  return rows;
}

json findings_json(const Result& result) {
  json rows = json::object();
  for (const Finding& finding : findings(result.preset.atmosphere)) {
    rows[std::string(finding.key)] = {{"value", finding.value},
                                      {"plausible_lower", finding.lower},
                                      {"plausible_upper", finding.upper},
                                      {"plausible", finding.plausible()},
                                      {"source", finding.source}};
  }
  return rows;
}

json covariance_names(const Result& result) {
  json names = json::array();
  for (const int u : result.covariance_unknowns)
    names.push_back(result.unknowns[static_cast<std::size_t>(u)].unknown.name());
  return names;
}

// Of the atmosphere that all scans share.
json shared_covariance(const Result& result) {
  std::vector<int> rows;
  json names = json::array();
  for (std::size_t k = 0; k < result.covariance_unknowns.size(); ++k) {
    const Unknown& unknown =
        result.unknowns[static_cast<std::size_t>(result.covariance_unknowns[k])].unknown;
    if (!std::holds_alternative<Parameter>(unknown.what) || unknown.scan != kAllScans) continue;
    rows.push_back(static_cast<int>(k));
    names.push_back(unknown.name());
  }
  const Eigen::MatrixXd matrix = result.covariance.size() > 0
                                     ? Eigen::MatrixXd(result.covariance(rows, rows))
                                     : Eigen::MatrixXd();
  return {{"parameters", names}, {"matrix", matrix_json(matrix)}};
}

json record_of(const Result& result) {
  json record = {{"skyfit_version", result.version},
                 {"model", result.model_name},
                 {"transfer", transfer_name(result.transfer)},
                 {"start", result.start_name},
                 {"reference", reference_json(result)},
                 {"notes", result.reference.notes},
                 {"samples_not_used", result.samples_left_out},
                 {"likelihood", likelihood_json(result)},
                 {"errors_start", errors_json(result.start_errors)},
                 {"rms_log_percent_start", rms_json(result.start_rms)},
                 {"rms_log_percent_fitted", rms_json(result.rms)},
                 {"scan_results", scans_json(result)},
                 {"unknowns", unknowns_json(result)},
                 {"fixed", fixed_json(result)},
                 {"covariance", shared_covariance(result)},
                 {"covariance_unknowns", covariance_names(result)},
                 {"covariance_of_unknowns", matrix_json(result.covariance)},
                 {"correlation", matrix_json(result.correlation)},
                 {"condition_number", finite_or_null(result.condition_number)},
                 {"sigma_factor", finite_or_null(result.sigma_factor)},
                 {"sigma_percent", finite_or_null(result.sigma_percent)},
                 {"effective_samples", finite_or_null(result.effective_samples)},
                 {"chi_square_per_dof", finite_or_null(result.chi_square_per_dof)},
                 {"downweighted_samples", result.downweighted},
                 {"samples", result.samples},
                 {"directions", result.directions},
                 {"scans", result.scans.size()},
                 {"converged", result.converged},
                 {"termination", result.termination},
                 {"iterations", result.iterations},
                 {"model_evaluations", result.model_evaluations},
                 {"derivative_evaluations", result.derivative_evaluations},
                 {"starts", starts_json(result)},
                 {"findings", findings_json(result)},
                 {"wall_seconds", result.wall_seconds}};
  record.update(errors_json(result.errors));
  if (!result.polarisation.empty()) record["polarisation"] = polarisation_json(result);
  if (!result.irradiances.empty()) record["irradiances"] = irradiances_json(result);
  return record;
}

json interval_json(const Interval& interval) {
  return {finite_or_null(interval.lower), finite_or_null(interval.upper)};
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

Preset fitted_preset(const Result& result) {
  Result named = result;
  Preset& preset = named.preset;
  preset.atmosphere = result.scans.front().atmosphere;
  preset.name = fmt::format("{}, {}", result.reference.name, aerosol_kind(preset.atmosphere));
  preset.fit = record_of(named);
  return preset;
}

nlohmann::json checks_json(const Result& result, const Checks& checks) {
  json all = json::object();
  for (const Profile& profile : checks.profiles) {
    all["profiles"].push_back({{"name", profile.name},
                               {"unit", profile.unit},
                               {"value", profile.value},
                               {"chi_square", profile.chi_square},
                               {"percent68", interval_json(profile.percent68)},
                               {"percent95", interval_json(profile.percent95)}});
  }
  if (checks.bootstrap) {
    all["bootstrap"] = {{"repetitions", checks.bootstrap->repetitions},
                        {"failed", checks.bootstrap->failed}};
    for (std::size_t u = 0; u < result.unknowns.size(); ++u) {
      all["bootstrap"]["unknowns"].push_back(
          {{"name", result.unknowns[u].unknown.name()},
           {"mean", finite_or_null(checks.bootstrap->mean[u])},
           {"sigma", finite_or_null(checks.bootstrap->sigma[u])}});
    }
  }
  for (const HoldOut& held : checks.hold_outs) {
    all["hold_outs"].push_back({{"name", held.name},
                                {"predicted", errors_json(held.predicted)},
                                {"own_pointing", errors_json(held.pointed)}});
  }
  return all;
}

}  // namespace skyfit::fit
