// SPDX-License-Identifier: Apache-2.0
#include "cli/measured_fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "cli/arguments.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "data_refs/absorption_bands.h"
#include "data_refs/ground_spectra.h"
#include "data_refs/spectra.h"
#include "fit/problem/free_parameters.h"
#include "fit/result/measured_report.h"
#include "model/sky_model.h"
#include "render/plot/measured_csv.h"
#include "render/plot/measured_figures.h"

namespace skyfit::cli {
namespace {

constexpr std::string_view kGroup = "Measured skies";
constexpr std::string_view kScans = "scans";
constexpr const char *kPresetFile = "preset.json", *kReportFile = "report.json",
                     *kReportTextFile = "report.txt", *kMeasuredFile = "measured.csv";

constexpr const char* kFigureExtensions[] = {".svg", ".png"};

template <class Enum, std::size_t N>
Enum parse_choice(std::string_view option, const std::string& text,
                  const std::array<std::pair<std::string_view, Enum>, N>& choices) {
  std::vector<std::string_view> names;
  for (const auto& [name, value] : choices) {
    if (name == text) return value;
    names.push_back(name);
  }
  throw UsageError(option, text, fmt::format("expected one of {}", fmt::join(names, ", ")));
}

constexpr std::array<std::pair<std::string_view, fit::Calibration>, 3> kCalibrations = {
    {{"absolute", fit::Calibration::kAbsolute},
     {"shared", fit::Calibration::kSharedScale},
     {"per-scan", fit::Calibration::kScalePerScan}}};
constexpr std::array<std::pair<std::string_view, fit::Pointing>, 3> kPointings = {
    {{"stated", fit::Pointing::kStated},
     {"azimuth", fit::Pointing::kAzimuth},
     {"tilt", fit::Pointing::kAzimuthAndTilt}}};
constexpr std::array<std::pair<std::string_view, fit::Loss>, 3> kLosses = {
    {{"none", fit::Loss::kNone}, {"huber", fit::Loss::kHuber}, {"cauchy", fit::Loss::kCauchy}}};

// RELATIVE or RELATIVE:FLOOR.
fit::NoiseModel parse_noise(const std::string& text) {
  constexpr std::string_view kOption = "--noise";
  const std::size_t colon = text.find(':');
  fit::NoiseModel noise{parse_number(kOption, text.substr(0, colon)), 0};
  if (colon != std::string::npos) noise.floor = parse_number(kOption, text.substr(colon + 1));
  if (noise.relative < 0 || noise.floor < 0 || noise.relative + noise.floor == 0)
    throw UsageError(kOption, text, "expected RELATIVE[:FLOOR], both >= 0 and one > 0");
  return noise;
}

// The directions' parts of a random hold-out; 0: whole scans.
int parse_hold_out(const std::string& text) {
  constexpr std::string_view kOption = "--hold-out";
  if (text == kScans) return 0;
  const double parts = parse_number(kOption, text);
  if (parts < 2 || parts > 100 || parts != std::floor(parts))
    throw UsageError(kOption, text, "expected scans, or into how many parts (2 to 100)");
  return static_cast<int>(parts);
}

void apply(const MeasuredArguments& arguments, fit::MeasuredOptions& options) {
  if (!arguments.per_scan.empty()) {
    const std::vector<Parameter> names = parse_parameters("--per-scan", arguments.per_scan);
    options.per_scan = {names.begin(), names.end()};
  }
  options.calibration = parse_choice("--scale", arguments.scale, kCalibrations);
  options.pointing = parse_choice("--pointing", arguments.pointing, kPointings);
  options.loss = parse_choice("--loss", arguments.loss, kLosses);
  if (!arguments.noise.empty()) {
    options.noise = parse_noise(arguments.noise);
    options.noise_is_stated = true;
  }
  if (!arguments.ground.empty()) options.ground = refs::ground_spectrum(arguments.ground);
  if (!arguments.hold_out.empty()) parse_hold_out(arguments.hold_out);
}

fit::MeasuredChecks checks_of(const MeasuredArguments& arguments, const SkyModel& model,
                              const fit::MeasuredOptions& options,
                              const fit::MeasuredResult& result) {
  const SpectralData spectra = refs::spectral_data_of(fit::start_atmosphere(options.common));
  const auto seed = static_cast<std::uint64_t>(arguments.seed);
  fit::MeasuredChecks checks;
  for (const std::string& name : arguments.profiles)
    checks.profiles.push_back(fit::profile_likelihood(spectra, model, options, result, name));
  if (arguments.bootstrap > 0)
    checks.bootstrap = fit::bootstrap(spectra, model, options, result, arguments.bootstrap, seed);
  if (arguments.hold_out.empty()) return checks;
  const int parts = parse_hold_out(arguments.hold_out);
  checks.hold_outs = parts == 0
                         ? fit::leave_one_scan_out(spectra, model, options, result)
                         : fit::hold_out_directions(spectra, model, options, result, parts, seed);
  return checks;
}

std::vector<plot::MeasuredSample> measured_samples(const fit::MeasuredResult& result) {
  std::vector<plot::MeasuredSample> samples;
  for (std::size_t i = 0; i < result.reference.samples.size(); ++i) {
    const refs::Sample& s = result.reference.samples[i];
    if (!std::isfinite(result.model[i])) continue;  // outside the model's spectra
    const auto scan = std::ranges::find(
        result.scans, s.scan, [](const fit::ScanOutcome& outcome) { return outcome.info.number; });
    const SkyPoint point =
        fit::pointed({0, s.sun_zenith, s.view_zenith, s.relative_azimuth},
                     scan->info.sun_azimuth + s.sun_azimuth_since, scan->instrument);
    const bool fitted = std::isfinite(result.sigma[i]);
    samples.push_back({static_cast<int>(scan - result.scans.begin()) + 1, degrees(s.sun_zenith),
                       degrees(point.view_zenith), degrees(point.relative_azimuth), s.wavelength_nm,
                       s.value, fitted ? result.sigma[i] : 0, result.model[i],
                       fitted ? s.weight : 0});
  }
  return samples;
}

void write_figures(const std::filesystem::path& directory, Figures& figures) {
  const plot::MeasuredOutcome outcome = plot::read_measured_outcome(directory);
  for (const std::string_view name : plot::measured_figure_names()) {
    const plot::MeasuredFigure figure = plot::measured_figure_from_name(name);
    if (!plot::can_draw(figure, outcome)) continue;
    std::vector<std::filesystem::path> files;
    for (const char* extension : kFigureExtensions)
      files.push_back(directory / fmt::format("{}{}", name, extension));
    figures.draw(directory, name, [&, &shown = outcome] {
      plot::write_figure(plot::measured_figure(figure, {&shown, 1}), files);
    });
  }
}

void add_check_options(CLI::App& command, MeasuredArguments& arguments) {
  command
      .add_option("--profile", arguments.profiles,
                  "Profile likelihood of an unknown, named as in the report; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->group(std::string(kGroup));
  command
      .add_option("--bootstrap", arguments.bootstrap, "Repeat with resampled directions so often")
      ->check(CLI::Range(0, 100000).description(""))
      ->group(std::string(kGroup));
  command
      .add_option("--hold-out", arguments.hold_out,
                  "Errors of what is left out of the fit: each scan in turn, or each of N parts of "
                  "the directions")
      ->type_name("scans|N")
      ->group(std::string(kGroup));
  command.add_option("--seed", arguments.seed, "Seed of --bootstrap and --hold-out N")
      ->check(CLI::Range(0, 2147483647).description(""))
      ->group(std::string(kGroup))
      ->capture_default_str();
}

}  // namespace

void add_measured_options(CLI::App& command, MeasuredArguments& arguments) {
  arguments.scale = kCalibrations[0].first;
  arguments.pointing = kPointings[1].first;
  arguments.loss = kLosses[0].first;
  const auto add = [&](const std::string& name, std::string& text, const std::string& meaning,
                       const std::string& type) {
    return command.add_option(name, text, meaning)->type_name(type)->group(std::string(kGroup));
  };
  add("--per-scan", arguments.per_scan, "Free parameters of which every scan has its own",
      "NAME,NAME");
  add("--scale", arguments.scale,
      "Calibration: absolute, or an unknown scale, shared or per-scan (prior 1+-0.05)", "NAME");
  add("--pointing", arguments.pointing,
      "Pointing: stated, an unknown azimuth offset per scan (azimuth), or two tilts as well (tilt)",
      "NAME");
  add("--noise", arguments.noise,
      "Known noise, relative and absolute, which the residuals do not rescale; by default 0.05 "
      "times a factor that the residuals show",
      "RELATIVE[:FLOOR]");
  add("--loss", arguments.loss,
      "Robust loss of a direction's mean square residual: none, huber or cauchy", "NAME");
  add("--ground", arguments.ground,
      fmt::format(
          "How the ground's albedo depends on wavelength: {}; by default as the preset says",
          fmt::join(refs::ground_names(), ", ")),
      "NAME|FILE");
  command
      .add_flag("--keep-absorption-bands", arguments.keep_absorption_bands,
                "Fit the bands too where oxygen, water vapour, carbon dioxide and methane absorb")
      ->group(std::string(kGroup));
  add_check_options(command, arguments);
}

bool is_measured_fit(const CLI::App& command, const refs::Reference& reference) {
  std::set<int> scans;
  for (const refs::Sample& sample : reference.samples) scans.insert(sample.scan);
  std::string given;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group() == kGroup && option->count() > 0) given = option->get_name();
  }
  if (reference.quantity == refs::Quantity::kRelativeLuminance) {
    if (!given.empty())
      throw UsageError(given, reference.name,
                       "expected an absolute or spectral reference with this option");
    return false;
  }
  return reference.quantity == refs::Quantity::kSpectralRadiance || !given.empty();
}

std::vector<std::string> measured_files() {
  std::vector<std::string> files = {kPresetFile, kReportFile, kReportTextFile, kMeasuredFile};
  for (const std::string_view name : plot::measured_figure_names()) {
    for (const char* extension : kFigureExtensions)
      files.push_back(fmt::format("{}{}", name, extension));
  }
  return files;
}

std::map<fit::Instrument, Prior> take_instrument_priors(std::vector<std::string>& priors) {
  std::map<fit::Instrument, Prior> result;
  std::vector<std::string> others;
  for (const std::string& text : priors) {
    const std::size_t equals = text.find('='), colon = text.find(':');
    const auto info = std::ranges::find(fit::instrument_table(), text.substr(0, equals),
                                        &fit::InstrumentInfo::name);
    if (info == fit::instrument_table().end()) {
      others.push_back(text);
      continue;
    }
    if (equals == std::string::npos || colon == std::string::npos || colon < equals)
      throw UsageError("--prior", text, "expected NAME=MEAN:SIGMA");
    result[info->id] = {parse_number("--prior", text.substr(equals + 1, colon - equals - 1)),
                        parse_number("--prior", text.substr(colon + 1))};
  }
  priors = others;
  return result;
}

void run_measured_fit(const MeasuredArguments& arguments, refs::Reference reference,
                      fit::MeasuredOptions options, const SkyModel& model, bool json,
                      const WholeDirectory& out) {
  apply(arguments, options);
  if (!arguments.keep_absorption_bands) refs::mask_absorption_bands(reference);
  fit::MeasuredResult result;
  fit::MeasuredChecks checks;
  {
    Progress progress("fitting " + reference.name);
    options.common.progress = [&](double fraction, const std::string& status) {
      progress.show(fraction, status);
    };
    result = fit::fit_measured(
        reference, refs::spectral_data_of(fit::start_atmosphere(options.common)), model, options);
    options.common.progress = {};
    checks = checks_of(arguments, model, options, result);
  }
  const std::string report = json_text(fit::report_json(result, checks));
  Figures figures;
  out.publish([&](const std::filesystem::path& staging) {
    write_file(staging / kPresetFile, preset_to_json(result.preset));
    write_file(staging / kReportFile, report);
    write_file(staging / kReportTextFile, fit::full_report(result, checks));
    write_file(staging / kMeasuredFile, plot::measured_to_csv(measured_samples(result)));
    write_figures(staging, figures);
  });
  if (!result.converged) {
    warn(fmt::format("the fit stopped before it converged: {}", result.termination));
  }
  print(json ? report : fit::brief_report(result) + "\n");
  figures.expect_all(reference.name);
}

}  // namespace skyfit::cli
