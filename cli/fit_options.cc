// SPDX-License-Identifier: Apache-2.0
#include "cli/fit_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cli/arguments.h"
#include "data_refs/ground_spectra.h"

namespace skyfit::cli {
namespace {

constexpr std::string_view kLikelihood = "Likelihood and instrument";
constexpr std::string_view kChecks = "Checks";
constexpr std::string_view kScans = "scans";

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

constexpr std::array<std::pair<std::string_view, fit::Link>, 2> kLinks = {
    {{"log", fit::Link::kLog}, {"linear", fit::Link::kLinear}}};
constexpr std::array<std::pair<std::string_view, fit::Scale>, 5> kScales = {
    {{"fixed", fit::Scale::kFixed},
     {"shared", fit::Scale::kShared},
     {"per-scan", fit::Scale::kPerScan},
     {"profiled", fit::Scale::kProfiled},
     {"absolute", fit::Scale::kFixed}}};  // an older spelling
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

// Takes the priors of the instrument out of `priors`.
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

void add_problem_options(CLI::App& command, FitArguments& options) {
  command.add_option(
      "--lobes", options.lobes,
      "Lobes of the aerosol's phase function: 1 or 2; by default 2, or the one that\n"
      "the model can tell");
  command.add_option("--starts", options.starts, "Starts of the phase parameters")
      ->capture_default_str();
  command.add_option("--max-iterations", options.max_iterations, "Iterations of one start")
      ->capture_default_str();
  command
      .add_option("--free", options.free, "Fit exactly these parameters; none evaluates the start")
      ->type_name("NAME,NAME");
  command.add_option("--fix", options.fix, "Hold parameters at a value")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command.add_option("--bounds", options.bounds, "Bounds of a free parameter, in place of its own")
      ->type_name("NAME=LOWER:UPPER")
      ->allow_extra_args(false);
  command.add_option("--prior", options.prior, "Gaussian prior, which replaces the default one")
      ->type_name("NAME=MEAN:SIGMA")
      ->allow_extra_args(false);
  command
      .add_option("--aeronet-aod", options.aeronet_aod,
                  "Aerosol optical depths of AERONET around the time of the scans: start and prior "
                  "of\nthe aerosol's optical depth at 550 nm and Angstrom exponent")
      ->type_name("FILE");
  command
      .add_option("--aeronet-inversion", options.aeronet_inversion,
                  "An inversion of AERONET: the same of the single scattering albedo, and of the\n"
                  "optical depth without --aeronet-aod; its asymmetry factor to compare")
      ->type_name("FILE");
  command.add_flag("--no-priors", options.no_priors, "Drop the default priors");
  command.add_option("--preset", options.preset, "Start from this preset")->type_name("FILE|NAME");
  add_site_pressure_option(command, options.site_pressure);
  command
      .add_option("--exclude-sun-deg", options.exclude_sun, "Leave out samples closer to the sun")
      ->type_name("ANGLE")
      ->capture_default_str();
}

void add_check_options(CLI::App& command, FitArguments& arguments) {
  command
      .add_option("--profile", arguments.profiles,
                  "Profile likelihood of an unknown, named as in the report; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->group(std::string(kChecks));
  command
      .add_option("--bootstrap", arguments.bootstrap, "Repeat with resampled directions so often")
      ->check(CLI::Range(0, 100000).description(""))
      ->group(std::string(kChecks));
  command
      .add_option("--hold-out", arguments.hold_out,
                  "Errors of what is left out of the fit: each scan in turn, or each of N parts of "
                  "the directions")
      ->type_name("scans|N")
      ->group(std::string(kChecks));
  command.add_option("--seed", arguments.seed, "Seed of --bootstrap and --hold-out N")
      ->check(CLI::Range(0, 2147483647).description(""))
      ->group(std::string(kChecks))
      ->capture_default_str();
}

void add_likelihood_options(CLI::App& command, FitArguments& arguments) {
  arguments.loss = kLosses[0].first;
  const auto add = [&](const std::string& name, std::string& text, const std::string& meaning,
                       const std::string& type) {
    return command.add_option(name, text, meaning)
        ->type_name(type)
        ->group(std::string(kLikelihood));
  };
  add("--per-scan", arguments.per_scan, "Free parameters of which every scan has its own",
      "NAME,NAME");
  add("--link", arguments.link,
      "Residuals of values (linear) or of their logarithms (log); by default log for a\n"
      "relative luminance and for irradiances, else linear",
      "NAME");
  add("--scale", arguments.scale,
      "fixed: values are absolute; an unknown scale, shared or per-scan (prior 1+-0.05); or\n"
      "profiled: every scan's own, solved for; by default profiled for a relative luminance,\n"
      "else fixed",
      "NAME");
  add("--pointing", arguments.pointing,
      "stated, or an unknown azimuth offset per scan (azimuth), or two tilts as well (tilt);\n"
      "by default stated for a relative luminance and irradiances, else azimuth",
      "NAME");
  add("--noise", arguments.noise,
      "Known noise, relative and absolute; by default 0.05 times a factor that the residuals\n"
      "show, or what the samples of a relative luminance state",
      "RELATIVE[:FLOOR]");
  add("--loss", arguments.loss,
      "Robust loss of a direction's mean square residual: none, huber or cauchy", "NAME");
  add("--ground", arguments.ground,
      fmt::format("How the ground's albedo depends on wavelength: {}; by default as the preset "
                  "says",
                  fmt::join(refs::ground_names(), ", ")),
      "NAME|FILE");
  command
      .add_flag("--keep-absorption-bands", arguments.keep_absorption_bands,
                "Fit the bands too where oxygen, water vapour, carbon dioxide and methane absorb")
      ->group(std::string(kLikelihood));
}

void read_likelihood(const FitArguments& arguments, fit::FitOptions& options) {
  if (!arguments.per_scan.empty()) {
    const std::vector<Parameter> names = parse_parameters("--per-scan", arguments.per_scan);
    options.per_scan = {names.begin(), names.end()};
  }
  if (!arguments.link.empty()) options.link = parse_choice("--link", arguments.link, kLinks);
  if (!arguments.scale.empty()) options.scale = parse_choice("--scale", arguments.scale, kScales);
  if (!arguments.pointing.empty())
    options.pointing = parse_choice("--pointing", arguments.pointing, kPointings);
  options.loss = parse_choice("--loss", arguments.loss, kLosses);
  if (!arguments.noise.empty()) options.noise = parse_noise(arguments.noise);
  if (!arguments.ground.empty()) options.ground = refs::ground_spectrum(arguments.ground);
}

}  // namespace

void add_fit_options(CLI::App& command, FitArguments& arguments) {
  add_sampling_options(command, arguments.sampling, arguments.sun_zenith);
  add_problem_options(command, arguments);
  add_import_options(command, arguments.import);
  add_likelihood_options(command, arguments);
  add_check_options(command, arguments);
}

void add_fit_model_options(CLI::App& command, FitArguments& arguments) {
  command.add_option("--model", arguments.model, "Sky model")
      ->type_name("NAME")
      ->capture_default_str();
  add_refraction_option(command, arguments.refraction);
  add_scalar_option(command, arguments.scalar);
  add_threads_option(command, arguments.threads);
}

fit::FitOptions fit_options(const FitArguments& arguments, const SkyModel& model,
                            const CLI::App& command) {
  fit::FitOptions result;
  result.lobes = command.count("--lobes") > 0 ? arguments.lobes : model.lobes();
  result.starts = arguments.starts;
  result.max_iterations = arguments.max_iterations;
  result.exclude_sun = radians(parse_number("--exclude-sun-deg", arguments.exclude_sun));
  result.threads = arguments.threads;
  if (arguments.start) {
    result.start = arguments.start;
  } else if (command.count("--preset") > 0) {
    result.start = preset_named(arguments.preset);
  }
  result.site_pressure_hpa = parse_site_pressure(arguments.site_pressure);
  if (arguments.free == "none") {
    result.free.emplace();
  } else if (command.count("--free") > 0) {
    result.free = parse_parameters("--free", arguments.free);
  }
  result.fix = parse_fixed("--fix", arguments.fix);
  result.bounds = parse_bounds("--bounds", arguments.bounds);
  std::vector<std::string> priors = arguments.prior;
  result.instrument_priors = take_instrument_priors(priors);
  result.priors = parse_priors("--prior", priors);
  result.use_priors = !arguments.no_priors;
  read_likelihood(arguments, result);
  fit::validate(result);
  return result;
}

std::optional<refs::AerosolKnowledge> known_aerosol(const FitArguments& arguments,
                                                    const refs::Reference& reference) {
  std::optional<refs::AerosolKnowledge> known;
  for (const auto& [option, file] :
       {std::pair{"--aeronet-aod", arguments.aeronet_aod},
        std::pair{"--aeronet-inversion", arguments.aeronet_inversion}}) {
    if (file.empty()) continue;
    std::vector<refs::Instant> times;
    for (const refs::Scan& scan : reference.scans) {
      if (const auto time = refs::instant(scan.time_utc, 0)) times.push_back(*time);
    }
    if (times.empty() || times.size() < reference.scans.size())
      throw UsageError(option, file,
                       "expected with scans whose time is known (local_time, utc_offset_h)");
    std::vector<refs::AerosolRecord> records = refs::load_aerosol_records(file);
    for (const refs::Scan& scan : reference.scans) {
      if (scan.site) records = refs::records_near(records, *scan.site, file);
    }
    const refs::AerosolKnowledge more = refs::aerosol_at(records, times, file);
    known = known ? refs::joined(*known, more) : more;
  }
  return known;
}

fit::CheckOptions check_options(const FitArguments& arguments) {
  fit::CheckOptions result{
      arguments.profiles, arguments.bootstrap, {}, static_cast<std::uint64_t>(arguments.seed)};
  if (!arguments.hold_out.empty()) result.hold_out = parse_hold_out(arguments.hold_out);
  return result;
}

}  // namespace skyfit::cli
