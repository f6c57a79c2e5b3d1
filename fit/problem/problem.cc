// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>

#include "fit/problem/defaults.h"
#include "model/atmosphere/derived.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

constexpr int kSearchChannels = 6;

// Within its bounds an unknown may still contradict another, such as the base of a layer its top.
// Throws std::domain_error, which makes the solver take a shorter step.
void require_possible(const SkyState& state) {
  for (const Atmosphere<double>& atmosphere : state.atmosphere) {
    try {
      skyfit::validate(atmosphere);
    } catch (const std::invalid_argument& error) {
      throw std::domain_error(error.what());
    }
  }
}

class SkyResiduals : public ResidualFunction {
 public:
  SkyResiduals(const Problem& problem, Evaluations& evaluations, double factor)
      : problem_(problem), evaluations_(evaluations), factor_(factor) {}

  Residuals evaluate(const Eigen::VectorXd& scaled, bool with_jacobian) override {
    const std::vector<Unknown>& unknowns = problem_.unknowns;
    Whitened white = whiten(evaluations_.data(), problem_.likelihood,
                            evaluations_.at(scaled, with_jacobian), factor_);
    for (Eigen::Index u = 0; u < white.jacobian_per_unit.cols(); ++u) {
      white.jacobian_per_unit.col(u) *=
          unknowns[static_cast<std::size_t>(u)].value_per_scaled(scaled(u));
    }
    return {std::move(white.residual), std::move(white.jacobian_per_unit)};
  }

 private:
  const Problem& problem_;
  Evaluations& evaluations_;
  double factor_;
};

LeastSquares least_squares(const Problem& problem, const Dataset& data,
                           ResidualFunction* function) {
  return {function,
          data.samples_per_line_of_sight(),
          {problem.unknowns.begin(), problem.unknowns.end()},
          problem.likelihood.loss,
          problem.likelihood.loss_width};
}

std::vector<int> scans_of(bool per_scan, int scans) {
  if (!per_scan) return {kAllScans};
  std::vector<int> result;
  for (int scan = 0; scan < scans; ++scan) result.push_back(scan);
  return result;
}

// Those that an instrument has pointed or scaled: not those of irradiances beside a sky alone.
std::vector<int> scans_of_sky(const refs::Reference& reference, const Dataset& data) {
  std::vector<int> result;
  for (int scan = 0; scan < std::ssize(data.scans); ++scan) {
    const int number = data.scans[static_cast<std::size_t>(scan)].number;
    if (std::ranges::any_of(reference.samples, [&](const refs::Sample& sample) {
          return sample.scan == number && !refs::is_beside_sky(reference, sample);
        }))
      result.push_back(scan);
  }
  return result;
}

void add_atmosphere(const FitOptions& options, const std::vector<FreeParameter>& parameters,
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

void add_instrument(const FitOptions& options, Instrument id, const std::vector<int>& scans,
                    std::vector<Unknown>& unknowns) {
  const InstrumentInfo& info = instrument_info(id);
  std::optional<Prior> prior = options.use_priors ? info.prior : std::nullopt;
  if (const auto given = options.instrument_priors.find(id);
      given != options.instrument_priors.end()) {
    prior = Prior{given->second.mean * info.unit_value, given->second.sigma * info.unit_value};
  }
  for (const int scan : scans) {
    unknowns.push_back({{info.lower, info.upper, id == Instrument::kScale, prior}, id, scan});
  }
}

// `scans`: those of the sky.
void add_instruments(const FitOptions& options, Pointing pointing, Scale scale,
                     const std::vector<int>& scans, std::vector<Unknown>& unknowns) {
  if (pointing != Pointing::kStated)
    add_instrument(options, Instrument::kAzimuthOffset, scans, unknowns);
  if (pointing == Pointing::kAzimuthAndTilt) {
    add_instrument(options, Instrument::kTiltNorth, scans, unknowns);
    add_instrument(options, Instrument::kTiltEast, scans, unknowns);
  }
  if (scale == Scale::kPerScan) add_instrument(options, Instrument::kScale, scans, unknowns);
  if (scale == Scale::kShared) add_instrument(options, Instrument::kScale, {kAllScans}, unknowns);
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

void check_counts(const refs::Reference& reference, const Problem& problem,
                  const FitOptions& options) {
  const std::size_t count = problem.fitted.samples.size();
  const auto is_unused = [](const refs::Sample& sample) { return !(sample.weight > 0); };
  if (!reference.samples.empty() && std::ranges::all_of(reference.samples, is_unused)) {
    throw std::invalid_argument(fmt::format(
        "{}: none of its {} samples can be used, the first is {}", reference.name,
        reference.samples.size(), in_quotes(reference.samples.front().zero_weight_reason)));
  }
  if (count == 0) {
    throw std::invalid_argument(fmt::format(
        "{}: no sample with weight is farther than {:.6g} deg from the sun, expected at least one",
        reference.name, options.exclude_sun * kDegreesPerRadian));
  }
  const auto scales = static_cast<std::size_t>(problem.profiled_scales());
  const std::size_t needed = problem.unknowns.size() + scales;
  if (count < needed) {
    throw std::invalid_argument(
        fmt::format("{}: {} samples for {} unknowns and {} profiled scales: must be at least {}",
                    reference.name, count, problem.unknowns.size(), scales, needed));
  }
}

// Shared by all scans or not at all, and without priors.
bool may_swap_lobes(const FitOptions& options, const std::vector<FreeParameter>& parameters) {
  const auto own = std::ranges::count_if(options.per_scan, is_of_two_lobes);
  return (own == 0 || own == 3) && lobes_interchangeable(parameters);
}

void add_datasets(const refs::Reference& reference, const SpectralData& spectra,
                  const SkyModel& model, const FitOptions& options, Problem& problem) {
  const bool spectral = reference.quantity == refs::Quantity::kSpectralRadiance;
  const auto selected = [&](int largest_channels) {
    return dataset(reference, spectra,
                   {false, options.exclude_sun, problem.likelihood.noise, largest_channels,
                    model.gives_stokes()});
  };
  problem.fitted = selected(0);
  problem.medium = spectral ? selected(kMediumChannels) : problem.fitted;
  problem.coarse = selected(kSearchChannels);
  problem.all = dataset(reference, spectra, {true, 0, problem.likelihood.noise, 0});
}

// What the fit begins with, and what of it is free.
struct Beginning {
  Atmosphere<double> base;
  std::vector<FreeParameter> parameters;
};

bool is_one_lobe(const Atmosphere<double>& atmosphere) {
  const Constituent<double>* const aerosol = main_aerosol(atmosphere);
  return aerosol != nullptr && has_parameter(atmosphere, {aerosol->name, Quantity::kPhaseG});
}

// Nothing is fitted, or the options speak of the asymmetry parameter of the one lobe that is given.
bool asks_for_given_lobe(const FitOptions& options, const Atmosphere<double>& given) {
  if (options.free && options.free->empty()) return true;
  if (!is_one_lobe(given)) return false;
  const Parameter g{main_aerosol(given)->name, Quantity::kPhaseG};
  return options.fix.contains(g) || options.priors.contains(g) || options.bounds.contains(g) ||
         (options.free && std::ranges::count(*options.free, g) > 0);
}

// Whether a parameter of two lobes is free or has a value that the options fix.
bool varies_two_lobes(const FitOptions& options, const std::vector<FreeParameter>& parameters) {
  return std::ranges::any_of(parameters, is_of_two_lobes, &FreeParameter::id) ||
         std::ranges::any_of(options.fix,
                             [](const auto& fixed) { return is_of_two_lobes(fixed.first); });
}

std::optional<std::string> polarisation_left_out(const refs::Reference& reference,
                                                 const SkyModel& model) {
  const bool measured = std::ranges::any_of(
      reference.samples, [](const refs::Sample& s) { return !s.polarisation.empty(); });
  if (!measured || model.gives_stokes()) return {};
  return fmt::format("readings of polarisation are left out: the model {}{} gives none",
                     model.name(), model.transfer() == Transfer::kScalar ? " (scalar)" : "");
}

}  // namespace

SkyState Problem::state(const Eigen::VectorXd& scaled) const {
  return with_unknowns(start, unknowns, scaled);
}

int Problem::profiled_scales() const {
  if (likelihood.scale != Scale::kProfiled) return 0;
  std::set<int> with_samples;
  for (const LineOfSight& line : only_sky(fitted).lines_of_sight) with_samples.insert(line.scan);
  return static_cast<int>(with_samples.size());
}

Eigen::VectorXd Problem::with_ordered_lobes(const Eigen::VectorXd& scaled) const {
  if (!lobes_may_swap) return scaled;
  SkyState ordered = state(scaled);
  bool swapped = false;
  for (Atmosphere<double>& atmosphere : ordered.atmosphere) swapped |= order_lobes(atmosphere);
  return swapped ? scaled_values(unknowns, ordered) : scaled;
}

SkyState Problem::with_profiled_scales(SkyState at, const Dataset& data) const {
  if (likelihood.scale != Scale::kProfiled) return at;
  const auto scale_of = [&](std::size_t scan) -> double& {
    return at.instrument[scan][static_cast<std::size_t>(Instrument::kScale)];
  };
  for (std::size_t s = 0; s < at.instrument.size(); ++s) scale_of(s) = 1;
  const Eigen::VectorXd scale = whiten(data, likelihood, sky_values(*model, data, at, {}), 1).scale;
  for (std::size_t s = 0; s < at.instrument.size(); ++s)
    scale_of(s) = scale(static_cast<Eigen::Index>(s));
  return at;
}

SampleValues Evaluations::at(const Eigen::VectorXd& scaled, bool with_derivatives) {
  constexpr std::size_t kKept = 3;
  auto known = std::ranges::find_if(latest_, [&](const Point& point) {
    return point.with_derivatives >= with_derivatives && point.scaled == scaled;
  });
  if (known == latest_.end()) {
    const SkyState state = problem_.state(scaled);
    require_possible(state);
    ++(with_derivatives ? derivatives_computed_ : values_computed_);
    SampleValues values = sky_values(*problem_.model, data_, state,
                                     with_derivatives ? problem_.unknowns : std::vector<Unknown>{});
    if (latest_.size() == kKept) latest_.erase(latest_.begin());
    latest_.push_back({scaled, with_derivatives, std::move(values)});
    known = latest_.end() - 1;
  }
  if (with_derivatives) return known->values;
  return {known->values.value, Eigen::MatrixXd(known->values.value.size(), 0)};
}

Minimum Problem::solve(const Dataset& data, const Eigen::VectorXd& start_scaled, double factor,
                       const SolverLimits& limits) const {
  Evaluations evaluations(*this, data);
  return solve(evaluations, start_scaled, factor, limits);
}

Minimum Problem::solve(Evaluations& evaluations, const Eigen::VectorXd& start_scaled, double factor,
                       const SolverLimits& limits) const {
  SkyResiduals function(*this, evaluations, factor);
  if (unknowns.empty()) {
    const Residuals as_is = function.evaluate(start_scaled, false);
    return {start_scaled, 0.5 * as_is.value.squaredNorm(), 0, 1, 0, true, "NOTHING IS FREE"};
  }
  return minimise(least_squares(*this, evaluations.data(), &function), start_scaled, limits);
}

Eigen::VectorXd Problem::loss_weights(const Dataset& data, const Eigen::VectorXd& residual) const {
  const std::vector<double> of_lines =
      fit::loss_weights(least_squares(*this, data, nullptr), residual);
  Eigen::VectorXd weights(residual.size());
  for (std::size_t i = 0; i < data.samples.size(); ++i)
    weights(static_cast<Eigen::Index>(i)) =
        of_lines[static_cast<std::size_t>(data.samples[i].line_of_sight)];
  return weights;
}

Problem make_problem(const refs::Reference& reference, const SpectralData& spectra,
                     const SkyModel& model, const FitOptions& options) {
  check_lobes(options, model);
  Problem problem;
  problem.model = &model;
  problem.likelihood = likelihood_of(options, reference);
  problem.assumptions = assumptions(reference, options);
  if (const auto note = polarisation_left_out(reference, model))
    problem.assumptions.push_back(*note);
  add_datasets(reference, spectra, model, options, problem);
  if (auto note = repeated_samples(problem.fitted)) problem.assumptions.push_back(std::move(*note));
  const Atmosphere<double> given = given_atmosphere(reference, options);
  const Pointing pointing = pointing_of(options, reference);
  const bool several_wavelengths = only_sky(problem.fitted).channels.size() > 1 &&
                                   reference.quantity == refs::Quantity::kSpectralRadiance;
  const auto beginning_with = [&](const Atmosphere<double>& unfixed) {
    Beginning result{with_fixed_values(unfixed, options), {}};
    result.parameters = choose_free_parameters(
        with_default_parameters(with_free_of_irradiances(options, reference, model, result.base),
                                model, several_wavelengths, pointing != Pointing::kStated,
                                result.base),
        model, result.base);
    return result;
  };
  const Atmosphere<double> lobed =
      asks_for_given_lobe(options, given) ? given : with_lobes(given, options.lobes);
  Beginning beginning = beginning_with(lobed);
  if (is_one_lobe(given) && !is_one_lobe(lobed)) {
    if (!varies_two_lobes(options, beginning.parameters)) {
      beginning = beginning_with(given);
    } else {
      problem.assumptions.push_back(fmt::format(
          "{} is fitted with two lobes in place of the one of the preset; --lobes 1 keeps it",
          main_aerosol(given)->name));
    }
  }
  const auto& [base, parameters] = beginning;
  if (auto note = held_aerosol(options, model, base, parameters))
    problem.assumptions.push_back(std::move(*note));
  problem.starts = choose_starts(base, parameters, options.starts, options.start.has_value());
  problem.start = start_state(problem.starts.front().atmosphere, problem.scans());
  problem.given =
      options.start ? start_state(as_given(given, options), problem.scans()) : problem.start;
  problem.lobes_may_swap = may_swap_lobes(options, parameters);
  add_atmosphere(options, parameters, problem.scans(), problem.unknowns);
  add_instruments(options, pointing, problem.likelihood.scale,
                  scans_of_sky(reference, problem.fitted), problem.unknowns);
  check_counts(reference, problem, options);
  return problem;
}

std::vector<double> reference_values(const Problem& problem, const SkyState& state,
                                     std::size_t samples) {
  const SampleValues values = sky_values(*problem.model, problem.all, state, {});
  std::vector<double> result(samples, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < problem.all.samples.size(); ++i)
    result[problem.all.samples[i].index] = values.value(static_cast<Eigen::Index>(i));
  return result;
}

FitOptions without_sun_exclusion(FitOptions options) {
  options.exclude_sun = 0;
  return options;
}

}  // namespace skyfit::fit
