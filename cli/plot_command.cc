// SPDX-License-Identifier: Apache-2.0
// `skyfit plot`: the comparison figure of one or several finished fits.
#include <memory>

#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "data_refs/spectra.h"
#include "model/sky_model.h"
#include "render/plot/comparison.h"
#include "render/plot/results.h"

namespace skyfit::cli {
namespace {

struct PlotOptions {
  std::vector<std::string> directories, out;
  int threads = default_threads();
};

void run_plot(const PlotOptions& options) {
  require_output_files(options.out, {".svg", ".png", ".pdf"});
  std::vector<plot::FitOutcome> fits;
  for (const std::string& directory : options.directories)
    fits.push_back(plot::read_fit_outcome(directory));
  const auto model = make_sky_model("reference", refs::standard_spectral_data(), options.threads);
  plot::write_comparison(
      plot::comparison_of(fits, refs::standard_spectral_data(), *model),
      std::vector<std::filesystem::path>(options.out.begin(), options.out.end()));
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
  add_threads_option(*command, options->threads);
  command->footer(
      "Reference, fit and start in the principal plane, one panel per sun position, "
      "and maps of the\n"
      "residual over the sky. Several directories are drawn into one figure.\n"
      "\n"
      "Example: skyfit plot one-lobe two-lobes --out comparison.pdf");
  command->callback([options] { run_plot(*options); });
}

}  // namespace skyfit::cli
