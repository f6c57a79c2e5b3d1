// SPDX-License-Identifier: Apache-2.0
// Reads back what record.cc writes, field by field: a file may have been changed or damaged.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "data_refs/sample_csv_columns.h"
#include "fit/problem/free_parameters.h"
#include "fit/result/record.h"
#include "model/numerics/angles.h"

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

Errors errors_from(const PresetReader& record) {
  return {record.number_or_nan("rms_log_percent"), record.number_or_nan("luminance_error_percent"),
          record.number_or_nan("spectral_error_percent"),
          record.number_or_nan("mean_bias_percent")};
}

RmsSummary rms_from(const PresetReader& record) {
  return {record.number_or_nan("all"), record.number_or_nan("exclude_sun_3_deg"),
          record.number_or_nan("exclude_sun_10_deg"),
          record.number_or_nan("sun_zenith_up_to_70_deg")};
}

// Nothing where none was fitted.
void read_polarisation(const PresetReader& record, Result& result) {
  if (!record.has("polarisation")) return;
  const PresetReader kinds = record.object("polarisation");
  for (const refs::sample_csv::PolarisationColumn& column :
       refs::sample_csv::kPolarisationColumns) {
    if (!kinds.has(column.name)) continue;
    const PresetReader row = kinds.object(column.name);
    result.polarisation.push_back(
        {column.what, count_from(row, "readings"), row.number("rms_percentage_points_start"),
         row.number("rms_percentage_points"), row.number("sigma_percentage_points")});
  }
}

void read_irradiances(const PresetReader& record, Result& result) {
  if (!record.has("irradiances")) return;
  const PresetReader kinds = record.object("irradiances");
  for (int kind = 0; kind < kIrradianceCount; ++kind) {
    const std::string_view name = kIrradianceNames[static_cast<std::size_t>(kind)];
    if (!kinds.has(name)) continue;
    const PresetReader row = kinds.object(name);
    result.irradiances.push_back({static_cast<Irradiance>(kind), count_from(row, "samples"),
                                  row.number("rms_percent_start"), row.number("rms_percent"),
                                  row.number("mean_bias_percent"), row.number("sigma_percent")});
  }
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
  unknown.lower = row.number("lower") * unit;
  unknown.upper = row.number("upper") * unit;
  unknown.logarithmic = parameter != nullptr
                            ? is_logarithmic(*parameter, unknown.lower)
                            : std::get<Instrument>(unknown.what) == Instrument::kScale;
  if (!row.is_null("prior")) {
    const PresetReader prior = row.object("prior");
    unknown.prior = Prior{prior.number("mean") * unit, prior.number("sigma") * unit};
  }
  return unknown;
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

// Records without one are older than polarisation.
Transfer transfer_of(const PresetReader& record) {
  if (!record.has("transfer")) return Transfer::kScalar;
  const std::string name = record.text("transfer");
  for (const Transfer transfer : {Transfer::kVector, Transfer::kScalar}) {
    if (name == transfer_name(transfer)) return transfer;
  }
  record.fail_value("transfer", "vector or scalar");
}

void read_record(const PresetReader& record, Result& result) {
  result.version = record.text("skyfit_version");
  result.model_name = record.text("model");
  result.transfer = transfer_of(record);
  result.start_name = record.text("start");
  const PresetReader reference = record.object("reference");
  result.reference.name = reference.text("name");
  result.reference.description = reference.text("description");
  result.reference.quantity = named(reference, "quantity",
                                    {refs::Quantity::kLuminance, refs::Quantity::kSpectralRadiance,
                                     refs::Quantity::kRelativeLuminance,
                                     refs::Quantity::kIlluminance, refs::Quantity::kIrradiance},
                                    refs::sample_csv::value_column);
  if (reference.has("irradiance_quantity")) {
    result.reference.irradiance_quantity =
        named(reference, "irradiance_quantity",
              {refs::Quantity::kIlluminance, refs::Quantity::kIrradiance},
              refs::sample_csv::value_column);
  }
  result.exclude_sun = reference.number("exclude_sun_deg") / kDegreesPerRadian;
  result.reference.notes = record.texts("notes");
  result.samples_left_out = samples_left_out_from(record);
  read_likelihood(record.object("likelihood"), result);
  result.start_errors = errors_from(record.object("errors_start"));
  result.errors = errors_from(record);
  result.start_rms = rms_from(record.object("rms_log_percent_start"));
  result.rms = rms_from(record.object("rms_log_percent_fitted"));
  read_polarisation(record, result);
  read_irradiances(record, result);
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

Result result_of(const Preset& preset, std::string_view source) {
  const PresetDocument document = PresetDocument::of_value({{"fit", preset.fit}}, source);
  Result result;
  result.preset = preset;
  read_record(document.root().object("fit"), result);
  return result;
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
