// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/measured_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "model/atmosphere/derived.h"

namespace skyfit::fit {
namespace {

constexpr int kSearchChannels = 6;

// The aureole within 10 deg of the sun, which a pointing error of a degree changes by a tenth,
// would otherwise draw the forward lobe to its bound. 0.88 +- 0.05 spans the forward lobes that
// describe fine and coarse aerosol together.
constexpr Prior kForwardLobePrior{0.88, 0.05};

class ScanResiduals : public ResidualFunction {
 public:
  ScanResiduals(const MeasuredProblem& problem, const ScanData& data, double factor)
      : problem_(problem), data_(data), factor_(factor) {}

  Residuals evaluate(const Eigen::VectorXd& scaled, bool with_jacobian) override {
    const std::vector<Unknown>& unknowns = problem_.unknowns;
    const RowValues values = row_values(*problem_.model, data_, problem_.state(scaled),
                                        with_jacobian ? unknowns : std::vector<Unknown>{});
    Whitened white = problem_.whitened(data_, values, factor_);
    for (Eigen::Index u = 0; u < white.jacobian_per_unit.cols(); ++u) {
      white.jacobian_per_unit.col(u) *=
          unknowns[static_cast<std::size_t>(u)].value_per_scaled(scaled(u));
    }
    return {std::move(white.residual), std::move(white.jacobian_per_unit)};
  }

 private:
  const MeasuredProblem& problem_;
  const ScanData& data_;
  double factor_;
};

LeastSquares least_squares(const MeasuredProblem& problem, const ScanData& data,
                           ResidualFunction* function) {
  return {function,
          data.rows_per_look(),
          {problem.unknowns.begin(), problem.unknowns.end()},
          problem.loss,
          problem.loss_width};
}

std::vector<int> scans_of(bool per_scan, int scans) {
  if (!per_scan) return {kAllScans};
  std::vector<int> result;
  for (int scan = 0; scan < scans; ++scan) result.push_back(scan);
  return result;
}

void add_atmosphere(const MeasuredOptions& options, const std::vector<FreeParameter>& parameters,
                    int scans, std::vector<Unknown>& unknowns) {
  for (const Parameter id : options.per_scan) {
    if (std::ranges::count(parameters, id, &FreeParameter::id) > 0) continue;
    throw std::invalid_argument(
        fmt::format("fit.per_scan: {}: must be a free parameter", id.name()));
  }
  for (const FreeParameter& parameter : parameters) {
    for (const int scan : scans_of(options.per_scan.contains(parameter.id), scans))
      unknowns.push_back({parameter, parameter.id, scan});
  }
}

void add_instrument(const MeasuredOptions& options, Instrument id, bool per_scan, int scans,
                    std::vector<Unknown>& unknowns) {
  const InstrumentInfo& info = instrument_info(id);
  std::optional<Prior> prior = options.common.use_priors ? info.prior : std::nullopt;
  if (const auto given = options.instrument_priors.find(id);
      given != options.instrument_priors.end()) {
    prior = Prior{given->second.mean * info.unit_value, given->second.sigma * info.unit_value};
  }
  for (const int scan : scans_of(per_scan, scans)) {
    unknowns.push_back({{info.lower, info.upper, id == Instrument::kScale, prior}, id, scan});
  }
}

void add_instruments(const MeasuredOptions& options, int scans, std::vector<Unknown>& unknowns) {
  if (options.pointing != Pointing::kStated)
    add_instrument(options, Instrument::kAzimuthOffset, true, scans, unknowns);
  if (options.pointing == Pointing::kAzimuthAndTilt) {
    add_instrument(options, Instrument::kTiltNorth, true, scans, unknowns);
    add_instrument(options, Instrument::kTiltEast, true, scans, unknowns);
  }
  if (options.calibration != Calibration::kAbsolute) {
    add_instrument(options, Instrument::kScale, options.calibration == Calibration::kScalePerScan,
                   scans, unknowns);
  }
  for (const auto& [id, prior] : options.instrument_priors) {
    const bool varied = std::ranges::any_of(unknowns, [&](const Unknown& unknown) {
      const Instrument* instrument = std::get_if<Instrument>(&unknown.what);
      return instrument != nullptr && *instrument == id;
    });
    if (!varied) {
      throw std::invalid_argument(
          fmt::format("fit.prior: {}: must be free to have a prior", instrument_info(id).name));
    }
  }
}

// The table's, and of spectra the wavelength dependence too.
FitOptions with_default_parameters(const FitOptions& options, const SkyModel& model, bool spectral,
                                   const Atmosphere<double>& atmosphere) {
  FitOptions result = options;
  const bool g1_is_free = options.free
                              ? std::ranges::count(*options.free, Parameter::kMiePhaseG1) > 0
                              : has_parameter(atmosphere, Parameter::kMiePhaseG1) &&
                                    model.can_fit(Parameter::kMiePhaseG1) &&
                                    !options.fix.contains(Parameter::kMiePhaseG1);
  if (options.use_priors && g1_is_free)
    result.priors.emplace(Parameter::kMiePhaseG1, kForwardLobePrior);
  if (options.free || !spectral) return result;
  result.free.emplace();
  for (const Parameter& id : parameters_of(atmosphere)) {
    const bool free = parameter_info(id).free_by_default || id == Parameter::kMieAngstromExponent;
    if (free && model.can_fit(id) && !options.fix.contains(id)) result.free->push_back(id);
  }
  return result;
}

// Of the site, when every scan states the same.
std::optional<double> common_elevation(const refs::Reference& reference) {
  std::optional<double> elevation;
  for (const refs::Scan& scan : reference.scans) {
    if (!scan.elevation_m || (elevation && *elevation != *scan.elevation_m)) return {};
    elevation = scan.elevation_m;
  }
  return elevation;
}

void check_counts(const refs::Reference& reference, const MeasuredProblem& problem,
                  const MeasuredOptions& options) {
  if (problem.fitted.rows.empty()) {
    throw std::invalid_argument(fmt::format(
        "{}: no sample with weight is farther than {:.6g} deg from the sun, expected at least one",
        reference.name, options.common.exclude_sun * 180 / std::numbers::pi));
  }
  if (problem.fitted.rows.size() < problem.unknowns.size()) {
    throw std::invalid_argument(fmt::format("{}: {} samples for {} unknowns: must be at least {}",
                                            reference.name, problem.fitted.rows.size(),
                                            problem.unknowns.size(), problem.unknowns.size()));
  }
}

}  // namespace

SkyState MeasuredProblem::state(const Eigen::VectorXd& scaled) const {
  return with_unknowns(start, unknowns, scaled);
}

// docs/theory (11.4).
Whitened MeasuredProblem::whitened(const ScanData& data, const RowValues& values,
                                   double factor) const {
  Whitened result{values.value, values.derivative};
  for (std::size_t r = 0; r < data.rows.size(); ++r) {
    const auto row = static_cast<Eigen::Index>(r);
    const double inverse = 1 / (factor * data.rows[r].sigma);
    result.residual(row) = (values.value(row) - data.rows[r].value) * inverse;
    result.jacobian_per_unit.row(row) *= inverse;
  }
  return result;
}

Eigen::VectorXd MeasuredProblem::residuals(const ScanData& data, const Eigen::VectorXd& scaled,
                                           double factor) const {
  return whitened(data, row_values(*model, data, state(scaled), {}), factor).residual;
}

Minimum MeasuredProblem::solve(const ScanData& data, const Eigen::VectorXd& start_scaled,
                               double factor, const SolverLimits& limits) const {
  ScanResiduals function(*this, data, factor);
  if (unknowns.empty()) {
    const Residuals as_is = function.evaluate(start_scaled, false);
    return {start_scaled, 0.5 * as_is.value.squaredNorm(), 0, 1, 0, true, "NOTHING IS FREE"};
  }
  return minimise(least_squares(*this, data, &function), start_scaled, limits);
}

std::vector<double> MeasuredProblem::loss_weights(const Eigen::VectorXd& residual) const {
  return fit::loss_weights(least_squares(*this, fitted, nullptr), residual);
}

std::vector<double> sample_values(const MeasuredProblem& problem, const SkyState& state,
                                  std::size_t samples) {
  const RowValues values = row_values(*problem.model, problem.all, state, {});
  std::vector<double> result(samples, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t r = 0; r < problem.all.rows.size(); ++r)
    result[problem.all.rows[r].sample] = values.value(static_cast<Eigen::Index>(r));
  return result;
}

MeasuredOptions as_pointed(MeasuredOptions options) {
  options.common.exclude_sun = 0;
  return options;
}

MeasuredProblem measured_problem(const refs::Reference& reference, const SpectralData& spectra,
                                 const SkyModel& model, const MeasuredOptions& options) {
  check_lobes(options.common, model);
  const bool spectral = reference.quantity == refs::Quantity::kSpectralRadiance;
  ScanSelection selection{false, options.common.exclude_sun, options.noise, 0};
  MeasuredProblem problem;
  problem.model = &model;
  problem.fitted = scan_data(reference, spectra, selection);
  selection.largest_channels = kMediumChannels;
  problem.medium = scan_data(reference, spectra, selection);
  selection.largest_channels = kSearchChannels;
  problem.coarse = scan_data(reference, spectra, selection);
  problem.all = scan_data(reference, spectra, {true, 0, options.noise, 0});
  Atmosphere<double> given = start_atmosphere(options.common);
  if (const auto elevation = common_elevation(reference);
      elevation && !options.common.start && !options.common.site_pressure_hpa) {
    set_site_pressure(given, standard_pressure_hpa(*elevation));
  }
  if (options.ground) given.ground_spectrum = *options.ground;
  const bool evaluate_only = options.common.free && options.common.free->empty();
  const Atmosphere<double> base = with_fixed_values(
      evaluate_only ? given : with_lobes(given, options.common.lobes), options.common);
  const FitOptions common = with_default_parameters(options.common, model, spectral, base);
  const std::vector<FreeParameter> parameters =
      evaluate_only ? std::vector<FreeParameter>{} : choose_free_parameters(common, model, base);
  problem.starts = choose_starts(base, parameters, common.starts, options.common.start.has_value());
  problem.start = start_state(problem.starts.front().atmosphere, problem.scans());
  add_atmosphere(options, parameters, problem.scans(), problem.unknowns);
  add_instruments(options, problem.scans(), problem.unknowns);
  problem.loss = options.loss;
  problem.loss_width = options.loss_width;
  check_counts(reference, problem, options);
  return problem;
}

}  // namespace skyfit::fit
