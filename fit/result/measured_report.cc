// SPDX-License-Identifier: Apache-2.0
#include "fit/result/measured_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/result/findings.h"

namespace skyfit::fit {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

std::string number(double value, int digits = 5) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : std::string("-");
}

std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string header(const MeasuredResult& result) {
  const nlohmann::json& fit = result.preset.fit;
  return fmt::format(
      "Fit of {}\n"
      "reference   {}\n"
      "model       {} (skyfit {}), started from {}\n"
      "samples     {} in {} directions of {} scans, {:.4g} deg around the sun left out\n"
      "solver      {} after {} iterations of all {} starts; {} model solutions, {} with "
      "derivatives\n\n",
      result.preset.name, fit["reference"]["description"].get<std::string>(),
      fit["model"].get<std::string>(), fit["skyfit_version"].get<std::string>(),
      fit["start"].get<std::string>(), result.samples, result.directions, result.scans.size(),
      fit["reference"]["exclude_sun_deg"].get<double>(), result.termination, result.iterations,
      result.starts.size(), result.model_evaluations, result.derivative_evaluations);
}

// What is known of the reference, and its samples without weight by reason.
std::string reference_remarks(const refs::Reference& reference) {
  std::string text;
  for (const std::string& note : reference.notes) text += fmt::format("note        {}\n", note);
  for (const auto& [reason, count] : refs::samples_left_out(reference))
    text += fmt::format("left out    {} sample{}: {}\n", count, count == 1 ? "" : "s", reason);
  return text.empty() ? text : text + "\n";
}

std::string errors_text(const MeasuredResult& result) {
  constexpr std::string_view kRow = "{:<44}{:>14}{:>14}{:>14}\n";
  const auto row = [&](std::string_view name, const MeasuredErrors& errors) {
    return fmt::format(kRow, name, number(errors.luminance, 4), number(errors.spectral, 4),
                       number(errors.mean_bias, 3));
  };
  std::string text = fmt::format(kRow, "Errors, percent", "luminance", "spectral", "mean bias");
  text += row("all scans, at the start", result.start_errors);
  text += row("all scans, fitted", result.errors);
  for (std::size_t s = 0; s < result.scans.size(); ++s) {
    const ScanInfo& info = result.scans[s].info;
    const std::string name = info.name.substr(info.name.rfind('/') + 1);
    text += row(fmt::format("[{}] {}, sun {:.4g} deg", s + 1, name.substr(0, 24),
                            info.sun_zenith * kDegrees),
                result.scans[s].errors);
  }
  return text +
         "luminance: root mean square of model / measured - 1 over the directions; spectral: "
         "|model "
         "- measured|\nover |measured|, 2-norms over all samples of 400 to 700 nm.\n\n";
}

std::string remark(const UnknownRow& row) {
  if (row.at_bound) {
    const double value = row.fitted * row.unknown.unit_value();
    const bool lower = value - row.unknown.lower < row.unknown.upper - value;
    return fmt::format("at {} bound", lower ? "lower" : "upper");
  }
  return row.identifiable ? "" : "not identifiable";
}

std::string unknowns_text(const MeasuredResult& result) {
  constexpr std::string_view kRow = "{:<29}{:<4}{:>10}{:>11}{:>11} {:<20}{}";
  std::string text = trimmed(fmt::format(kRow, "unknown ([scan])", "unit", "start", "fitted",
                                         "one sigma", "prior", "remark"));
  for (const UnknownRow& row : result.unknowns) {
    const std::optional<Prior>& prior = row.unknown.prior;
    const double unit = row.unknown.unit_value();
    text += trimmed(fmt::format(
        kRow, row.unknown.name(), row.unknown.unit(), number(row.start, 4), number(row.fitted),
        number(row.sigma, 3),
        prior ? fmt::format("{:.4g}+-{:.3g}", prior->mean / unit, prior->sigma / unit) : "none",
        remark(row)));
  }
  text += fmt::format(
      "Residuals weigh with {:.3g} times the assumed sigma; correlated as they are, {} samples "
      "count as "
      "{:.3g}\nindependent ones, and one sigma allows for it. chi^2 per degree of freedom under "
      "the "
      "assumed noise: {:.4g}.\n"
      "\"not identifiable\": the data say less about the unknown than its prior (without one: than "
      "its bounds).\nUnknowns at a bound have no sigma; those of the others hold with it there.\n",
      result.sigma_factor, result.samples, result.effective_samples, result.chi_square_per_dof);
  return text + "\n";
}

// A prior that the misfit overrides: the unknown is neither known nor at its prior.
std::string pulled_text(const MeasuredResult& result) {
  constexpr double kPulled = 2;  // prior sigmas
  std::string text;
  for (const UnknownRow& row : result.unknowns) {
    const std::optional<Prior>& prior = row.unknown.prior;
    if (!prior || row.identifiable) continue;
    const double pull = (row.fitted * row.unknown.unit_value() - prior->mean) / prior->sigma;
    if (std::abs(pull) < kPulled) continue;
    text += fmt::format("{} is {:+.2g} prior sigmas from its prior: the misfit pulls it there{}.\n",
                        row.unknown.name(), pull,
                        row.unknown.what == std::variant<Parameter, Instrument>(
                                                Parameter::kMieSingleScatteringAlbedo)
                            ? "; an unknown calibration (--scale) may be what it stands for"
                            : "");
  }
  return text.empty() ? text : text + "\n";
}

std::string correlation_text(const MeasuredResult& result) {
  if (result.correlation.size() == 0) {
    return "No covariance: every unknown is at a bound, or a direction is left open by data and "
           "priors.\n\n";
  }
  std::string text = fmt::format(
      "Correlations of at least 0.5 (condition number of the normal matrix with unit diagonal: "
      "{:.3g})\n",
      result.condition_number);
  const auto name = [&](Eigen::Index k) {
    return result
        .unknowns[static_cast<std::size_t>(result.covariance_unknowns[static_cast<std::size_t>(k)])]
        .unknown.name();
  };
  for (Eigen::Index i = 0; i < result.correlation.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double value = result.correlation(i, j);
      if (std::abs(value) >= 0.5)
        text += fmt::format("{:<32}{:<32}{:>7.2f}\n", name(j), name(i), value);
    }
  }
  return text + "\n";
}

std::string findings_text(const MeasuredResult& result) {
  std::string text =
      fmt::format("{:<38}{:>9}  {:<15}{}\n", "Physics found", "value", "plausible", "source");
  for (const Finding& finding : findings(result.preset.atmosphere)) {
    text += fmt::format("{:<38}{:>9}  {:<15}{}\n", finding.name, number(finding.value, 4),
                        fmt::format("{:.3g}..{:.3g}{}", finding.lower, finding.upper,
                                    finding.plausible() ? "" : " NO"),
                        finding.source);
  }
  return text + "\n";
}

std::string profiles_text(const std::vector<Profile>& profiles) {
  std::string text;
  for (const Profile& profile : profiles) {
    text +=
        fmt::format("Profile likelihood of {}, {}: 68 % {} .. {}, 95 % {} .. {}\n", profile.name,
                    profile.unit, number(profile.percent68.lower), number(profile.percent68.upper),
                    number(profile.percent95.lower), number(profile.percent95.upper));
    for (std::size_t i = 0; i < profile.value.size(); ++i)
      text += fmt::format("  {:>12}  chi^2 + {:.4g}\n", number(profile.value[i]),
                          profile.chi_square[i]);
    text += "\n";
  }
  return text;
}

std::string bootstrap_text(const MeasuredResult& result, const Bootstrap& bootstrap) {
  std::string text = fmt::format(
      "Bootstrap over the directions (not the priors), {} "
      "repetitions{}\n{:<32}{:>12}{:>12}{:>22}\n",
      bootstrap.repetitions,
      bootstrap.failed > 0 ? fmt::format(", {} failed", bootstrap.failed) : "", "unknown", "mean",
      "sigma", "sigma of covariance");
  for (std::size_t u = 0; u < result.unknowns.size(); ++u) {
    text += fmt::format("{:<32}{:>12}{:>12}{:>22}\n", result.unknowns[u].unknown.name(),
                        number(bootstrap.mean[u]), number(bootstrap.sigma[u], 3),
                        number(result.unknowns[u].sigma, 3));
  }
  return text + "\n";
}

std::string hold_out_text(const std::vector<HoldOut>& hold_outs) {
  if (hold_outs.empty()) return "";
  constexpr std::string_view kRow = "{:<44}{:>12}{:>10}{:>20}{:>10}\n";
  std::string text = fmt::format(kRow, "Errors of what was left out, percent", "luminance",
                                 "spectral", "own pointing: lum.", "spectral");
  MeasuredErrors predicted, pointed;
  const auto count = static_cast<double>(hold_outs.size());
  for (const HoldOut& held : hold_outs) {
    text += fmt::format(kRow, held.name.substr(held.name.rfind('/') + 1).substr(0, 43),
                        number(held.predicted.luminance, 4), number(held.predicted.spectral, 4),
                        number(held.pointed.luminance, 4), number(held.pointed.spectral, 4));
    predicted.luminance += held.predicted.luminance / count;
    predicted.spectral += held.predicted.spectral / count;
    pointed.luminance += held.pointed.luminance / count;
    pointed.spectral += held.pointed.spectral / count;
  }
  text += fmt::format(kRow, "mean", number(predicted.luminance, 4), number(predicted.spectral, 4),
                      number(pointed.luminance, 4), number(pointed.spectral, 4));
  return text +
         "A scan left out is predicted with the mean instrument of the others, then with its "
         "own pointing fitted.\n\n";
}

std::string downweighted_text(const MeasuredResult& result) {
  const auto count = std::ranges::count_if(result.loss_weight, [](double w) { return w < 0.5; });
  if (count == 0) return "";
  return fmt::format("The loss leaves {} samples less than half their weight.\n\n", count);
}

}  // namespace

std::string brief_report(const MeasuredResult& result) {
  const auto open = std::ranges::count_if(result.unknowns,
                                          [](const UnknownRow& row) { return !row.identifiable; });
  return fmt::format("{}: luminance error {:.3g} %{}, {} samples, {}{}", result.preset.name,
                     result.errors.luminance,
                     std::isfinite(result.errors.spectral)
                         ? fmt::format(", spectral error {:.3g} %", result.errors.spectral)
                         : "",
                     result.samples, result.converged ? "converged" : "NOT CONVERGED",
                     open > 0 ? fmt::format(", {} unknowns not identifiable", open) : "");
}

std::string full_report(const MeasuredResult& result, const MeasuredChecks& checks) {
  return header(result) + reference_remarks(result.reference) + errors_text(result) +
         unknowns_text(result) + pulled_text(result) + downweighted_text(result) +
         findings_text(result) + correlation_text(result) + profiles_text(checks.profiles) +
         (checks.bootstrap ? bootstrap_text(result, *checks.bootstrap) : "") +
         hold_out_text(checks.hold_outs) + fmt::format("Time: {:.3g} s.\n", result.wall_seconds);
}

}  // namespace skyfit::fit
