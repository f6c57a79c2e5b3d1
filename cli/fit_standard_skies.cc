// SPDX-License-Identifier: Apache-2.0
#include "cli/fit_standard_skies.h"

#include <fmt/format.h>

#include <memory>

#include "cli/arguments.h"
#include "cli/fit_options.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "data_refs/cie_sky.h"
#include "data_refs/spectra.h"
#include "fit/fit.h"
#include "fit/problem/free_parameters.h"
#include "fit/standard_sky.h"
#include "fit/standard_sky_table.h"
#include "model/base/whole_file.h"
#include "model/registry.h"
#include "render/plot/standard_skies.h"

namespace skyfit::cli {
namespace {

constexpr const char *kText = "standard_skies.txt", *kCsv = "standard_skies.csv",
                     *kJson = "standard_skies.json";
constexpr std::string_view kFigure = "standard_skies";

std::string preset_file(int type) { return fmt::format("cie-{}.json", type); }

std::vector<std::string> result_files() {
  std::vector<std::string> files = {kText, kCsv, kJson, fmt::format("{}.svg", kFigure),
                                    fmt::format("{}.png", kFigure)};
  for (const refs::CieSky& sky : refs::cie_skies()) files.push_back(preset_file(sky.type));
  return files;
}

void expect_no_checks(const FitArguments& arguments) {
  const std::pair<std::string_view, bool> checks[] = {{"--profile", !arguments.profiles.empty()},
                                                      {"--bootstrap", arguments.bootstrap > 0},
                                                      {"--hold-out", !arguments.hold_out.empty()}};
  for (const auto& [option, given] : checks) {
    if (given)
      throw UsageError("--reference", arguments.reference,
                       fmt::format("expected one sky, such as cie:12, with {}", option));
  }
}

std::vector<fit::StandardSkyFit> fit_all(const FitArguments& arguments, const CLI::App& command) {
  const auto model = make_sky_model(arguments.model, refs::standard_spectral_data(),
                                    arguments.threads, transfer_of(arguments.scalar));
  const fit::FitOptions given = fit_options(arguments, *model, command);
  const std::vector<double> suns = parse_sun_zeniths(arguments.sun_zenith);
  const refs::Sampling sampling = parse_sampling(arguments.sampling);
  Progress progress("fitting the standard skies");
  std::vector<fit::StandardSkyFit> fits;
  const auto count = static_cast<double>(refs::cie_skies().size());
  for (const refs::CieSky& sky : refs::cie_skies()) {
    const std::string name = fmt::format("cie:{}", sky.type);
    const fit::StandardSkyKind& kind = fit::standard_sky_kind(sky.type, *model);
    fit::FitOptions options = fit::with_standard_sky(given, kind, *model);
    options.progress = [&](double fraction, const std::string& status) {
      progress.show((static_cast<double>(fits.size()) + fraction) / count,
                    fmt::format("{}: {}", name, status));
    };
    const SpectralData spectra = refs::spectral_data_of(fit::start_atmosphere(options));
    fits.push_back({sky.type, given.start ? std::string_view("the preset") : kind.name,
                    fit::fit_atmosphere(refs::load_reference(name, suns, sampling), spectra, *model,
                                        options)});
  }
  return fits;
}

}  // namespace

plot::Figure standard_skies_figure(std::span<const fit::StandardSkyFit> fits) {
  std::vector<double> suns;
  for (const fit::ScanOutcome& scan : fits.front().result.scans)
    suns.push_back(degrees(scan.info.sun_zenith));
  std::vector<plot::StandardSkyRow> rows;
  for (const fit::StandardSkyFit& fit : fits) {
    plot::StandardSkyRow row{fit.type,
                             refs::cie_skies()[static_cast<std::size_t>(fit.type - 1)].description,
                             std::string(fit.kind),
                             fit.result.errors.rms_log,
                             {}};
    for (const fit::ScanOutcome& scan : fit.result.scans)
      row.rms_percent_of_sun.push_back(scan.errors.rms_log);
    rows.push_back(row);
  }
  return plot::standard_skies_figure(suns, rows);
}

void run_standard_skies(const FitArguments& arguments, const CLI::App& command) {
  expect_no_checks(arguments);
  const WholeDirectory out(arguments.out, result_files(), arguments.force);
  const std::vector<fit::StandardSkyFit> fits = fit_all(arguments, command);
  const std::string text = fit::standard_skies_text(fits),
                    json = json_text(fit::standard_skies_json(fits));
  Figures figures;
  out.publish([&](const std::filesystem::path& staging) {
    for (const fit::StandardSkyFit& fit : fits)
      write_file(staging / preset_file(fit.type), preset_to_json(fit.result.preset));
    write_file(staging / kText, text);
    write_file(staging / kCsv, fit::standard_skies_csv(fits));
    write_file(staging / kJson, json);
    figures.draw(staging, kFigure, [&] {
      plot::write_figure(standard_skies_figure(fits), {staging / fmt::format("{}.svg", kFigure),
                                                       staging / fmt::format("{}.png", kFigure)});
    });
  });
  for (const fit::StandardSkyFit& fit : fits) {
    if (!fit.result.converged)
      warn(fmt::format("the fit of cie:{} stopped before it converged: {}", fit.type,
                       fit.result.termination));
  }
  print(arguments.json ? json : text);
  figures.expect_all(arguments.out);
}

}  // namespace skyfit::cli
