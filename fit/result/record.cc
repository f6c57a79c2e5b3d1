// SPDX-License-Identifier: Apache-2.0
#include "fit/result/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "fit/problem/free_parameters.h"
#include "fit/result/findings.h"
#include "model/atmosphere/derived.h"

namespace skyfit::fit {
namespace {

using nlohmann::json;

constexpr double kDegrees = 180 / std::numbers::pi;

double number_or(const json& value, double otherwise) {
  return value.is_number() ? value.get<double>() : otherwise;
}
double number_or_nan(const json& value) {
  return number_or(value, std::numeric_limits<double>::quiet_NaN());
}
double number_or_infinity(const json& value) {
  return number_or(value, std::numeric_limits<double>::infinity());
}

// One of a few values by its name.
template <class Enum, class Name>
Enum named(const json& name, std::initializer_list<Enum> values, const Name& name_of) {
  const auto text = name.get<std::string>();
  std::string known;
  for (const Enum value : values) {
    if (name_of(value) == text) return value;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", name_of(value));
  }
  throw std::invalid_argument(fmt::format("\"{}\": expected one of {}", text, known));
}

std::string_view quantity_name(refs::Quantity quantity) {
  switch (quantity) {
    case refs::Quantity::kLuminance:
      return "luminance_cd_m2";
    case refs::Quantity::kSpectralRadiance:
      return "spectral_radiance_w_m2_sr_nm";
    case refs::Quantity::kRelativeLuminance:
      break;
  }
  return "relative_luminance";
}

json errors_json(const Errors& errors) {
  return {{"rms_log_percent", finite_or_null(errors.rms_log)},
          {"luminance_error_percent", finite_or_null(errors.luminance)},
          {"spectral_error_percent", finite_or_null(errors.spectral)},
          {"mean_bias_percent", finite_or_null(errors.mean_bias)}};
}

Errors errors_from(const json& record) {
  return {number_or_nan(record.at("rms_log_percent")),
          number_or_nan(record.at("luminance_error_percent")),
          number_or_nan(record.at("spectral_error_percent")),
          number_or_nan(record.at("mean_bias_percent"))};
}

json rms_json(const RmsSummary& rms) {
  return {{"all", finite_or_null(rms.all)},
          {"exclude_sun_3_deg", finite_or_null(rms.cone3)},
          {"exclude_sun_10_deg", finite_or_null(rms.cone10)},
          {"sun_zenith_up_to_70_deg", finite_or_null(rms.sun_below_70)}};
}

RmsSummary rms_from(const json& record) {
  return {number_or_nan(record.at("all")), number_or_nan(record.at("exclude_sun_3_deg")),
          number_or_nan(record.at("exclude_sun_10_deg")),
          number_or_nan(record.at("sun_zenith_up_to_70_deg"))};
}

json reference_json(const Result& result) {
  json suns = json::array();
  for (const ScanOutcome& scan : result.scans) suns.push_back(scan.info.sun_zenith * kDegrees);
  return {{"name", result.reference.name},
          {"description", result.reference.description},
          {"quantity", quantity_name(result.reference.quantity)},
          {"samples", result.samples},
          {"sun_zenith_deg", suns},
          {"exclude_sun_deg", result.exclude_sun * kDegrees}};
}

json likelihood_json(const Result& result) {
  const Likelihood& likelihood = result.likelihood;
  return {
      {"link", link_name(likelihood.link)},         {"scale", scale_name(likelihood.scale)},
      {"pointing", pointing_name(result.pointing)}, {"noise_relative", likelihood.noise.relative},
      {"noise_floor", likelihood.noise.floor},      {"noise_is_known", likelihood.noise_is_known},
      {"loss", loss_name(likelihood.loss)},         {"loss_width", likelihood.loss_width}};
}

void read_likelihood(const json& record, Result& result) {
  Likelihood& likelihood = result.likelihood;
  likelihood.link = named(record.at("link"), {Link::kLog, Link::kLinear}, link_name);
  likelihood.scale =
      named(record.at("scale"), {Scale::kFixed, Scale::kShared, Scale::kPerScan, Scale::kProfiled},
            scale_name);
  result.pointing =
      named(record.at("pointing"),
            {Pointing::kStated, Pointing::kAzimuth, Pointing::kAzimuthAndTilt}, pointing_name);
  likelihood.noise = {record.at("noise_relative"), record.at("noise_floor")};
  likelihood.noise_is_known = record.at("noise_is_known");
  likelihood.loss = named(record.at("loss"), {Loss::kNone, Loss::kHuber, Loss::kCauchy}, loss_name);
  likelihood.loss_width = record.at("loss_width");
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

Unknown unknown_from(const json& row) {
  const auto name = row.at("name").get<std::string>();
  Unknown unknown{{}, unknown_from_name(name.substr(0, name.find('['))), kAllScans};
  if (row.at("scan").is_number()) unknown.scan = row.at("scan").get<int>() - 1;
  const double unit = unknown.unit_value();
  const Parameter* parameter = std::get_if<Parameter>(&unknown.what);
  unknown.logarithmic = parameter != nullptr
                            ? free_parameter(*parameter, {}).logarithmic
                            : std::get<Instrument>(unknown.what) == Instrument::kScale;
  unknown.lower = row.at("lower").get<double>() * unit;
  unknown.upper = row.at("upper").get<double>() * unit;
  if (const json& prior = row.at("prior"); prior.is_object())
    unknown.prior =
        Prior{prior.at("mean").get<double>() * unit, prior.at("sigma").get<double>() * unit};
  return unknown;
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
                {"sun_zenith_deg", scan.info.sun_zenith * kDegrees},
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

ScanOutcome scan_from(const json& row, const Result& result, int scan) {
  ScanOutcome outcome;
  outcome.info.number = row.at("number");
  outcome.info.name = row.at("name");
  outcome.info.time_utc = row.at("time_utc");
  outcome.info.sun_zenith = row.at("sun_zenith_deg").get<double>() / kDegrees;
  outcome.directions = row.at("directions");
  outcome.samples = row.at("samples");
  outcome.start_errors = errors_from(row.at("start"));
  outcome.errors = errors_from(row);
  for (const InstrumentInfo& info : instrument_table()) {
    outcome.instrument[static_cast<std::size_t>(info.id)] =
        number_or_nan(row.at(std::string(info.name))) * info.unit_value;
  }
  outcome.atmosphere = result.preset.atmosphere;
  for (const UnknownRow& unknown : result.unknowns) {
    const Parameter* parameter = std::get_if<Parameter>(&unknown.unknown.what);
    if (parameter != nullptr && unknown.unknown.scan == scan)
      set_parameter(outcome.atmosphere, *parameter, unknown.fitted);
  }
  return outcome;
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

Eigen::MatrixXd matrix_from(const json& rows) {
  if (!rows.is_array()) return {};
  const auto side = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd matrix(side, side);
  for (Eigen::Index i = 0; i < side; ++i) {
    for (Eigen::Index j = 0; j < side; ++j)
      matrix(i, j) =
          number_or_nan(rows.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j)));
  }
  return matrix;
}

json record_of(const Result& result) {
  json record = {{"skyfit_version", result.version},
                 {"model", result.model_name},
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
  return record;
}

void read_unknowns(const json& record, Result& result) {
  for (const json& row : record.at("unknowns")) {
    result.unknowns.push_back({unknown_from(row), number_or_nan(row.at("start")), row.at("fitted"),
                               number_or_nan(row.at("sigma")), row.at("at_bound"),
                               row.at("identifiable")});
  }
  for (const json& row : record.at("fixed")) {
    result.fixed.push_back({parameter_from_name(row.at("name").get<std::string>()),
                            number_or_nan(row.at("start")), row.at("value")});
  }
  for (const json& name : record.at("covariance_unknowns")) {
    const UnknownRow& row = result.unknown(name.get<std::string>());
    result.covariance_unknowns.push_back(static_cast<int>(&row - result.unknowns.data()));
  }
  result.covariance = matrix_from(record.at("covariance_of_unknowns"));
  result.correlation = matrix_from(record.at("correlation"));
}

void read_numbers(const json& record, Result& result) {
  result.condition_number = number_or_infinity(record.at("condition_number"));
  result.sigma_factor = number_or_nan(record.at("sigma_factor"));
  result.sigma_percent = number_or_nan(record.at("sigma_percent"));
  result.effective_samples = number_or_nan(record.at("effective_samples"));
  result.chi_square_per_dof = number_or_nan(record.at("chi_square_per_dof"));
  record.at("downweighted_samples").get_to(result.downweighted);
  record.at("samples").get_to(result.samples);
  record.at("directions").get_to(result.directions);
  record.at("converged").get_to(result.converged);
  record.at("termination").get_to(result.termination);
  record.at("iterations").get_to(result.iterations);
  record.at("model_evaluations").get_to(result.model_evaluations);
  record.at("derivative_evaluations").get_to(result.derivative_evaluations);
  record.at("wall_seconds").get_to(result.wall_seconds);
}

void read_record(const json& record, Result& result) {
  record.at("skyfit_version").get_to(result.version);
  record.at("model").get_to(result.model_name);
  record.at("start").get_to(result.start_name);
  const json& reference = record.at("reference");
  reference.at("name").get_to(result.reference.name);
  reference.at("description").get_to(result.reference.description);
  result.reference.quantity = named(reference.at("quantity"),
                                    {refs::Quantity::kLuminance, refs::Quantity::kSpectralRadiance,
                                     refs::Quantity::kRelativeLuminance},
                                    quantity_name);
  result.exclude_sun = reference.at("exclude_sun_deg").get<double>() / kDegrees;
  record.at("notes").get_to(result.reference.notes);
  record.at("samples_not_used").get_to(result.samples_left_out);
  read_likelihood(record.at("likelihood"), result);
  result.start_errors = errors_from(record.at("errors_start"));
  result.errors = errors_from(record);
  result.start_rms = rms_from(record.at("rms_log_percent_start"));
  result.rms = rms_from(record.at("rms_log_percent_fitted"));
  read_unknowns(record, result);
  read_numbers(record, result);
  int scan = 0;
  for (const json& row : record.at("scan_results"))
    result.scans.push_back(scan_from(row, result, scan++));
  for (const json& row : record.at("starts")) {
    result.starts.push_back(
        {row.at("name"), number_or_infinity(row.at("cost")), row.at("iterations"), row.at("best")});
  }
}

json interval_json(const Interval& interval) {
  return {finite_or_null(interval.lower), finite_or_null(interval.upper)};
}

Interval interval_from(const json& pair) {
  return {number_or_nan(pair.at(0)), number_or_nan(pair.at(1))};
}

std::invalid_argument not_a_record(std::string_view source, std::string_view what) {
  return std::invalid_argument(fmt::format(
      "{}: {}: expected the record of a fit that this version of skyfit wrote", source, what));
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

Result result_of(const Preset& preset, std::string_view source) {
  if (!preset.fit.is_object()) throw not_a_record(source, "fit is missing");
  Result result;
  result.preset = preset;
  try {
    read_record(preset.fit, result);
  } catch (const json::exception& error) {
    throw not_a_record(source, error.what());
  } catch (const std::invalid_argument& error) {
    throw not_a_record(source, error.what());
  }
  return result;
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

Checks checks_of(const nlohmann::json& report, std::string_view source) {
  Checks checks;
  try {
    const json& all = report.at("checks");
    for (const json& row : all.value("profiles", json::array())) {
      checks.profiles.push_back({row.at("name"), row.at("unit"), row.at("value"),
                                 row.at("chi_square"), interval_from(row.at("percent68")),
                                 interval_from(row.at("percent95"))});
    }
    if (all.contains("bootstrap")) {
      const json& row = all.at("bootstrap");
      Bootstrap bootstrap{row.at("repetitions"), row.at("failed"), {}, {}};
      for (const json& unknown : row.value("unknowns", json::array())) {
        bootstrap.mean.push_back(number_or_nan(unknown.at("mean")));
        bootstrap.sigma.push_back(number_or_nan(unknown.at("sigma")));
      }
      checks.bootstrap = bootstrap;
    }
    for (const json& row : all.value("hold_outs", json::array()))
      checks.hold_outs.push_back(
          {row.at("name"), errors_from(row.at("predicted")), errors_from(row.at("own_pointing"))});
  } catch (const json::exception& error) {
    throw not_a_record(source, error.what());
  }
  return checks;
}

}  // namespace skyfit::fit
