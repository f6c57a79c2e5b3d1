// SPDX-License-Identifier: Apache-2.0
// `skyfit plot`: the comparison figure of one or several finished fits.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/fit_files.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "data_refs/spectra.h"
#include "model/registry.h"
#include "model/sky_model.h"
#include "render/plot/comparison.h"
#include "render/plot/measured_figures.h"
#include "render/plot/results.h"

namespace skyfit::cli {
namespace {

constexpr std::string_view kComparison = "comparison";

struct PlotOptions {
  std::vector<std::string> directories, out;
  std::string figure;
  std::string model;  // of the maps; empty: that of each fit
  int scan = 1;
  int threads = default_threads();
};

void draw_measured(const PlotOptions& options, const std::vector<std::filesystem::path>& files) {
  std::vector<plot::MeasuredOutcome> fits;
  for (const std::string& directory : options.directories)
    fits.push_back(read_measured_outcome(directory));
  const plot::MeasuredFigure& figure = options.figure.empty()
                                           ? plot::measured_figures().front()
                                           : plot::measured_figure(options.figure);
  plot::write_figure(plot::draw(figure, fits, options.scan), files);
}

void run_plot(const PlotOptions& options) {
  require_output_files(options.out, {".svg", ".png", ".pdf"});
  const std::vector<std::filesystem::path> files(options.out.begin(), options.out.end());
  const bool comparison = options.figure == kComparison;
  const auto absolute = std::ranges::count_if(options.directories, [](const std::string& d) {
    return has_absolute_values(read_fit(d).result);
  });
  if (!comparison && absolute == static_cast<std::ptrdiff_t>(options.directories.size()))
    return draw_measured(options, files);
  if (!comparison && (absolute > 0 || !options.figure.empty())) {
    throw UsageError(options.figure.empty() ? "directories" : "--figure",
                     options.figure.empty() ? options.directories.front() : options.figure,
                     "expected fits of absolute or spectral skies only");
  }
  std::vector<plot::FitOutcome> fits;
  for (const std::string& directory : options.directories)
    fits.push_back(plot::read_fit_outcome(directory));
  const SpectralData spectra = refs::spectral_data_of(fits.front().preset.atmosphere);
  std::map<std::pair<std::string, Transfer>, std::unique_ptr<SkyModel>> models;
  const auto model_named = [&](std::string_view of_fit, Transfer transfer) -> const SkyModel& {
    const std::string name(options.model.empty() ? of_fit : options.model);
    auto& model = models[{name, transfer}];
    if (!model) model = make_sky_model(name, spectra, options.threads, transfer);
    return *model;
  };
  plot::write_comparison(plot::comparison_of(fits, spectra, model_named), files);
}

}  // namespace

void add_plot_command(CLI::App& app) {
  const auto options = std::make_shared<PlotOptions>();
  CLI::App* const command = app.add_subcommand("plot", "Draws the figure of finished fits.");
  command->add_option("directories", options->directories, "What skyfit fit left")
      ->required()
      ->type_name("DIR");
  command->add_option("--out", options->out, "The figure; may be repeated")
      ->required()
      ->type_name("FILE.{svg,png,pdf}")
      ->allow_extra_args(false);
  command
      ->add_option("--figure", options->figure,
                   fmt::format("{}, or one of those of absolute and spectral skies", kComparison))
      ->type_name("NAME");
  command
      ->add_option("--model", options->model,
                   "Sky model of the maps of the whole sky; by default that of each fit")
      ->type_name("NAME");
  command->add_option("--scan", options->scan, "The scan of --figure spectra, from 1")
      ->check(CLI::Range(1, 1000000).description(""))
      ->capture_default_str();
  add_threads_option(*command, options->threads);
  command->footer(
      "Reference, fit and start in the principal plane, one panel per sun position, "
      "and maps of the\n"
      "residual over the sky. Several directories are drawn into one figure.\n"
      "\n"
      "Figures of fits of absolute and spectral skies:\n" +
      named_lines(plot::measured_figures()) +
      "\n"
      "Examples:\n"
      "  skyfit plot one-lobe two-lobes --out comparison.pdf\n"
      "  skyfit plot measured --figure spectra --scan 2 --out spectra.png");
  command->callback([options] { run_plot(*options); });
}

}  // namespace skyfit::cli
