// SPDX-License-Identifier: Apache-2.0
// `skyfit plot`: the figures of one or several finished fits, and the polarisation of a preset's
// sky.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/figure_options.h"
#include "cli/fit_files.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "data_refs/spectra.h"
#include "model/registry.h"
#include "model/sky_model.h"
#include "render/plot/comparison.h"
#include "render/plot/mean_density.h"
#include "render/plot/measured_figures.h"
#include "render/plot/polarisation_maps.h"
#include "render/plot/results.h"

namespace skyfit::cli {
namespace {

constexpr std::string_view kComparison = "comparison", kPolarisation = "polarisation",
                           kMeanDensity = "mean-density";

struct PlotOptions {
  std::vector<std::string> directories, out;
  std::string figure;
  std::string sun_zenith, wavelength = "450", altitude = "0";  // of the polarisation
  bool iau = false;
  std::string model;  // of the maps; empty: that of each fit
  int scan = 1;
  int threads = default_threads();
  FigureOptions page;
};

void draw_measured(const PlotOptions& options, const plot::Sheet& sheet,
                   const std::vector<std::filesystem::path>& files) {
  std::vector<plot::MeasuredOutcome> fits;
  for (const std::string& directory : options.directories)
    fits.push_back(read_measured_outcome(directory));
  const auto by_default = std::ranges::find_if(
      plot::measured_figures(), [&](const auto& figure) { return figure.can_draw(fits.front()); });
  const plot::MeasuredFigure& figure =
      options.figure.empty() ? *by_default : plot::measured_figure(options.figure);
  plot::write_figure(plot::draw(figure, fits, options.scan, sheet), files);
}

// Of a preset, or of the one that a fit left.
void draw_polarisation(const PlotOptions& options, const plot::Sheet& sheet,
                       const std::vector<std::filesystem::path>& files) {
  constexpr double kHighest_m = 1e9;
  if (options.directories.size() != 1) {
    throw UsageError(
        "--figure", kPolarisation,
        fmt::format("expected one preset or directory, got {}", options.directories.size()));
  }
  if (options.sun_zenith.empty())
    throw UsageError("--sun-zenith-deg", "", "expected an angle with --figure polarisation");
  const double sun = parse_angle("--sun-zenith-deg", options.sun_zenith, 0, 180);
  const double altitude_m =
      parse_number_within("--altitude-m", options.altitude, 0, kHighest_m, "a height in metres");
  const std::string& name = options.directories.front();
  const Preset preset =
      preset_named(std::filesystem::is_directory(name) ? name + "/preset.json" : name);
  const SpectralData spectra = refs::spectral_data_of(preset.atmosphere);
  const auto& table = spectra.ozone_cross_section.wavelength_nm;
  const double nm = parse_number_within("--wavelength-nm", options.wavelength, table.front(),
                                        table.back(), "a wavelength in nm that the tables hold,");
  const auto model = make_sky_model(options.model.empty() ? "reference" : options.model, spectra,
                                    options.threads, Transfer::kVector);
  const plot::PolarisedSky sky = plot::polarised_sky(
      *model, preset.atmosphere, spectral_nodes(spectra, {nm}).front(), altitude_m, sun);
  plot::write_figure(
      plot::polarisation_figure(
          "Polarisation of the sky of " + preset.name, sky,
          options.iau ? PolarisationAngle::kIau : PolarisationAngle::kClockwise, sheet),
      files);
}

void require_figure(const std::string& name) {
  if (name.empty()) return;
  std::vector<std::string_view> names = {kComparison, kPolarisation, kMeanDensity};
  for (const plot::MeasuredFigure& figure : plot::measured_figures()) names.push_back(figure.name);
  if (std::ranges::count(names, name) == 0)
    throw UsageError("--figure", name, fmt::format("expected one of {}", fmt::join(names, ", ")));
}

void run_plot(const PlotOptions& options) {
  require_output_files(options.out, {".svg", ".png", ".pdf"});
  const std::vector<std::filesystem::path> files(options.out.begin(), options.out.end());
  require_figure(options.figure);
  const plot::Sheet sheet = parse_sheet(options.page);
  if (options.figure == kPolarisation) return draw_polarisation(options, sheet, files);
  if (options.figure == kMeanDensity) {
    if (!options.directories.empty())
      throw UsageError("directories", options.directories.front(),
                       "expected none with --figure mean-density");
    return plot::write_figure(plot::mean_density_figure(sheet), files);
  }
  if (options.directories.empty())
    throw UsageError("directories", "", "expected what skyfit fit left");
  if (!options.sun_zenith.empty())
    throw UsageError("--sun-zenith-deg", options.sun_zenith, "expected with --figure polarisation");
  const bool comparison = options.figure == kComparison;
  const auto absolute = std::ranges::count_if(options.directories, [&](const std::string& d) {
    const fit::Result result = read_fit(d).result;
    return options.figure.empty() ? has_absolute_values(result) : has_measured_figures(result);
  });
  if (!comparison && absolute == static_cast<std::ptrdiff_t>(options.directories.size()))
    return draw_measured(options, sheet, files);
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
  plot::write_comparison(plot::comparison_of(fits, spectra, model_named), files, sheet);
}

}  // namespace

void add_plot_command(CLI::App& app) {
  const auto options = std::make_shared<PlotOptions>();
  CLI::App* const command = app.add_subcommand(
      "plot", "Draws the figure of finished fits, or the polarisation of a preset's sky.");
  command
      ->add_option("directories", options->directories,
                   "What skyfit fit left; with --figure polarisation also a preset; with --figure "
                   "mean-density none")
      ->type_name("DIR");
  command->add_option("--out", options->out, "The figure; may be repeated")
      ->required()
      ->type_name("FILE.{svg,png,pdf}")
      ->allow_extra_args(false);
  command
      ->add_option("--figure", options->figure,
                   fmt::format("{}, {}, {}, or one of those of absolute and spectral skies",
                               kComparison, kPolarisation, kMeanDensity))
      ->type_name("NAME");
  command
      ->add_option("--model", options->model,
                   "Sky model of the maps of the whole sky; by default that of each fit")
      ->type_name("NAME");
  command->add_option("--scan", options->scan, "The scan of --figure spectra, from 1")
      ->check(CLI::Range(1, 1000000).description(""))
      ->capture_default_str();
  auto* const sun = command
                        ->add_option("--sun-zenith-deg", options->sun_zenith,
                                     "Sun zenith angle of --figure polarisation, 0 to 180")
                        ->type_name("ANGLE");
  command->add_option("--wavelength-nm", options->wavelength, "Of --figure polarisation")
      ->type_name("NM")
      ->needs(sun)
      ->capture_default_str();
  command
      ->add_option("--altitude-m", options->altitude,
                   "Height of the observer above the ground, of --figure polarisation")
      ->type_name("LENGTH")
      ->needs(sun)
      ->capture_default_str();
  add_iau_option(*command, options->iau, sun);
  add_figure_options(*command, options->page);
  add_threads_option(*command, options->threads);
  command->footer(
      "Reference, fit and start in the principal plane, one panel per sun position, "
      "and maps of the\n"
      "residual over the sky. Several directories are drawn into one figure.\n"
      "\n"
      "Figures of fits of absolute and spectral skies:\n" +
      named_lines(plot::measured_figures()) +
      "series takes several fits.\n"
      "\n"
      "--figure polarisation maps degree and angle of linear polarisation over the sky of a "
      "preset, "
      "or\n"
      "of the one that a fit left, and marks the neutral points of Arago, Babinet and Brewster "
      "where "
      "Q\n"
      "changes its sign along the sun's vertical circle. Its conventions are those of skyfit sky "
      "--stokes.\n"
      "\n"
      "--figure mean-density draws the mean density of a vertical path by the integral and by the "
      "two "
      "ways of\n"
      "the model nielsen over the height of the eye (Nielsen 2003, figure 5.2).\n"
      "\n"
      "Styles of a page, in which the panels are arranged anew:\n" +
      style_lines() +
      "Panels are suns in comparison, scans in maps, directions in spectra, kinds in irradiances,\n"
      "unknowns in corner and series.\n"
      "\n"
      "Examples:\n"
      "  skyfit plot earth-clear --figure polarisation --sun-zenith-deg 70 --out polarisation.pdf\n"
      "  skyfit plot one-lobe two-lobes --out comparison.pdf\n"
      "  skyfit plot measured --figure spectra --scan 2 --out spectra.png\n"
      "  skyfit plot one-lobe --style paper --width-mm 85 --panels 1,5,9 --out figure.pdf");
  command->callback([options] { run_plot(*options); });
}

}  // namespace skyfit::cli
