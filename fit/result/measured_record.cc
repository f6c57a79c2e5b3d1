// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fit/problem/measured_problem.h"
#include "fit/result/preset_record.h"
#include "model/atmosphere/derived.h"

namespace skyfit::fit {
namespace {

using nlohmann::json;

void require(bool holds, std::string_view name, double value, std::string_view constraint) {
  if (!holds) {
    throw std::invalid_argument(
        fmt::format("fit.{} = {:.9g}: must be {}", name, value, constraint));
  }
}

// The unknowns that all scans share and that are the atmosphere's.
std::vector<int> shared_parameters(const MeasuredResult& result) {
  std::vector<int> rows;
  for (std::size_t k = 0; k < result.covariance_unknowns.size(); ++k) {
    const Unknown& unknown =
        result.unknowns[static_cast<std::size_t>(result.covariance_unknowns[k])].unknown;
    if (std::holds_alternative<Parameter>(unknown.what) && unknown.scan == kAllScans)
      rows.push_back(static_cast<int>(k));
  }
  return rows;
}

json covariance_record(const MeasuredResult& result) {
  const std::vector<int> rows = shared_parameters(result);
  json names = json::array();
  for (const int k : rows) {
    names.push_back(result
                        .unknowns[static_cast<std::size_t>(
                            result.covariance_unknowns[static_cast<std::size_t>(k)])]
                        .unknown.name());
  }
  const Eigen::MatrixXd matrix = result.covariance.size() > 0
                                     ? Eigen::MatrixXd(result.covariance(rows, rows))
                                     : Eigen::MatrixXd();
  return {{"parameters", names}, {"matrix", matrix_json(matrix)}};
}

json parameter_records(const MeasuredResult& result) {
  json records = json::object();
  for (const UnknownRow& row : result.unknowns) {
    records[row.unknown.name()] = {{"unit", row.unknown.unit()},
                                   {"fitted", row.fitted},
                                   {"sigma", finite_or_null(row.sigma)},
                                   {"at_bound", row.at_bound},
                                   {"identifiable", row.identifiable}};
  }
  return records;
}

}  // namespace

void validate(const MeasuredOptions& options) {
  validate(options.common);
  require(std::isfinite(options.noise.relative) && options.noise.relative >= 0, "noise_relative",
          options.noise.relative, ">= 0");
  require(std::isfinite(options.noise.floor) && options.noise.floor >= 0, "noise_floor",
          options.noise.floor, ">= 0");
  require(options.noise.relative > 0 || options.noise.floor > 0, "noise_relative",
          options.noise.relative, "> 0 where the floor is 0");
  require(std::isfinite(options.loss_width) && options.loss_width > 0, "loss_width",
          options.loss_width, "> 0 sigmas");
  for (const auto& [id, prior] : options.instrument_priors) {
    if (std::isfinite(prior.mean) && std::isfinite(prior.sigma) && prior.sigma > 0) continue;
    throw std::invalid_argument(
        fmt::format("fit.prior: {} = {:.9g}:{:.9g}: must be a finite mean and a sigma > 0",
                    instrument_info(id).name, prior.mean, prior.sigma));
  }
}

Preset measured_preset(const refs::Reference& reference, const SkyModel& model,
                       const MeasuredOptions& options, const MeasuredResult& result) {
  Preset preset;
  preset.atmosphere = result.scans.front().atmosphere;
  preset.name = fmt::format("{}, {}", reference.name, aerosol_kind(preset.atmosphere));
  json suns = json::array();
  for (const ScanOutcome& scan : result.scans)
    suns.push_back(scan.info.sun_zenith * 180 / std::numbers::pi);
  preset.fit = {
      {"reference",
       {{"name", reference.name},
        {"description", reference.description},
        {"quantity", quantity_name(reference.quantity)},
        {"samples", result.samples},
        {"sun_zenith_deg", suns},
        {"exclude_sun_deg", options.common.exclude_sun * 180 / std::numbers::pi}}},
      {"skyfit_version", SKYFIT_VERSION},
      {"model", model.name()},
      {"start", options.common.start ? options.common.start->name : "defaults"},
      {"luminance_error_percent", finite_or_null(result.errors.luminance)},
      {"spectral_error_percent", finite_or_null(result.errors.spectral)},
      {"sigma_factor", finite_or_null(result.sigma_factor)},
      {"effective_samples", finite_or_null(result.effective_samples)},
      {"condition_number", finite_or_null(result.condition_number)},
      {"converged", result.converged},
      {"parameters", parameter_records(result)},
      {"covariance", covariance_record(result)},
  };
  return preset;
}

}  // namespace skyfit::fit
