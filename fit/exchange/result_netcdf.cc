// SPDX-License-Identifier: Apache-2.0
#include "fit/exchange/result_netcdf.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "data_refs/civil_time.h"
#include "model/atmosphere/preset.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string unit_of(refs::Quantity quantity) {
  switch (quantity) {
    case refs::Quantity::kLuminance:
      return "cd m-2";
    case refs::Quantity::kSpectralRadiance:
      return "W m-2 sr-1 nm-1";
    case refs::Quantity::kIlluminance:
      return "lx";
    case refs::Quantity::kIrradiance:
      return "W m-2";
    case refs::Quantity::kRelativeLuminance:
      break;
  }
  return "1";
}

const std::vector<std::string> kSampleCoordinates = {"sun_zenith", "view_zenith",
                                                     "relative_azimuth", "wavelength"};

template <class Rows, class Value>
auto column(const Rows& rows, const Value& value) {
  std::vector<std::decay_t<decltype(value(*rows.begin()))>> result;
  for (const auto& row : rows) result.push_back(value(row));
  return result;
}

// Adds variables of one dimension.
auto variables_of(NetcdfFile& file, std::string dimension) {
  return [&file, dimension = std::move(dimension)](const std::string& name, auto values,
                                                   const char* meaning, std::string unit) {
    file.variables.push_back({name, {dimension}, std::move(values), meaning, std::move(unit)});
  };
}

using Samples = std::vector<refs::Sample>;

auto angles_of(const Samples& samples, double refs::Sample::*of) {
  return column(samples, [of](const refs::Sample& s) { return s.*of / kRadiansPerDegree; });
}

template <class Add>
void add_irradiance_names(const Samples& samples, const std::string& name, const Add& add) {
  add(name,
      column(samples,
             [](const refs::Sample& s) {
               return std::string(kIrradianceNames[s.irradiance.value()]);
             }),
      "which irradiance the sample is", "");
}

// Irradiances beside a sky have a dimension of their own.
void add_samples(const refs::Reference& reference, NetcdfFile& file) {
  Samples samples;
  for (const refs::Sample& sample : reference.samples)
    if (!refs::is_beside_sky(reference, sample)) samples.push_back(sample);
  file.dimensions.emplace_back("sample", samples.size());
  const auto add = variables_of(file, "sample");
  add("sample_scan", column(samples, [](const refs::Sample& s) { return s.scan; }),
      "scan of the sample, from 0", "1");
  add("sun_zenith", angles_of(samples, &refs::Sample::sun_zenith), "zenith angle of the sun",
      "degree");
  add("view_zenith", angles_of(samples, &refs::Sample::view_zenith),
      "zenith angle of the line of sight as stated", "degree");
  add("relative_azimuth", angles_of(samples, &refs::Sample::relative_azimuth),
      "azimuth of the line of sight from the sun's, as stated", "degree");
  if (reference.quantity == refs::Quantity::kSpectralRadiance)
    add("wavelength", column(samples, [](const refs::Sample& s) { return s.wavelength_nm; }),
        "wavelength in air", "nm");
  if (refs::is_irradiance(reference.quantity)) add_irradiance_names(samples, "irradiance", add);
  add("reference_value", column(samples, [](const refs::Sample& s) { return s.value; }),
      "value of the reference", unit_of(reference.quantity));
  add("weight", column(samples, [](const refs::Sample& s) { return s.weight; }),
      "weight; 0: not used", "1");
}

// The values of the samples of a sky, or of those beside it.
std::vector<double> chosen(const refs::Reference& reference, const std::vector<double>& values,
                           bool beside_sky) {
  std::vector<double> result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (refs::is_beside_sky(reference, reference.samples[i]) == beside_sky)
      result.push_back(values[i]);
  }
  return result;
}

template <class Add>
void add_fitted_values(const Result& result, bool beside_sky, const std::string& prefix,
                       const std::string& unit, const Add& add) {
  const auto of = [&](const std::vector<double>& values) {
    return chosen(result.reference, values, beside_sky);
  };
  add(prefix + "model", of(result.model), "value of the fitted atmosphere", unit);
  add(prefix + "start_model", of(result.start_model), "value before the fit", unit);
  add(prefix + "sigma", of(result.sigma),
      "one standard deviation of a sample; missing where it was not fitted", unit);
}

void add_irradiances_beside_sky(const Result& result, NetcdfFile& file) {
  const refs::Reference& reference = result.reference;
  if (!reference.irradiance_quantity) return;
  Samples samples;
  for (const refs::Sample& sample : reference.samples)
    if (refs::is_beside_sky(reference, sample)) samples.push_back(sample);
  const std::string unit = unit_of(*reference.irradiance_quantity);
  file.dimensions.emplace_back("irradiance_sample", samples.size());
  const auto add = variables_of(file, "irradiance_sample");
  add_irradiance_names(samples, "irradiance", add);
  add("irradiance_scan", column(samples, [](const refs::Sample& s) { return s.scan; }),
      "scan of the irradiance, from 0", "1");
  add("irradiance_sun_zenith", angles_of(samples, &refs::Sample::sun_zenith),
      "zenith angle of the sun", "degree");
  add("irradiance_value", column(samples, [](const refs::Sample& s) { return s.value; }),
      "value of the reference", unit);
  add_fitted_values(result, true, "irradiance_", unit, add);
}

void add_unknowns(const Result& result, NetcdfFile& file) {
  if (result.unknowns.empty()) return;
  file.dimensions.emplace_back("parameter", result.unknowns.size());
  const auto add = [&](const char* name, auto values, const char* meaning, const char* unit) {
    file.variables.push_back({name, {"parameter"}, std::move(values), meaning, unit});
  };
  const auto& rows = result.unknowns;
  add("parameter", column(rows, [](const UnknownRow& row) { return row.unknown.name(); }),
      "name of the unknown", "");
  add("parameter_unit",
      column(rows, [](const UnknownRow& row) { return cf_unit(row.unknown.unit()); }),
      "unit of the unknown's values", "");
  add("parameter_start", column(rows, [](const UnknownRow& row) { return row.start; }),
      "value before the fit, in parameter_unit", "");
  add("parameter_value", column(rows, [](const UnknownRow& row) { return row.fitted; }),
      "fitted value, in parameter_unit", "");
  add("parameter_sigma", column(rows, [](const UnknownRow& row) { return row.sigma; }),
      "one standard deviation, in parameter_unit; missing at a bound", "");
  add("at_bound", column(rows, [](const UnknownRow& row) { return row.at_bound ? 1 : 0; }),
      "1: the value is at its bound", "1");
  add("identifiable", column(rows, [](const UnknownRow& row) { return row.identifiable ? 1 : 0; }),
      "0: the value is that of the prior", "1");
  if (result.covariance.size() == 0) return;
  for (const char* side : {"covariance_parameter", "covariance_parameter_2"}) {
    file.dimensions.emplace_back(side, result.covariance_unknowns.size());
    file.variables.push_back(
        {side,
         {side},
         column(result.covariance_unknowns,
                [&](int i) { return rows[static_cast<std::size_t>(i)].unknown.name(); }),
         "name of the unknown",
         ""});
  }
  const auto matrix = [&](const char* name, const Eigen::MatrixXd& values, const char* meaning,
                          const char* unit) {
    std::vector<double> rowwise;
    for (const auto row : values.rowwise()) rowwise.insert(rowwise.end(), row.begin(), row.end());
    file.variables.push_back({name,
                              {"covariance_parameter", "covariance_parameter_2"},
                              std::move(rowwise),
                              meaning,
                              unit});
  };
  matrix("covariance", result.covariance, "covariance, in the products of the parameters' units",
         "");
  matrix("correlation", result.correlation, "correlation", "1");
}

void add_scans(const Result& result, NetcdfFile& file) {
  file.dimensions.emplace_back("scan", result.scans.size());
  const auto add = [&](const char* name, auto values, const char* meaning, const char* unit) {
    file.variables.push_back({name, {"scan"}, std::move(values), meaning, unit});
  };
  const auto& scans = result.scans;
  add("scan_name", column(scans, [](const ScanOutcome& s) { return s.info.name; }),
      "name of the scan", "");
  if (std::ranges::any_of(scans, [](const ScanOutcome& s) { return !s.info.time_utc.empty(); })) {
    add("time",
        column(scans, [](const ScanOutcome& s) { return seconds_since_1970(s.info.time_utc); }),
        "begin of the scan, UTC", kSecondsSince1970);
  }
  add("scan_sun_zenith",
      column(scans, [](const ScanOutcome& s) { return s.info.sun_zenith / kRadiansPerDegree; }),
      "zenith angle of the sun at the begin of the scan", "degree");
  add("rms_luminance", column(scans, [](const ScanOutcome& s) { return s.errors.luminance; }),
      "root mean square of model over reference less 1, of luminances", "percent");
  add("rms_spectral", column(scans, [](const ScanOutcome& s) { return s.errors.spectral; }),
      "2-norm of model less reference over that of the reference, 400 to 700 nm", "percent");
  add("rms_log", column(scans, [](const ScanOutcome& s) { return s.errors.rms_log; }),
      "root mean square of the logarithm of model over reference, its mean taken off", "percent");
  add("scan_samples", column(scans, [](const ScanOutcome& s) { return s.samples; }),
      "samples of the scan that were fitted", "1");
}

}  // namespace

std::string cf_unit(std::string_view unit) {
  std::string text(unit);
  std::erase(text, '^');
  if (text.empty()) return "1";
  return text == "deg" ? "degree" : text;
}

double seconds_since_1970(const std::string& time_utc) {
  const std::optional<refs::Instant> time = refs::instant(time_utc, 0);
  return time ? static_cast<double>(time->time_since_epoch().count()) / 1000 : kNone;
}

NetcdfFile netcdf_of(const Result& result) {
  NetcdfFile file = netcdf_file("Atmosphere fitted to " + result.reference.name);
  file.attributes.insert(
      file.attributes.end(),
      {{"reference", result.reference.name + ": " + result.reference.description},
       {"sky_model", result.model_name},
       {"start", result.start_name},
       {"termination", (result.converged ? "converged: " : "not converged: ") + result.termination},
       {"preset", preset_to_json(result.preset)}});
  add_samples(result.reference, file);
  const std::string unit = unit_of(result.reference.quantity);
  add_fitted_values(result, false, "", unit, variables_of(file, "sample"));
  add_irradiances_beside_sky(result, file);
  add_scans(result, file);
  add_unknowns(result, file);
  set_coordinates(file, "sample", kSampleCoordinates);
  set_coordinates(file, "scan", {"time", "scan_sun_zenith"});
  return file;
}

NetcdfFile netcdf_of(const refs::Reference& reference, const std::vector<ModelComparison>& rows) {
  NetcdfFile file = netcdf_file("Sky models compared with " + reference.name);
  file.attributes.emplace_back("reference", reference.name + ": " + reference.description);
  add_samples(reference, file);
  file.dimensions.emplace_back("model", rows.size());
  const auto add = [&](const char* name, auto values, const char* meaning, const char* unit) {
    file.variables.push_back({name, {"model"}, std::move(values), meaning, unit});
  };
  add("model", column(rows, [](const ModelComparison& row) { return row.model; }), "sky model", "");
  const auto add_errors = [&](const std::string& state,
                              std::optional<ModelErrors> ModelComparison::*errors) {
    if (std::ranges::none_of(rows, [&](const auto& row) { return (row.*errors).has_value(); }))
      return;
    file.variables.push_back(
        {state + "_rms_log",
         {"model"},
         column(rows,
                [&](const ModelComparison& row) {
                  return row.*errors ? (row.*errors)->rms_log_percent : kNone;
                }),
         "root mean square of the logarithm of model over reference, its mean taken off per scan",
         "percent"});
    std::vector<double> values;
    for (const ModelComparison& row : rows) {
      if (row.*errors) {
        values.insert(values.end(), (row.*errors)->model.begin(), (row.*errors)->model.end());
      } else {
        values.insert(values.end(), reference.samples.size(), kNone);
      }
    }
    file.variables.push_back({state,
                              {"model", "sample"},
                              std::move(values),
                              "value of the " + state + " model, with its scan's scale",
                              unit_of(reference.quantity)});
  };
  add_errors("unfitted", &ModelComparison::unfitted);
  add_errors("fitted", &ModelComparison::fitted);
  set_coordinates(file, "sample", kSampleCoordinates);
  return file;
}

}  // namespace skyfit::fit
