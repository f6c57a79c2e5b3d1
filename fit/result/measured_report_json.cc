// SPDX-License-Identifier: Apache-2.0
#include <numbers>

#include "fit/result/findings.h"
#include "fit/result/measured_report.h"
#include "fit/result/preset_record.h"

namespace skyfit::fit {
namespace {

using nlohmann::json;

json errors_json(const MeasuredErrors& errors) {
  return {{"luminance_error_percent", finite_or_null(errors.luminance)},
          {"spectral_error_percent", finite_or_null(errors.spectral)},
          {"mean_bias_percent", finite_or_null(errors.mean_bias)}};
}

json unknowns_json(const MeasuredResult& result) {
  json rows = json::array();
  for (const UnknownRow& row : result.unknowns) {
    const double unit = row.unknown.unit_value();
    const std::optional<Prior>& prior = row.unknown.prior;
    rows.push_back(
        {{"name", row.unknown.name()},
         {"unit", row.unknown.unit()},
         {"scan", row.unknown.scan == kAllScans ? json(nullptr) : json(row.unknown.scan + 1)},
         {"start", row.start},
         {"fitted", row.fitted},
         {"sigma", finite_or_null(row.sigma)},
         {"at_bound", row.at_bound},
         {"identifiable", row.identifiable},
         {"prior", prior ? json{{"mean", prior->mean / unit}, {"sigma", prior->sigma / unit}}
                         : json(nullptr)}});
  }
  return rows;
}

json scans_json(const MeasuredResult& result) {
  json rows = json::array();
  for (const ScanOutcome& scan : result.scans) {
    json row = {{"name", scan.info.name},
                {"time_utc", scan.info.time_utc},
                {"sun_zenith_deg", scan.info.sun_zenith * 180 / std::numbers::pi},
                {"directions", scan.directions},
                {"samples", scan.samples}};
    row.update(errors_json(scan.errors));
    for (const InstrumentInfo& info : instrument_table()) {
      row[std::string(info.name)] =
          scan.instrument[static_cast<std::size_t>(info.id)] / info.unit_value;
    }
    rows.push_back(row);
  }
  return rows;
}

json findings_json(const MeasuredResult& result) {
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

json interval_json(const Interval& interval) {
  return {finite_or_null(interval.lower), finite_or_null(interval.upper)};
}

json checks_json(const MeasuredResult& result, const MeasuredChecks& checks) {
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

json covariance_names(const MeasuredResult& result) {
  json names = json::array();
  for (const int u : result.covariance_unknowns)
    names.push_back(result.unknowns[static_cast<std::size_t>(u)].unknown.name());
  return names;
}

}  // namespace

json report_json(const MeasuredResult& result, const MeasuredChecks& checks) {
  const json& fit = result.preset.fit;
  json report = {{"skyfit_version", fit["skyfit_version"]},
                 {"reference", fit["reference"]},
                 {"samples_not_used", refs::samples_left_out(result.reference)},
                 {"notes", result.reference.notes},
                 {"model", fit["model"]},
                 {"start", fit["start"]},
                 {"errors_start", errors_json(result.start_errors)},
                 {"scan_results", scans_json(result)},
                 {"unknowns", unknowns_json(result)},
                 {"covariance_unknowns", covariance_names(result)},
                 {"covariance", matrix_json(result.covariance)},
                 {"correlation", matrix_json(result.correlation)},
                 {"condition_number", finite_or_null(result.condition_number)},
                 {"sigma_factor", result.sigma_factor},
                 {"effective_samples", finite_or_null(result.effective_samples)},
                 {"chi_square_per_dof", finite_or_null(result.chi_square_per_dof)},
                 {"findings", findings_json(result)},
                 {"checks", checks_json(result, checks)},
                 {"samples", result.samples},
                 {"directions", result.directions},
                 {"scans", result.scans.size()},
                 {"converged", result.converged},
                 {"termination", result.termination},
                 {"iterations", result.iterations},
                 {"model_evaluations", result.model_evaluations},
                 {"derivative_evaluations", result.derivative_evaluations},
                 {"wall_seconds", result.wall_seconds}};
  report.update(errors_json(result.errors));
  for (const StartSummary& start : result.starts) {
    report["starts"].push_back({{"name", start.name},
                                {"cost", finite_or_null(start.cost)},
                                {"iterations", start.iterations},
                                {"best", start.best}});
  }
  return report;
}

}  // namespace skyfit::fit
