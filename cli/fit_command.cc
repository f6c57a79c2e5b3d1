// SPDX-License-Identifier: Apache-2.0
// `skyfit fit`: fits an atmosphere to a reference and leaves preset, reports, samples and figure in
// a directory.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/measured_fit.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "data_refs/spectra.h"
#include "fit/fit.h"
#include "fit/problem/free_parameters.h"
#include "model/base/whole_file.h"
#include "model/registry.h"
#include "render/plot/evaluate.h"
#include "render/plot/results.h"

namespace skyfit::cli {
namespace {

// The files of a result, and nothing else.
constexpr const char *kPresetFile = "preset.json", *kReportFile = "report.json",
                     *kReportTextFile = "report.txt", *kSamplesFile = "samples.csv";
constexpr const char* kFigureFiles[] = {"comparison.svg", "comparison.png"};

struct FitCommandOptions {
  std::string reference, sampling = "principal", sun_zenith = "0:80:10", model = "reference";
  std::string free, preset, site_pressure, out, exclude_sun = "3";
  std::vector<std::string> fix, prior;
  ImportArguments import;
  MeasuredArguments measured;
  int lobes = 0, starts = 4, max_iterations = fit::FitOptions{}.max_iterations,
      threads = default_threads();
  bool no_priors = false, force = false, json = false;
};

fit::FitOptions fit_options(const FitCommandOptions& options, const SkyModel& model,
                            const CLI::App& command) {
  fit::FitOptions result;
  result.lobes = command.count("--lobes") > 0 ? options.lobes : model.lobes();
  result.starts = options.starts;
  result.max_iterations = options.max_iterations;
  result.exclude_sun = radians(parse_number("--exclude-sun-deg", options.exclude_sun));
  result.threads = options.threads;
  if (command.count("--preset") > 0) result.start = preset_named(options.preset);
  result.site_pressure_hpa = parse_site_pressure(options.site_pressure);
  if (options.free == "none") {
    result.free.emplace();
  } else if (command.count("--free") > 0) {
    result.free = parse_parameters("--free", options.free);
  }
  result.fix = parse_fixed("--fix", options.fix);
  result.priors = parse_priors("--prior", options.prior);
  result.use_priors = !options.no_priors;
  fit::validate(result);
  return result;
}

void write_result(const std::filesystem::path& directory, const refs::Reference& reference,
                  const SkyModel& model, const fit::FitOptions& options,
                  const fit::FitResult& result, Figures& figures) {
  write_file(directory / kPresetFile, preset_to_json(result.preset));
  write_file(directory / kReportFile, json_text(fit::report_json(result)));
  write_file(directory / kReportTextFile, fit::full_report(result));
  const auto samples =
      plot::compared_samples(reference, {result.fitted_model, result.scale},
                             {result.start_model, result.start_scale}, options.exclude_sun);
  plot::write_samples_csv(directory / kSamplesFile, samples);
  const plot::FitOutcome outcome{directory.string(), result.preset, samples};
  const auto model_named = [&](std::string_view) -> const SkyModel& { return model; };
  figures.draw(directory, "comparison", [&] {
    plot::write_comparison(
        plot::comparison_of({&outcome, 1}, refs::spectral_data_of(result.preset.atmosphere),
                            model_named),
        {directory / kFigureFiles[0], directory / kFigureFiles[1]});
  });
}

fit::FitResult fit_with_progress(const refs::Reference& reference, const SkyModel& model,
                                 fit::FitOptions options) {
  Progress progress("fitting " + reference.name);
  options.progress = [&](double fraction, const std::string& status) {
    progress.show(fraction, status);
  };
  return fit::fit_atmosphere(reference, refs::spectral_data_of(fit::start_atmosphere(options)),
                             model, options);
}

std::vector<std::string> result_files() {
  std::vector<std::string> files = measured_files();
  files.insert(files.end(), {kSamplesFile, kFigureFiles[0], kFigureFiles[1]});
  return files;
}

void run_fit(FitCommandOptions options, const CLI::App& command) {
  const WholeDirectory out(options.out, result_files(), options.force);
  const std::map<fit::Instrument, Prior> instrument_priors = take_instrument_priors(options.prior);
  const auto model = make_sky_model(options.model, refs::standard_spectral_data(), options.threads);
  const fit::FitOptions how = fit_options(options, *model, command);
  const refs::Reference reference = load_references(options.reference, options.sun_zenith,
                                                    options.sampling, options.import, command);
  if (is_measured_fit(command, reference)) {
    fit::MeasuredOptions measured;
    measured.common = how;
    measured.instrument_priors = instrument_priors;
    run_measured_fit(options.measured, reference, measured, *model, options.json, out);
    return;
  }
  if (!instrument_priors.empty()) {
    throw UsageError("--prior",
                     std::string(fit::instrument_info(instrument_priors.begin()->first).name),
                     "expected an absolute or spectral reference with an instrument's prior");
  }
  const fit::FitResult result = fit_with_progress(reference, *model, how);
  Figures figures;
  out.publish([&](const std::filesystem::path& staging) {
    write_result(staging, reference, *model, how, result, figures);
  });
  if (!result.converged) {
    warn(fmt::format("the fit stopped before it converged: {}", result.termination));
  }
  print(options.json ? json_text(fit::report_json(result)) : fit::brief_report(result) + "\n");
  figures.expect_all(options.out);
}

void add_problem_options(CLI::App& command, FitCommandOptions& options) {
  command.add_option(
      "--lobes", options.lobes,
      "Lobes of the aerosol's phase function: 1 or 2; by default 2, or the one that\n"
      "the model can tell");
  command.add_option("--starts", options.starts, "Starts of the phase parameters")
      ->capture_default_str();
  command.add_option("--max-iterations", options.max_iterations, "Iterations of one start")
      ->capture_default_str();
  command
      .add_option("--free", options.free,
                  "Fit exactly these parameters; none evaluates measured skies")
      ->type_name("NAME,NAME");
  command.add_option("--fix", options.fix, "Hold parameters at a value")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command.add_option("--prior", options.prior, "Gaussian prior, which replaces the default one")
      ->type_name("NAME=MEAN:SIGMA")
      ->allow_extra_args(false);
  command.add_flag("--no-priors", options.no_priors, "Drop the default priors");
  command.add_option("--preset", options.preset, "Start from this preset")->type_name("FILE|NAME");
  add_site_pressure_option(command, options.site_pressure);
  command
      .add_option("--exclude-sun-deg", options.exclude_sun, "Leave out samples closer to the sun")
      ->type_name("ANGLE")
      ->capture_default_str();
}

std::string parameter_list() {
  std::string text = "Parameters of --free, --fix and --prior:\n";
  for (const Parameter& parameter : standard_parameters()) {
    const ParameterInfo info = parameter_info(parameter);
    text += fmt::format("  {:<32}{} ({}){}\n", info.name, info.meaning, info.unit,
                        info.free_by_default ? ", free" : "");
  }
  return text;
}

}  // namespace

void add_fit_command(CLI::App& app) {
  const auto options = std::make_shared<FitCommandOptions>();
  CLI::App* const command = app.add_subcommand("fit", "Fits an atmosphere to a reference.");
  command
      ->add_option("--reference", options->reference,
                   "Shipped reference (skyfit references) or measured skies, fitted jointly")
      ->required()
      ->type_name("NAME|FILE,FILE");
  add_sampling_options(*command, options->sampling, options->sun_zenith);
  add_problem_options(*command, *options);
  add_import_options(*command, options->import);
  add_measured_options(*command, options->measured);
  command->add_option("--model", options->model, "Sky model")
      ->type_name("NAME")
      ->capture_default_str();
  add_result_options(*command, options->out, options->force, options->json, "report.json");
  add_threads_option(*command, options->threads);
  command->footer(
      "Leaves preset.json, report.txt, report.json, samples.csv, comparison.svg and "
      "comparison.png\n"
      "in the directory; for measured skies measured.csv and the figures maps, spectra, "
      "residuals,\n"
      "corner and series replace the last three. A figure that cannot be drawn is missing "
      "from\n"
      "the result and makes the exit status 1. A LIST is a,b,c or start:stop:step, stop "
      "included.\n"
      "\n" +
      parameter_list() +
      "\nExamples:\n"
      "  skyfit fit --reference cie:12 --out fitted\n"
      "  skyfit fit --reference sky.csv --lobes 1 --fix ground.albedo=0.2 --out fitted\n"
      "  skyfit fit --reference 0930.csv,1030.csv --exclude-sample 0 --per-scan mie.scattering "
      "--out day");
  command->callback([options, command] { run_fit(*options, *command); });
}

}  // namespace skyfit::cli
