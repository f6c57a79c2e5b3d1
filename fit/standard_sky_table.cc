// SPDX-License-Identifier: Apache-2.0
#include "fit/standard_sky_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "fit/result/report.h"
#include "model/base/misfit.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

double sun_deg(const ScanOutcome& scan) { return scan.info.sun_zenith * kDegreesPerRadian; }

bool is_same_sky(const Errors& errors) { return errors.rms_log <= kSameSkyPercent; }

std::string_view description_of(const StandardSkyFit& fit) {
  return fit.result.reference.description;
}

std::string findings_list(const std::vector<Finding>& found) {
  std::vector<std::string> parts;
  for (const Finding& finding : found)
    parts.push_back(fmt::format("{} {:.3g} (plausible {:.3g} to {:.3g})", finding.name,
                                finding.value, finding.lower, finding.upper));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string unknowns_list(const Result& result) {
  std::vector<std::string> parts;
  for (const UnknownRow& row : result.unknowns)
    parts.push_back(fmt::format("{} {:.4g}{}{}", row.unknown.name(), row.fitted,
                                row.unknown.unit() == "1" ? "" : " ",
                                row.unknown.unit() == "1" ? "" : row.unknown.unit()));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string table_text(const std::vector<StandardSkyFit>& fits) {
  std::string text = fmt::format(
      "RMS of log ratio, percent, above {:g} a factor, of one joint fit for all suns; suns by "
      "zenith angle, "
      "deg\n{:<5}{:<18}{:>7}",
      kMostPercent, "type", "fitted with", "joint");
  for (const ScanOutcome& scan : fits.front().result.scans)
    text += fmt::format("{:>7}", fmt::format("{:.4g}", sun_deg(scan)));
  text += "  plausible\n";
  for (const StandardSkyFit& fit : fits) {
    text += fmt::format("{:<5}{:<18}{:>7}", fit.type, fit.kind,
                        log_misfit_digits(fit.result.errors.rms_log, 3));
    for (const ScanOutcome& scan : fit.result.scans)
      text += fmt::format("{:>7}", log_misfit_digits(scan.errors.rms_log, 3));
    text += implausible_findings(fit.result).empty() ? "  yes" : "  no";
    text += fit.result.converged ? "\n" : ", NOT CONVERGED\n";
  }
  return text + "\n";
}

std::string parameters_text(const std::vector<StandardSkyFit>& fits) {
  std::string text = "What was found\n";
  for (const StandardSkyFit& fit : fits) {
    text += fmt::format("type {}: {}\n", fit.type, unknowns_list(fit.result));
    if (const auto bounds = unknowns_at_bounds(fit.result); !bounds.empty())
      text += fmt::format("    at a bound: {}\n", fmt::join(bounds, ", "));
    if (const auto found = implausible_findings(fit.result); !found.empty())
      text += fmt::format("    not plausible: {}\n", findings_list(found));
  }
  return text + "\n";
}

// "10, 20 and 30 deg"
std::string suns_within(const Result& result) {
  std::vector<std::string> suns;
  for (const ScanOutcome& scan : result.scans) {
    if (is_same_sky(scan.errors)) suns.push_back(fmt::format("{:.4g}", sun_deg(scan)));
  }
  if (suns.empty()) return fmt::format("within {:.3g} % under none of the suns", kSameSkyPercent);
  return fmt::format("within {:.3g} % under suns at {} deg", kSameSkyPercent,
                     fmt::join(suns, ", "));
}

std::string words(const std::vector<StandardSkyFit>& fits) {
  std::string can, cannot;
  int count = 0;
  for (const StandardSkyFit& fit : fits) {
    if (is_same_sky(fit.result.errors)) {
      ++count;
      const std::vector<Finding> found = implausible_findings(fit.result);
      can += fmt::format("  {}: {:.3g} % with {}{}\n", description_of(fit),
                         fit.result.errors.rms_log, fit.kind,
                         found.empty() ? "" : ", but not plausible: " + findings_list(found));
      continue;
    }
    const ScanOutcome& worst = *std::ranges::max_element(
        fit.result.scans, {}, [](const ScanOutcome& scan) { return scan.errors.rms_log; });
    cannot +=
        fmt::format("  {}: {} with {}; worst {} under a sun at {:.4g} deg, {}\n",
                    description_of(fit), log_misfit_digits_with_unit(fit.result.errors.rms_log, 3),
                    fit.kind, log_misfit_digits_with_unit(worst.errors.rms_log, 3), sun_deg(worst),
                    suns_within(fit.result));
  }
  std::string text = fmt::format(
      "One horizontally uniform atmosphere for all suns can be {} of the {} standard skies within "
      "{:.3g} %{}\n{}",
      count, fits.size(), kSameSkyPercent, count > 0 ? ":" : ".", can);
  if (!cannot.empty()) text += "It cannot be:\n" + cannot;
  return text;
}

// Every parameter that is free in one of the fits, in the order of their appearance.
std::vector<std::string> parameter_names(const std::vector<StandardSkyFit>& fits) {
  std::vector<std::string> names;
  for (const StandardSkyFit& fit : fits) {
    for (const UnknownRow& row : fit.result.unknowns) {
      if (std::ranges::count(names, row.unknown.name()) == 0) names.push_back(row.unknown.name());
    }
  }
  return names;
}

}  // namespace

std::vector<Finding> implausible_findings(const Result& result) {
  std::vector<Finding> found = findings(result.preset.atmosphere);
  std::erase_if(found, [](const Finding& finding) { return finding.plausible(); });
  return found;
}

std::vector<std::string> unknowns_at_bounds(const Result& result) {
  std::vector<std::string> names;
  for (const UnknownRow& row : result.unknowns) {
    if (row.at_bound) names.push_back(row.unknown.name());
  }
  return names;
}

std::string standard_skies_text(const std::vector<StandardSkyFit>& fits) {
  double seconds = 0;
  for (const StandardSkyFit& fit : fits) seconds += fit.result.wall_seconds;
  return table_text(fits) + parameters_text(fits) + words(fits) +
         fmt::format("\nTime: {:.3g} s.\n", seconds);
}

std::string standard_skies_csv(const std::vector<StandardSkyFit>& fits) {
  const std::vector<std::string> names = parameter_names(fits);
  std::string text = "type,fitted_with,rms_log_percent";
  for (const ScanOutcome& scan : fits.front().result.scans)
    text += fmt::format(",rms_log_percent_sun_{:.9g}", sun_deg(scan));
  text += fmt::format(",plausible,converged,{}\n", fmt::join(names, ","));
  for (const StandardSkyFit& fit : fits) {
    text += fmt::format("{},{},{:.9g}", fit.type, fit.kind, fit.result.errors.rms_log);
    for (const ScanOutcome& scan : fit.result.scans)
      text += fmt::format(",{:.9g}", scan.errors.rms_log);
    text += fmt::format(",{},{}", implausible_findings(fit.result).empty() ? "yes" : "no",
                        fit.result.converged ? "yes" : "no");
    for (const std::string& name : names) {
      const auto row = std::ranges::find(
          fit.result.unknowns, name, [](const UnknownRow& each) { return each.unknown.name(); });
      text += row == fit.result.unknowns.end() ? "," : fmt::format(",{:.9g}", row->fitted);
    }
    text += "\n";
  }
  return text;
}

nlohmann::json standard_skies_json(const std::vector<StandardSkyFit>& fits) {
  nlohmann::json rows = nlohmann::json::array();
  for (const StandardSkyFit& fit : fits) {
    nlohmann::json row = report_json(fit.result, {});
    row["type"] = fit.type;
    row["fitted_with"] = fit.kind;
    row["plausible"] = implausible_findings(fit.result).empty();
    row["is_the_sky_within_percent"] =
        is_same_sky(fit.result.errors) ? nlohmann::json(kSameSkyPercent) : nlohmann::json(nullptr);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace skyfit::fit
