// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "fit/fit.h"
#include "model/atmosphere/derived.h"

namespace skyfit::fit {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

std::string number(double value, int digits = 5) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : std::string("-");
}

std::string remark(const FittedParameter& row) {
  if (!row.free) return "fixed";
  const ParameterInfo info = parameter_info(row.id);
  if (row.at_bound) {
    const bool lower = row.fitted - info.lower < info.upper - row.fitted;
    return fmt::format("at {} bound", lower ? "lower" : "upper");
  }
  return row.identifiable ? "" : "not identifiable";
}

std::string prior_text(const FittedParameter& row) {
  if (!row.free) return "";
  if (!row.prior) return "none";
  return fmt::format("{:.4g}+-{:.3g}", row.prior->mean, row.prior->sigma);
}

std::string header(const FitResult& result) {
  const nlohmann::json& fit = result.preset.fit;
  return fmt::format(
      "Fit of {}\n"
      "reference   {}\n"
      "model       {} (skyfit {}), started from {}\n"
      "samples     {} in {} scans, {:.4g} deg around the sun left out; one free luminance scale "
      "per "
      "scan\n"
      "solver      {} after {} iterations of all {} starts; {} model solutions, {} with "
      "derivatives\n\n",
      result.preset.name, fit["reference"]["description"].get<std::string>(),
      fit["model"].get<std::string>(), fit["skyfit_version"].get<std::string>(),
      fit["start"].get<std::string>(), result.samples, result.scans,
      fit["reference"]["exclude_sun_deg"].get<double>(), result.termination, result.iterations,
      result.starts.size(), result.model_evaluations, result.derivative_evaluations);
}

// At most 100 columns.
std::string parameter_table_text(const FitResult& result) {
  constexpr std::string_view kRow = "{:<29}{:<4}{:>9}{:>11}{:>10} {:<20}{}";
  std::string text =
      fmt::format(kRow, "parameter", "unit", "start", "fitted", "one sigma", "prior", "at bound?") +
      "\n";
  for (const FittedParameter& row : result.parameters) {
    const ParameterInfo info = parameter_info(row.id);
    std::string line =
        fmt::format(kRow, info.name, info.unit, number(row.start, 4), number(row.fitted),
                    row.free ? number(row.sigma, 3) : "-", prior_text(row), remark(row));
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text + "\n";
}

std::string sigma_text(const FitResult& result) {
  std::string text;
  if (result.sigma_from_residuals) {
    text = fmt::format(
        "One sigma is from the residuals (the reference states none) and the priors: {:.3g} % per "
        "sample.\n",
        result.sigma_log_percent);
    if (result.effective_samples < 0.95 * result.samples) {
      text += fmt::format(
          "Neighbouring residuals are correlated: {} samples count as {:.3g} independent ones.\n",
          result.samples, result.effective_samples);
    }
  } else {
    text = fmt::format(
        "One sigma is from the reference's sigma ({:.3g} % root mean square) and the priors; chi^2 "
        "per degree\nof freedom = {:.4g} (well above 1: the misfit is larger than the stated "
        "sigma).\n",
        result.sigma_log_percent, result.chi_square_per_dof);
  }
  text +=
      "\"not identifiable\": the data say less about the parameter than its prior (without a "
      "prior: "
      "than its\nbounds). A parameter at a bound has no sigma; the sigmas of the others hold for "
      "it "
      "at that bound.\n";
  return text + "\n";
}

// A prior that the misfit overrides: the parameter is neither known nor at its prior.
std::string pulled_text(const FitResult& result) {
  constexpr double kPulled = 2;  // prior sigmas
  std::string text;
  for (const FittedParameter& row : result.parameters) {
    if (!row.free || !row.prior || row.identifiable) continue;
    const double pull = (row.fitted - row.prior->mean) / row.prior->sigma;
    if (std::abs(pull) < kPulled) continue;
    text += fmt::format("{} is {:+.2g} prior sigmas from its prior: the misfit pulls it there.\n",
                        row.id.name(), pull);
  }
  return text.empty() ? text : text + "\n";
}

std::string correlation_text(const FitResult& result) {
  if (result.covariance_parameters.empty()) {
    return "No covariance: every free parameter is at a bound.\n\n";
  }
  if (result.correlation.size() == 0) {
    return "The covariance is singular: data and priors leave a direction open (see the parameters "
           "without sigma).\nCondition number of the normal matrix: infinite.\n\n";
  }
  std::string text = fmt::format(
      "Correlation matrix (condition number of the normal matrix with unit diagonal: {:.3g})\n",
      result.condition_number);
  const Eigen::Index count = result.correlation.rows();
  for (Eigen::Index i = 0; i < count; ++i) {
    text += fmt::format("{:>2} {:<29}", i + 1, result.covariance_parameters[i].name());
    for (Eigen::Index j = 0; j <= i; ++j) text += fmt::format("{:>6.2f}", result.correlation(i, j));
    text += "\n";
  }
  text += fmt::format("{:32}", "");
  for (Eigen::Index j = 0; j < count; ++j) text += fmt::format("{:>6}", j + 1);
  return text + "\n\n";
}

std::string rms_text(const FitResult& result) {
  const auto row = [](std::string_view name, double start, double fitted) {
    return fmt::format("{:<52}{:>12}{:>12}\n", name, number(start), number(fitted));
  };
  const RmsSummary &start = result.start_rms, &fitted = result.fitted_rms;
  std::string text = "Root mean square of log(model/reference), a free scale per scan, percent\n";
  text += fmt::format("{:<52}{:>12}{:>12}\n", "", "start", "fitted");
  text += row("all fitted samples", start.all, fitted.all);
  text += row("3 deg around the sun left out", start.cone3, fitted.cone3);
  text += row("10 deg around the sun left out", start.cone10, fitted.cone10);
  text += row("sun zenith <= 70 deg", start.sun_below_70, fitted.sun_below_70);
  text +=
      "\nPer scan                          RMS start, %  RMS fitted, %  scale (reference/model)\n";
  for (std::size_t i = 0; i < result.per_sun.size(); ++i) {
    text += fmt::format("sun zenith {:>7.4g} deg {:>25.4g}{:>15.4g}{:>25.5g}\n",
                        result.per_sun[i].sun_zenith * kDegrees,
                        result.start_per_sun[i].rms_log_percent, result.per_sun[i].rms_log_percent,
                        result.per_sun[i].scale);
  }
  return text + "\n";
}

std::string starts_text(const FitResult& result) {
  std::string text = "Starts (cost: half the sum of squares of the coarse search, a pure number)\n";
  for (std::size_t i = 0; i < result.starts.size(); ++i) {
    const StartSummary& start = result.starts[i];
    text += fmt::format("{:>3}  {:<50}{:>14} in {:>3} iterations{}\n", i + 1, start.name,
                        std::isfinite(start.cost) ? number(start.cost) : "failed", start.iterations,
                        start.best ? "  best" : "");
  }
  return text + "\n";
}

std::string derived_text(const FitResult& result) {
  const Atmosphere<double>& atmosphere = result.preset.atmosphere;
  return fmt::format(
      "Derived, at 550 nm: aerosol optical depth {:.4g}, Rayleigh optical depth {:.4g}; mean "
      "cosine "
      "of the\naerosol's phase function {:.4g} (g of Cornette-Shanks is not the mean cosine).\n",
      aerosol_optical_depth(atmosphere), rayleigh_optical_depth(atmosphere),
      aerosol_mean_cosine(atmosphere));
}

}  // namespace

std::string brief_report(const FitResult& result) {
  int open = 0;
  for (const FittedParameter& row : result.parameters) open += row.free && !row.identifiable;
  return fmt::format("{}: {:.3g} % RMS log error ({:.3g} % at the start), {} samples, {}{}",
                     result.preset.name, result.rms_log_percent, result.start_rms.all,
                     result.samples, result.converged ? "converged" : "NOT CONVERGED",
                     open > 0 ? fmt::format(", {} parameters not identifiable", open) : "");
}

std::string full_report(const FitResult& result) {
  return header(result) + parameter_table_text(result) + sigma_text(result) + pulled_text(result) +
         correlation_text(result) + rms_text(result) + starts_text(result) + derived_text(result) +
         fmt::format("Time: {:.3g} s.\n", result.wall_seconds);
}

}  // namespace skyfit::fit
