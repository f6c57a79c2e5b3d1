// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "fit/result/findings.h"
#include "fit/result/record.h"
#include "fit/result/report.h"
#include "fit/result/report_words.h"
#include "model/base/counted.h"
#include "model/base/misfit.h"

namespace skyfit::fit {
namespace {

constexpr Eigen::Index kFullMatrix = 11;  // unknowns whose correlations fit 100 columns

std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

bool relative(const Result& result) {
  return result.reference.quantity == refs::Quantity::kRelativeLuminance;
}

std::string header(const Result& result) {
  return fmt::format(
      "Fit of {}\n"
      "reference   {}\n"
      "model       {} ({} transfer, skyfit {}), started from {}\n"
      "likelihood  {}\n"
      "samples     {}\n"
      "solver      {} after {}\n\n",
      result.preset.name, result.reference.description, result.model_name,
      transfer_name(result.transfer), result.version, result.start_name, likelihood_text(result),
      samples_text(result), result.termination, effort_text(result));
}

// What is known of the reference, and its samples without weight by reason.
std::string reference_remarks(const Result& result) {
  std::string text;
  for (const std::string& note : result.reference.notes)
    text += fmt::format("note        {}\n", note);
  for (const auto& [reason, count] : result.samples_left_out)
    text += fmt::format("left out    {}: {}\n", counted(count, "sample"), reason);
  return text.empty() ? text : text + "\n";
}

std::string errors_text(const Result& result) {
  constexpr std::string_view kRow = "{:<44}{:>12}{:>12}{:>12}{:>12}\n";
  const auto row = [&](std::string_view name, const Errors& errors) {
    return fmt::format(kRow, name, log_misfit_digits(errors.rms_log, 4),
                       number_text(errors.luminance, 4), number_text(errors.spectral, 4),
                       number_text(errors.mean_bias, 3));
  };
  std::string text = fmt::format(kRow, "Errors, percent", "RMS of log", value_name(result),
                                 "spectral", "mean bias");
  text += row("all scans, at the start", result.start_errors);
  text += row("all scans, fitted", result.errors);
  for (std::size_t s = 0; s < result.scans.size(); ++s)
    text += row(scan_name(result, s), result.scans[s].errors);
  return text + errors_meaning(result) + "\n";
}

std::string polarisation_text(const Result& result) {
  if (result.polarisation.empty()) return "";
  constexpr std::string_view kRow = "{:<44}{:>12}{:>12}{:>12}{:>12}\n";
  std::string text = fmt::format(kRow, "Polarisation, RMS in percentage points", "readings",
                                 "start", "fitted", "one sigma");
  for (const PolarisationErrors& errors : result.polarisation) {
    text += fmt::format(kRow, polarisation_name(errors.what), errors.readings,
                        number_text(errors.start_rms, 4), number_text(errors.rms, 4),
                        number_text(errors.sigma, 3));
  }
  return text + "\n";
}

std::string irradiances_text(const Result& result) {
  if (result.irradiances.empty()) return "";
  constexpr std::string_view kRow = "{:<44}{:>10}{:>12}{:>12}{:>12}{:>12}\n";
  std::string text = fmt::format(kRow, irradiances_title(result), "samples", "start", "fitted",
                                 "mean bias", "one sigma");
  for (const IrradianceErrors& errors : result.irradiances) {
    text += fmt::format(kRow, kIrradianceNames[errors.what], errors.samples,
                        number_text(errors.start_rms, 4), number_text(errors.rms, 4),
                        number_text(errors.mean_bias, 3), number_text(errors.sigma, 3));
  }
  return text + "\n";
}

std::string rms_text(const Result& result) {
  if (refs::is_irradiance(result.reference.quantity)) return "";  // the errors say it all
  const auto row = [](std::string_view name, double start, double fitted) {
    return fmt::format("{:<52}{:>12}{:>12}\n", name, log_misfit_digits(start, 5),
                       log_misfit_digits(fitted, 5));
  };
  const RmsSummary &start = result.start_rms, &fitted = result.rms;
  return fmt::format("{:<52}{:>12}{:>12}\n", "RMS of log ratio, percent", "start", "fitted") +
         row("all fitted samples", start.all, fitted.all) +
         row("3 deg around the sun left out", start.cone3, fitted.cone3) +
         row("10 deg around the sun left out", start.cone10, fitted.cone10) +
         row("sun zenith <= 70 deg", start.sun_below_70, fitted.sun_below_70) + "\n";
}

// The profiled scales; those that are unknowns stand among these.
std::string scales_text(const Result& result) {
  if (result.likelihood.scale != Scale::kProfiled) return "";
  std::string text =
      fmt::format("{:<44}{:>14}{:>14}{:>18}\n", "Per scan, percent and scale (value / model)",
                  "RMS start", "RMS fitted", "scale");
  for (std::size_t s = 0; s < result.scans.size(); ++s) {
    const ScanOutcome& scan = result.scans[s];
    text += fmt::format("{:<44}{:>14}{:>14}{:>18}\n", scan_name(result, s),
                        log_misfit_digits(scan.start_errors.rms_log, 4),
                        log_misfit_digits(scan.errors.rms_log, 4),
                        number_text(scan.instrument[static_cast<std::size_t>(Instrument::kScale)]));
  }
  return text + "\n";
}

std::string fixed_text(const Result& result) {
  std::string text;
  for (const FixedRow& row : result.fixed) {
    text += fmt::format("{:<28} {:<4}{:>9}{:>11}{:>10} fixed\n", row.parameter.name(),
                        parameter_info(row.parameter).unit, number_text(row.start, 4),
                        number_text(row.value), "-");
  }
  return text;
}

std::string unknowns_text(const Result& result) {
  constexpr std::string_view kRow = "{:<28} {:<4}{:>9}{:>11}{:>10} {:<20}{}";
  std::string text = trimmed(fmt::format(kRow, "unknown ([scan])", "unit", "start", "fitted",
                                         "one sigma", "prior", "remark"));
  for (const UnknownRow& row : result.unknowns) {
    text += trimmed(fmt::format(kRow, row.unknown.name(), row.unknown.unit(),
                                number_text(row.start, 4), number_text(row.fitted),
                                number_text(row.sigma, 3), prior_text(row), remark_text(row)));
  }
  return text + fixed_text(result) + "\n" + sigma_text(result) + "\n";
}

std::string pulled_text(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + "\n";
  return text.empty() ? text : text + "\n";
}

std::string correlation_text(const Result& result) {
  if (result.covariance_unknowns.empty()) return "No covariance: every unknown is at a bound.\n\n";
  if (result.correlation.size() == 0) {
    return "The covariance is singular: data and priors leave a direction open (see the unknowns "
           "without sigma).\nCondition number of the normal matrix: infinite.\n\n";
  }
  const auto name = [&](Eigen::Index k) {
    return result
        .unknowns[static_cast<std::size_t>(result.covariance_unknowns[static_cast<std::size_t>(k)])]
        .unknown.name();
  };
  const Eigen::Index count = result.correlation.rows();
  std::string text = fmt::format(
      "Correlations{} (condition number of the normal matrix with unit diagonal: {:.3g})\n",
      count > kFullMatrix ? " of at least 0.5" : "", result.condition_number);
  if (count > kFullMatrix) {
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j < i; ++j) {
        const double value = result.correlation(i, j);
        if (std::abs(value) >= 0.5)
          text += fmt::format("{:<32}{:<32}{:>7.2f}\n", name(j), name(i), value);
      }
    }
    return text + "\n";
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    text += fmt::format("{:>2} {:<29}", i + 1, name(i));
    for (Eigen::Index j = 0; j <= i; ++j) text += fmt::format("{:>6.2f}", result.correlation(i, j));
    text += "\n";
  }
  text += fmt::format("{:32}", "");
  for (Eigen::Index j = 0; j < count; ++j) text += fmt::format("{:>6}", j + 1);
  return text + "\n\n";
}

std::string starts_text(const Result& result) {
  std::string text = "Starts (cost: half the sum of squares of the coarse search, a pure number)\n";
  for (std::size_t i = 0; i < result.starts.size(); ++i) {
    const StartSummary& start = result.starts[i];
    text += fmt::format("{:>3}  {:<50}{:>14} in {:>3} iterations{}\n", i + 1, start.name,
                        std::isfinite(start.cost) ? number_text(start.cost) : "failed",
                        start.iterations, start.best ? "  best" : "");
  }
  return text + "\n";
}

std::string findings_text(const Result& result) {
  std::string text =
      fmt::format("{:<42}{:>12}  {}\n", "Physics found", "value", "plausible, source");
  for (const Finding& finding : findings(result.preset.atmosphere)) {
    text += fmt::format("{:<42}{:>12}  {:.3g}..{:.3g}{}\n    {}\n", finding.name,
                        number_text(finding.value, 4), finding.lower, finding.upper,
                        finding.plausible() ? "" : " NO", finding.source);
  }
  return text + "\n";
}

std::string profiles_text(const std::vector<Profile>& profiles) {
  std::string text;
  for (const Profile& profile : profiles) {
    text += fmt::format("Profile likelihood of {}, {}: 68 % {}, 95 % {}\n", profile.name,
                        profile.unit, interval_text(profile, profile.percent68),
                        interval_text(profile, profile.percent95));
    for (std::size_t i = 0; i < profile.value.size(); ++i)
      text += fmt::format("  {:>12}  chi^2 + {:.4g}\n", number_text(profile.value[i]),
                          profile.chi_square[i]);
    text += "\n";
  }
  return text;
}

std::string bootstrap_text(const Result& result, const Bootstrap& bootstrap) {
  std::string text = fmt::format(
      "Bootstrap over the directions (not the priors), {} repetitions{}; drawn one by one, so "
      "that\n"
      "its sigma is too small where the residuals of neighbours agree\n{:<32}{:>12}{:>12}{:>22}\n",
      bootstrap.repetitions,
      bootstrap.failed > 0 ? fmt::format(", {} failed", bootstrap.failed) : "", "unknown", "mean",
      "sigma", "sigma of covariance");
  for (std::size_t u = 0; u < result.unknowns.size(); ++u) {
    text += fmt::format("{:<32}{:>12}{:>12}{:>22}\n", result.unknowns[u].unknown.name(),
                        number_text(bootstrap.mean[u]), number_text(bootstrap.sigma[u], 3),
                        number_text(result.unknowns[u].sigma, 3));
  }
  return text + "\n";
}

std::string hold_out_text(const std::vector<HoldOut>& hold_outs) {
  if (hold_outs.empty()) return "";
  constexpr std::string_view kRow = "{:<38}{:>10}{:>10}{:>10}{:>12}{:>10}{:>10}\n";
  std::string text = fmt::format(kRow, "Errors of what was left out, percent", "RMS log",
                                 "luminance", "spectral", "own: RMS", "luminance", "spectral");
  const auto row = [&](std::string_view name, const Errors& predicted, const Errors& pointed) {
    return fmt::format(kRow, name, log_misfit_digits(predicted.rms_log, 4),
                       number_text(predicted.luminance, 4), number_text(predicted.spectral, 4),
                       log_misfit_digits(pointed.rms_log, 4), number_text(pointed.luminance, 4),
                       number_text(pointed.spectral, 4));
  };
  Errors predicted, pointed;
  const auto add = [&](Errors& sum, const Errors& errors) {
    const auto count = static_cast<double>(hold_outs.size());
    sum.rms_log += errors.rms_log / count;
    sum.luminance += errors.luminance / count;
    sum.spectral += errors.spectral / count;
  };
  for (const HoldOut& held : hold_outs) {
    text +=
        row(held.name.substr(held.name.rfind('/') + 1).substr(0, 37), held.predicted, held.pointed);
    add(predicted, held.predicted);
    add(pointed, held.pointed);
  }
  return text + row("mean", predicted, pointed) + hold_outs_meaning() + "\n";
}

std::string downweighted_text(const Result& result) {
  if (result.downweighted == 0) return "";
  return fmt::format("The loss leaves {} less than half their weight.\n\n",
                     counted(result.downweighted, "sample"));
}

}  // namespace

std::string brief_report(const Result& result) {
  const auto open = std::ranges::count_if(result.unknowns,
                                          [](const UnknownRow& row) { return !row.identifiable; });
  std::vector<std::string> absolute;
  if (!relative(result) && std::isfinite(result.errors.luminance)) {
    absolute.push_back(
        fmt::format("{} error {:.3g} %", value_name(result), result.errors.luminance));
  }
  if (!relative(result) && std::isfinite(result.errors.spectral))
    absolute.push_back(fmt::format("spectral error {:.3g} %", result.errors.spectral));
  const std::string errors =
      absolute.empty() ? fmt::format("{} RMS log error ({} at the start)",
                                     log_misfit_digits_with_unit(result.errors.rms_log, 3),
                                     log_misfit_digits_with_unit(result.start_errors.rms_log, 3))
                       : fmt::format("{}", fmt::join(absolute, ", "));
  return fmt::format(
      "{}: {}, {}, {}{}", result.preset.name, errors, counted(result.samples, "sample"),
      result.converged ? "converged" : "NOT CONVERGED",
      open > 0 ? fmt::format(", {} not identifiable", counted(open, "unknown")) : "");
}

std::string full_report(const Result& result, const Checks& checks) {
  return header(result) + reference_remarks(result) + errors_text(result) +
         polarisation_text(result) + irradiances_text(result) + rms_text(result) +
         scales_text(result) + unknowns_text(result) + pulled_text(pulled_priors(result)) +
         downweighted_text(result) + correlation_text(result) + findings_text(result) +
         starts_text(result) + profiles_text(checks.profiles) +
         (checks.bootstrap ? bootstrap_text(result, *checks.bootstrap) : "") +
         hold_out_text(checks.hold_outs) + fmt::format("Time: {:.3g} s.\n", result.wall_seconds);
}

nlohmann::json report_json(const Result& result, const Checks& checks) {
  nlohmann::json report = result.preset.fit;
  report["name"] = result.preset.name;
  report["checks"] = checks_json(result, checks);
  return report;
}

}  // namespace skyfit::fit
