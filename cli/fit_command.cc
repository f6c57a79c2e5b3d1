// SPDX-License-Identifier: Apache-2.0
// `skyfit fit`: fits an atmosphere to a reference and leaves preset, reports, samples and figures
// in a directory.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/fit_files.h"
#include "cli/fit_options.h"
#include "cli/fit_request.h"
#include "cli/leave_netcdf.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "fit/exchange/result_netcdf.h"
#include "fit/problem/free_parameters.h"
#include "fit/standard_sky.h"
#include "model/base/whole_file.h"
#include "model/registry.h"

namespace skyfit::cli {
namespace {

FinishedFit fit_with_progress(FitRequest& request) {
  Progress progress("fitting " + request.reference.name);
  request.options.progress = [&](double fraction, const std::string& status) {
    progress.show(fraction, status);
  };
  return finished_fit(request, *request.model);
}

refs::Reference reference_of(const FitArguments& arguments, const CLI::App& command) {
  if (arguments.reference.empty()) {
    return load_irradiances(arguments.irradiance, arguments.sun_zenith, arguments.import, command);
  }
  refs::Reference sky = load_references(arguments.reference, arguments.sun_zenith,
                                        arguments.sampling, arguments.import, command);
  if (arguments.irradiance.empty()) return sky;
  return load_with_irradiances(std::move(sky), arguments.irradiance, arguments.sun_zenith,
                               arguments.import, command);
}

void run_fit(const FitArguments& arguments, const CLI::App& command) {
  if (arguments.reference.empty() && arguments.irradiance.empty())
    throw CLI::RequiredError("--reference or --irradiance");
  if (arguments.reference == kAllStandardSkies && !arguments.irradiance.empty())
    throw UsageError(
        "--irradiance", arguments.irradiance,
        fmt::format("expected one sky beside it, not --reference {}", kAllStandardSkies));
  if (arguments.reference == kAllStandardSkies) return run_standard_skies(arguments, command);
  const WholeDirectory out(arguments.out, fit_files(), arguments.force);
  require_netcdf(arguments.netcdf);
  FitRequest request = fit_request(arguments, reference_of(arguments, command), command);
  const FinishedFit finished = fit_with_progress(request);
  Figures figures;
  out.publish([&](const std::filesystem::path& staging) {
    write_fit(staging, finished, *request.model, figures);
  });
  if (!arguments.netcdf.empty()) leave_netcdf(arguments.netcdf, fit::netcdf_of(finished.result));
  if (!finished.result.converged) {
    warn(fmt::format("the fit stopped before it converged: {}", finished.result.termination));
  }
  print(arguments.json ? json_text(fit::report_json(finished.result, finished.checks))
                       : fit::brief_report(finished.result) + "\n");
  figures.expect_all(arguments.out);
}

std::string standard_sky_list() {
  std::string text =
      "Standard skies (cie:1 to cie:15) are fitted, unless --preset says otherwise, within bounds\n"
      "of what exists in place of priors, with Rayleigh scattering fixed, as\n";
  for (const fit::StandardSkyKind& kind : fit::standard_sky_kinds())
    text +=
        fmt::format("  {:<18}{}: types {}\n", kind.name, kind.meaning, fmt::join(kind.types, ", "));
  return text;
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
  const auto options = std::make_shared<FitArguments>();
  CLI::App* const command = app.add_subcommand("fit", "Fits an atmosphere to a reference.");
  command
      ->add_option(
          "--reference", options->reference,
          "Shipped reference (skyfit references) or measured skies, fitted jointly; cie:all\n"
          "fits each of the standard skies and leaves one table and one figure of all")
      ->type_name("NAME|FILE,FILE");
  command
      ->add_option(
          "--irradiance", options->irradiance,
          "Irradiances in the place of a sky, or beside --reference: direct_normal,\n"
          "direct_horizontal, diffuse_horizontal, global_horizontal in lx, or in W/m2 of all\n"
          "wavelengths with precipitable_water=NUMBERmm; a CSV of them; or FILE@TIME of a\n"
          "weather file")
      ->type_name("NAME=VALUE[:SIGMA]UNIT,..|FILE.csv|FILE@TIME");
  add_fit_options(*command, *options);
  add_result_options(*command, options->out, options->force, options->json, "report.json");
  add_netcdf_option(*command, options->netcdf, "Write samples, scans, unknowns and covariance");
  add_fit_model_options(*command, *options);
  command->footer(
      "Leaves preset.json, report.txt, report.json and samples.csv in the directory; of relative\n"
      "luminances the figure comparison, of absolute and spectral skies the figures maps, "
      "spectra,\n"
      "residuals, corner and series, and comparison where luminances lie in the sun's vertical\n"
      "plane. A figure that cannot be drawn is missing from the result and makes the exit status "
      "1.\n"
      "A LIST is a,b,c or start:stop:step, stop included.\n"
      "\n"
      "What is fitted by default depends on the quantity of the reference alone: a relative\n"
      "luminance with --link log --scale profiled --pointing stated, an absolute luminance or a\n"
      "spectral radiance with --link linear --scale fixed --pointing azimuth, irradiances with\n"
      "--link log --scale fixed and a known noise of 5 % or as stated, only the aerosol's optical\n"
      "depth and, of two kinds or more, its single scattering albedo free. Columns q_over_i and\n"
      "u_over_i, or dolp, of a CSV of samples are fitted beside them, linear and without a scale;\n"
      "irradiances beside a sky logarithmically, without a scale and with their own noise. They\n"
      "belong to the scan of the same minute, or without a time to the scan whose sun is theirs "
      "to\n"
      "1 deg; those of other times are further scans of the same atmosphere.\n"
      "\n" +
      standard_sky_list() + "\n" + parameter_list() +
      "\nExamples:\n"
      "  skyfit fit --reference cie:12 --out fitted\n"
      "  skyfit fit --reference cie:all --out skies\n"
      "  skyfit fit --irradiance direct=96000lx,diffuse=13500lx --sun-zenith-deg 32 --out fitted\n"
      "  skyfit fit --reference scan.csv --irradiance direct=83000lx,diffuse=14000lx --out fitted\n"
      "  skyfit fit --reference sky.csv --lobes 1 --fix ground.albedo=0.2 --out fitted\n"
      "  skyfit fit --reference 0930.csv,1030.csv --exclude-sample 0 --per-scan mie.scattering "
      "--out day");
  command->callback([options, command] { run_fit(*options, *command); });
}

}  // namespace skyfit::cli
