// SPDX-License-Identifier: Apache-2.0
#include "fit/result/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "fit/problem/free_parameters.h"
#include "fit/result/findings.h"
#include "model/atmosphere/derived.h"
#include "model/base/preset_reader.h"
#include "model/base/units.h"

namespace skyfit::fit {
namespace {

using nlohmann::json;

// Null is infinite.
double number_or_infinity(const PresetReader& record, std::string_view field) {
  return record.is_null(field) ? std::numeric_limits<double>::infinity() : record.number(field);
}

int count_from(const PresetReader& record, std::string_view field) {
  const double value = record.number(field);
  if (!(value >= 0 && value <= std::numeric_limits<int>::max() && value == std::floor(value)))
    record.fail_value(field, "a count");
  return static_cast<int>(value);
}

// Figures put it where gnuplot reads a time, so that no other text may stand there.
std::string time_utc_from(const PresetReader& record) {
  constexpr std::string_view kForm = "0000-00-00T00:00:00Z";
  const auto matches = [](char c, char form) {
    return form == '0' ? c >= '0' && c <= '9' : c == form;
  };
  const std::string text = record.text("time_utc");
  if (!text.empty() && !std::ranges::equal(text, kForm, matches))
    record.fail_value("time_utc", "YYYY-MM-DDTHH:MM:SSZ or nothing");
  return text;
}

// One of a few values by its name.
template <class Enum, class Name>
Enum named(const PresetReader& record, std::string_view field, std::initializer_list<Enum> values,
           const Name& name_of) {
  const std::string text = record.text(field);
  std::string known;
  for (const Enum value : values) {
    if (name_of(value) == text) return value;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", name_of(value));
  }
  record.fail_value(field, "one of " + known);
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

Errors errors_from(const PresetReader& record) {
  return {record.number_or_nan("rms_log_percent"), record.number_or_nan("luminance_error_percent"),
          record.number_or_nan("spectral_error_percent"),
          record.number_or_nan("mean_bias_percent")};
}

json rms_json(const RmsSummary& rms) {
  return {{"all", finite_or_null(rms.all)},
          {"exclude_sun_3_deg", finite_or_null(rms.cone3)},
          {"exclude_sun_10_deg", finite_or_null(rms.cone10)},
          {"sun_zenith_up_to_70_deg", finite_or_null(rms.sun_below_70)}};
}

RmsSummary rms_from(const PresetReader& record) {
  return {record.number_or_nan("all"), record.number_or_nan("exclude_sun_3_deg"),
          record.number_or_nan("exclude_sun_10_deg"),
          record.number_or_nan("sun_zenith_up_to_70_deg")};
}

json reference_json(const Result& result) {
  json suns = json::array();
  for (const ScanOutcome& scan : result.scans)
    suns.push_back(scan.info.sun_zenith * kDegreesPerRadian);
  return {{"name", result.reference.name},
          {"description", result.reference.description},
          {"quantity", quantity_name(result.reference.quantity)},
          {"samples", result.samples},
          {"sun_zenith_deg", suns},
          {"exclude_sun_deg", result.exclude_sun * kDegreesPerRadian}};
}

json likelihood_json(const Result& result) {
  const Likelihood& likelihood = result.likelihood;
  return {
      {"link", link_name(likelihood.link)},         {"scale", scale_name(likelihood.scale)},
      {"pointing", pointing_name(result.pointing)}, {"noise_relative", likelihood.noise.relative},
      {"noise_floor", likelihood.noise.floor},      {"noise_is_known", likelihood.noise_is_known},
      {"loss", loss_name(likelihood.loss)},         {"loss_width", likelihood.loss_width}};
}

void read_likelihood(const PresetReader& record, Result& result) {
  Likelihood& likelihood = result.likelihood;
  likelihood.link = named(record, "link", {Link::kLog, Link::kLinear}, link_name);
  likelihood.scale =
      named(record, "scale", {Scale::kFixed, Scale::kShared, Scale::kPerScan, Scale::kProfiled},
            scale_name);
  result.pointing =
      named(record, "pointing", {Pointing::kStated, Pointing::kAzimuth, Pointing::kAzimuthAndTilt},
            pointing_name);
  likelihood.noise = {record.number("noise_relative"), record.number("noise_floor")};
  likelihood.noise_is_known = record.flag("noise_is_known");
  likelihood.loss = named(record, "loss", {Loss::kNone, Loss::kHuber, Loss::kCauchy}, loss_name);
  likelihood.loss_width = record.number("loss_width");
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

// The result of `of_name`, which throws std::invalid_argument for a name that it does not know.
template <class Find>
auto by_name(const PresetReader& row, const Find& of_name) {
  const std::string name = row.text("name");  // names a missing field itself
  try {
    return of_name(name);
  } catch (const std::invalid_argument&) {
    row.fail_value("name", "the name of a parameter or of an instrument's property");
  }
}

Unknown unknown_from(const PresetReader& row, std::size_t scans) {
  Unknown unknown{{},
                  by_name(row,
                          [](const std::string& name) {
                            return unknown_from_name(name.substr(0, name.find('[')));
                          }),
                  kAllScans};
  if (!row.is_null("scan")) {
    const int scan = count_from(row, "scan");
    if (scan < 1 || static_cast<std::size_t>(scan) > scans)
      row.fail_value("scan", fmt::format("one of the {} scans, or null", scans));
    unknown.scan = scan - 1;
  }
  const double unit = unknown.unit_value();
  const Parameter* parameter = std::get_if<Parameter>(&unknown.what);
  unknown.logarithmic = parameter != nullptr
                            ? free_parameter(*parameter, {}).logarithmic
                            : std::get<Instrument>(unknown.what) == Instrument::kScale;
  unknown.lower = row.number("lower") * unit;
  unknown.upper = row.number("upper") * unit;
  if (!row.is_null("prior")) {
    const PresetReader prior = row.object("prior");
    unknown.prior = Prior{prior.number("mean") * unit, prior.number("sigma") * unit};
  }
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

ScanOutcome scan_from(const PresetReader& row, const Result& result, int scan) {
  ScanOutcome outcome;
  outcome.info.number = count_from(row, "number");
  outcome.info.name = row.text("name");
  outcome.info.time_utc = time_utc_from(row);
  outcome.info.sun_zenith = row.number("sun_zenith_deg") / kDegreesPerRadian;
  outcome.directions = count_from(row, "directions");
  outcome.samples = count_from(row, "samples");
  outcome.start_errors = errors_from(row.object("start"));
  outcome.errors = errors_from(row);
  for (const InstrumentInfo& info : instrument_table()) {
    outcome.instrument[static_cast<std::size_t>(info.id)] =
        row.number_or_nan(info.name) * info.unit_value;
  }
  outcome.atmosphere = result.preset.atmosphere;
  for (const UnknownRow& unknown : result.unknowns) {
    const Parameter* parameter = std::get_if<Parameter>(&unknown.unknown.what);
    if (parameter != nullptr && unknown.unknown.scan == scan)
      set_parameter(outcome.atmosphere, *parameter, unknown.fitted);
  }
  return outcome;
}

// By reason.
std::map<std::string, int> samples_left_out_from(const PresetReader& record) {
  const PresetReader reasons = record.object("samples_not_used");
  std::map<std::string, int> result;
  for (const auto& [reason, count] : reasons.value().items())
    result[reason] = count_from(reasons, reason);
  return result;
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

// Null where the problem was singular.
Eigen::MatrixXd matrix_from(const PresetReader& record, std::string_view field, std::size_t side) {
  if (record.is_null(field)) return {};
  const std::vector<std::vector<double>> rows = record.rows(field);
  const auto is_row = [&](const std::vector<double>& row) { return row.size() == side; };
  if (rows.size() != side || !std::ranges::all_of(rows, is_row))
    record.fail_value(field, fmt::format("{0} rows of {0} numbers", side));
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(side), static_cast<Eigen::Index>(side));
  for (std::size_t i = 0; i < side; ++i) {
    for (std::size_t j = 0; j < side; ++j)
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
  }
  return matrix;
}

Eigen::MatrixXd covariance_from(const PresetReader& record, std::string_view field,
                                std::size_t side) {
  const Eigen::MatrixXd covariance = matrix_from(record, field, side);
  constexpr double kRounding = 1 + 1e-9;  // of correlations
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    for (Eigen::Index j = 0; j < covariance.cols(); ++j) {
      const double product = covariance(i, i) * covariance(j, j);
      if (!(covariance(i, i) > 0 && product > 0 &&
            covariance(i, j) * covariance(i, j) <= kRounding * product))
        record.fail_value(field,
                          fmt::format("variances > 0 and correlations from -1 to 1, not so in row "
                                      "{}, column {}",
                                      i, j));
    }
  }
  return covariance;
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

void read_unknowns(const PresetReader& record, Result& result) {
  const std::size_t scans = record.objects("scan_results").size();
  for (const PresetReader& row : record.objects("unknowns")) {
    result.unknowns.push_back({unknown_from(row, scans), row.number_or_nan("start"),
                               row.number("fitted"), row.number_or_nan("sigma"),
                               row.flag("at_bound"), row.flag("identifiable")});
  }
  for (const PresetReader& row : record.objects("fixed")) {
    result.fixed.push_back(
        {by_name(row, [](const std::string& name) { return parameter_from_name(name); }),
         row.number_or_nan("start"), row.number("value")});
  }
  for (const std::string& name : record.texts("covariance_unknowns")) {
    const auto row = std::ranges::find(
        result.unknowns, name, [](const UnknownRow& unknown) { return unknown.unknown.name(); });
    if (row == result.unknowns.end())
      record.fail_value("covariance_unknowns", "names of unknowns of this fit");
    result.covariance_unknowns.push_back(static_cast<int>(row - result.unknowns.begin()));
  }
  const std::size_t side = result.covariance_unknowns.size();
  result.covariance = covariance_from(record, "covariance_of_unknowns", side);
  result.correlation = matrix_from(record, "correlation", side);
}

void read_numbers(const PresetReader& record, Result& result) {
  result.condition_number = number_or_infinity(record, "condition_number");
  result.sigma_factor = record.number_or_nan("sigma_factor");
  result.sigma_percent = record.number_or_nan("sigma_percent");
  result.effective_samples = record.number_or_nan("effective_samples");
  result.chi_square_per_dof = record.number_or_nan("chi_square_per_dof");
  result.downweighted = count_from(record, "downweighted_samples");
  result.samples = count_from(record, "samples");
  result.directions = count_from(record, "directions");
  result.converged = record.flag("converged");
  result.termination = record.text("termination");
  result.iterations = count_from(record, "iterations");
  result.model_evaluations = count_from(record, "model_evaluations");
  result.derivative_evaluations = count_from(record, "derivative_evaluations");
  result.wall_seconds = record.number("wall_seconds");
}

void read_record(const PresetReader& record, Result& result) {
  result.version = record.text("skyfit_version");
  result.model_name = record.text("model");
  result.start_name = record.text("start");
  const PresetReader reference = record.object("reference");
  result.reference.name = reference.text("name");
  result.reference.description = reference.text("description");
  result.reference.quantity = named(reference, "quantity",
                                    {refs::Quantity::kLuminance, refs::Quantity::kSpectralRadiance,
                                     refs::Quantity::kRelativeLuminance},
                                    quantity_name);
  result.exclude_sun = reference.number("exclude_sun_deg") / kDegreesPerRadian;
  result.reference.notes = record.texts("notes");
  result.samples_left_out = samples_left_out_from(record);
  read_likelihood(record.object("likelihood"), result);
  result.start_errors = errors_from(record.object("errors_start"));
  result.errors = errors_from(record);
  result.start_rms = rms_from(record.object("rms_log_percent_start"));
  result.rms = rms_from(record.object("rms_log_percent_fitted"));
  read_unknowns(record, result);
  read_numbers(record, result);
  int scan = 0;
  for (const PresetReader& row : record.objects("scan_results"))
    result.scans.push_back(scan_from(row, result, scan++));
  for (const PresetReader& row : record.objects("starts")) {
    result.starts.push_back({row.text("name"), number_or_infinity(row, "cost"),
                             count_from(row, "iterations"), row.flag("best")});
  }
}

json interval_json(const Interval& interval) {
  return {finite_or_null(interval.lower), finite_or_null(interval.upper)};
}

// A limit that was not found is null.
Interval interval_from(const PresetReader& row, std::string_view field) {
  const json& pair = row.value().contains(field) ? row.value().at(std::string(field)) : json();
  const auto is_limit = [](const json& limit) { return limit.is_number() || limit.is_null(); };
  if (!pair.is_array() || pair.size() != 2 || !std::ranges::all_of(pair, is_limit))
    row.fail_value(field, "two numbers");
  const auto limit = [&](std::size_t i) {
    return pair[i].is_null() ? std::numeric_limits<double>::quiet_NaN() : pair[i].get<double>();
  };
  return {limit(0), limit(1)};
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
  const PresetDocument document = PresetDocument::of_value({{"fit", preset.fit}}, source);
  Result result;
  result.preset = preset;
  read_record(document.root().object("fit"), result);
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

Checks checks_of(const PresetReader& report) {
  Checks checks;
  const PresetReader all = report.object("checks");
  if (all.has("profiles")) {
    for (const PresetReader& row : all.objects("profiles")) {
      checks.profiles.push_back({row.text("name"), row.text("unit"), row.numbers("value"),
                                 row.numbers("chi_square"), interval_from(row, "percent68"),
                                 interval_from(row, "percent95")});
    }
  }
  if (all.has("bootstrap")) {
    const PresetReader row = all.object("bootstrap");
    Bootstrap bootstrap{count_from(row, "repetitions"), count_from(row, "failed"), {}, {}};
    if (row.has("unknowns")) {
      for (const PresetReader& unknown : row.objects("unknowns")) {
        bootstrap.mean.push_back(unknown.number_or_nan("mean"));
        bootstrap.sigma.push_back(unknown.number_or_nan("sigma"));
      }
    }
    checks.bootstrap = bootstrap;
  }
  if (all.has("hold_outs")) {
    for (const PresetReader& row : all.objects("hold_outs"))
      checks.hold_outs.push_back({row.text("name"), errors_from(row.object("predicted")),
                                  errors_from(row.object("own_pointing"))});
  }
  return checks;
}

}  // namespace skyfit::fit
