// SPDX-License-Identifier: Apache-2.0
#include "fit/result/report_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "data_refs/units.h"
#include "model/base/counted.h"
#include "model/base/misfit.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

// All but those of irradiances alone, beside a sky.
std::ptrdiff_t scans_of_sky(const Result& result) {
  if (!result.reference.irradiance_quantity) return std::ssize(result.scans);
  return std::ranges::count_if(result.scans,
                               [](const ScanOutcome& scan) { return scan.directions > 0; });
}

// What a pull may stand for.
std::string pull_reason(const Unknown& unknown) {
  const auto is = [&](const Parameter& id) {
    return unknown.what == std::variant<Parameter, Instrument>(id);
  };
  if (is(Parameter::kMieSingleScatteringAlbedo))
    return "; an unknown calibration (--scale) may be what it stands for";
  if (is(Parameter::kRayleighPressure))
    return "; the air weighs what the site's pressure says (--site-pressure-hpa, elevation_m), so "
           "that\nit stands for something else: the calibration (--scale), an absorber, the "
           "aerosol";
  return "";
}

}  // namespace

std::string number_text(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : std::string("-");
}

std::string likelihood_text(const Result& result) {
  const Likelihood& likelihood = result.likelihood;
  std::string text = fmt::format("{} residuals, scale {}, pointing {}", link_name(likelihood.link),
                                 scale_name(likelihood.scale), pointing_name(result.pointing));
  if (likelihood.noise_is_known) text += ", noise known";
  if (likelihood.loss != Loss::kNone)
    text += fmt::format(", {} loss of {:.3g} sigmas", loss_name(likelihood.loss),
                        likelihood.loss_width);
  return text;
}

std::string scan_name(const Result& result, std::size_t scan) {
  const ScanInfo& info = result.scans[scan].info;
  const std::string name = info.name.substr(info.name.rfind('/') + 1);
  return fmt::format("[{}] {}, sun {:.4g} deg", scan + 1, name.substr(0, 24),
                     info.sun_zenith * kDegreesPerRadian);
}

std::string effort_text(const Result& result) {
  const std::ptrdiff_t starts = std::ssize(result.starts);
  return fmt::format(
      "{} of {}{}; {}, {} with derivatives", counted(result.iterations, "iteration"),
      starts > 1 ? "all " : "", counted(starts, "start"),
      counted(result.model_evaluations + result.derivative_evaluations, "model solution"),
      result.derivative_evaluations);
}

std::string samples_text(const Result& result) {
  if (refs::is_irradiance(result.reference.quantity))
    return fmt::format("{} under {}", result.samples, counted(std::ssize(result.scans), "sun"));
  std::string text =
      fmt::format("{} in {} of {}, {:.4g} deg around the sun left out", result.samples,
                  counted(result.directions, "direction"), counted(scans_of_sky(result), "scan"),
                  result.exclude_sun * kDegreesPerRadian);
  int beside = 0;
  for (const IrradianceErrors& errors : result.irradiances) beside += errors.samples;
  if (beside > 0) {
    text += fmt::format(
        "; with {}, log residuals, scale fixed, noise known",
        counted(beside, refs::quantity_name(result.reference.irradiance_quantity.value())));
  }
  return text;
}

std::string irradiances_title(const Result& result) {
  const bool lux = result.reference.irradiance_quantity == refs::Quantity::kIlluminance;
  return fmt::format("{} beside the sky, percent", lux ? "Illuminances" : "Irradiances");
}

std::string value_name(const Result& result) {
  return std::string(refs::is_irradiance(result.reference.quantity)
                         ? refs::quantity_name(result.reference.quantity)
                         : "luminance");
}

std::string errors_meaning(const Result& result) {
  std::string value_meaning =
      fmt::format("of model / value - 1 over the {}",
                  refs::is_irradiance(result.reference.quantity) ? "samples" : "directions");
  if (!std::isfinite(result.errors.luminance)) value_meaning = "the wavelengths give none";
  return fmt::format(
      "RMS of log: root mean square of ln(model / value) with a free scale per scan, above {:g} %\n"
      "its exponential as a factor; {}: {}; spectral:\n"
      "|model - value| over |value|, 2-norms over all samples of 400 to 700 nm.\n",
      kMostPercent, value_name(result), value_meaning);
}

std::string interval_text(const Profile& profile, const Interval& interval) {
  if (profile.value.empty()) return "-";
  const auto end = [](double value, double last) {
    return std::isfinite(value) ? number_text(value) : "beyond " + number_text(last);
  };
  return fmt::format("{} to {}", end(interval.lower, profile.value.front()),
                     end(interval.upper, profile.value.back()));
}

std::string hold_outs_meaning() {
  return "A scan left out is predicted with the mean instrument of the others (a profiled scale is "
         "its own),\nthen with its own pointing fitted.\n";
}

std::string remark_text(const UnknownRow& row) {
  if (row.at_bound) {
    const double value = row.fitted * row.unknown.unit_value();
    const bool lower = value - row.unknown.lower < row.unknown.upper - value;
    return fmt::format("at {} bound", lower ? "lower" : "upper");
  }
  return row.identifiable ? "" : "not identifiable";
}

std::string prior_text(const UnknownRow& row) {
  const std::optional<Prior>& prior = row.unknown.prior;
  const double unit = row.unknown.unit_value();
  return prior ? fmt::format("{:.4g}+-{:.3g}", prior->mean / unit, prior->sigma / unit) : "none";
}

std::string_view polarisation_name(refs::Polarisation what) {
  switch (what) {
    case refs::Polarisation::kQ:
      return "Q / I";
    case refs::Polarisation::kU:
      return "U / I";
    case refs::Polarisation::kDegree:
      break;
  }
  return "degree of linear polarisation";
}

std::string sigma_text(const Result& result) {
  std::string text;
  int readings = 0;
  for (const PolarisationErrors& errors : result.polarisation) readings += errors.readings;
  if (result.likelihood.noise_is_known) {
    text = fmt::format(
        "One sigma is from the known noise ({:.3g} % root mean square) and the priors; {}.\n",
        result.sigma_percent,
        std::isfinite(result.chi_square_per_dof)
            ? fmt::format(
                  "chi^2 per degree of\nfreedom = {:.4g} (well above 1 the misfit is larger "
                  "than the noise,\nwell below 1 the noise is stated too large)",
                  result.chi_square_per_dof)
            : "data and priors\ndetermine as much as there is, so that chi^2 says nothing");
  } else {
    text = fmt::format(
        "One sigma is from the residuals and the priors: {:.3g} % per sample, {:.3g} times what is "
        "assumed.\nCorrelated as the residuals are, {} samples{} count as {:.3g} independent "
        "ones.\n{}",
        result.sigma_percent, result.sigma_factor, result.samples + readings,
        readings > 0 ? fmt::format(" ({} of polarisation)", readings) : "",
        result.effective_samples,
        std::isfinite(result.chi_square_per_dof)
            ? fmt::format("chi^2 per degree of freedom under the assumed noise: {:.4g}.\n",
                          result.chi_square_per_dof)
            : "Data and priors determine as much as there is: the residuals do not show the "
              "noise.\n");
  }
  return text +
         "\"not identifiable\": the data say less about the unknown than its prior (without one: "
         "than its\nbounds). An unknown at a bound has no sigma; the sigmas of the others hold for "
         "it at "
         "that\nbound.\n";
}

// A prior that the misfit overrides: the unknown is neither known nor at its prior. The pressure of
// the air is known better than a sky can tell it, so that it is said whatever the sky tells.
std::vector<std::string> pulled_priors(const Result& result) {
  constexpr double kPulled = 2;  // prior sigmas
  std::vector<std::string> sentences;
  for (const UnknownRow& row : result.unknowns) {
    const std::optional<Prior>& prior = row.unknown.prior;
    const bool is_air =
        row.unknown.what == std::variant<Parameter, Instrument>(Parameter::kRayleighPressure);
    if (!prior || (row.identifiable && !is_air)) continue;
    const double pull = (row.fitted * row.unknown.unit_value() - prior->mean) / prior->sigma;
    if (std::abs(pull) < kPulled) continue;
    sentences.push_back(
        fmt::format("{} is {:+.2g} prior sigmas from its prior: the misfit pulls it there{}.",
                    row.unknown.name(), pull, pull_reason(row.unknown)));
  }
  return sentences;
}

}  // namespace skyfit::fit
