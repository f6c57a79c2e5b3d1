// SPDX-License-Identifier: Apache-2.0
// `skyfit compare`: every sky model against one reference.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/compare_options.h"
#include "cli/figure_options.h"
#include "cli/inputs.h"
#include "cli/leave_netcdf.h"
#include "cli/light_check.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "data_refs/spectra.h"
#include "fit/exchange/result_netcdf.h"
#include "fit/model_comparison.h"
#include "model/base/whole_file.h"
#include "model/registry.h"
#include "render/plot/comparison.h"
#include "render/plot/evaluate.h"
#include "render/plot/fisheye.h"

namespace skyfit::cli {
namespace {

constexpr const char *kTextFile = "comparison.txt", *kCsvFile = "comparison.csv",
                     *kJsonFile = "comparison.json";
constexpr const char *kFigure = "comparison", *kFisheye = "fisheye";

std::vector<std::filesystem::path> figure_files(const std::filesystem::path& directory,
                                                const std::string& name) {
  std::vector<std::filesystem::path> files;
  for (const char* const extension : {".svg", ".png", ".pdf"})
    files.push_back(directory / (name + extension));
  return files;
}

std::vector<std::string> result_files() {
  std::vector<std::string> files = {kTextFile, kCsvFile, kJsonFile};
  for (const char* const figure : {kFigure, kFisheye})
    for (const auto& file : figure_files({}, figure)) files.push_back(file.string());
  return files;
}

std::string variant_lines() {
  std::string text;
  for (const SkyModelEntry& entry : sky_models()) {
    if (entry.variants.empty()) continue;
    text += fmt::format("Variants of {0}, behind its name as in {0}:{1}:\n", entry.name,
                        entry.variants.front().name) +
            named_lines(entry.variants);
  }
  return text;
}

const std::optional<fit::ModelErrors>& shown(const fit::ModelComparison& row) {
  return row.fitted ? row.fitted : row.unfitted;
}

// The one nearest to 550 nm; 0 for luminances.
double shown_wavelength(const refs::Reference& reference) {
  return std::ranges::min_element(
             reference.samples, {},
             [](const refs::Sample& s) { return std::abs(s.wavelength_nm - 550); })
      ->wavelength_nm;
}

// Panels of the principal plane; the scales are the curves' own, so that shapes compare.
plot::Comparison figure_of(const refs::Reference& reference,
                           const std::vector<fit::ModelComparison>& rows, double exclude_sun_deg) {
  plot::Comparison figure;
  const std::string file = std::filesystem::path(reference.name).filename().string();
  figure.title =
      reference.scans.empty() ? fmt::format("{}: {}", reference.name, reference.description) : file;
  figure.reference_label = file;
  figure.quantity = reference.quantity;
  figure.exclude_sun_deg = exclude_sun_deg;
  const double wavelength_nm = shown_wavelength(reference);
  const bool any_fitted =
      std::ranges::any_of(rows, [](const auto& row) { return row.fitted.has_value(); });
  for (const fit::ModelComparison& row : rows) {
    if (!shown(row)) continue;
    plot::Curve curve{
        row.model + (any_fitted && !row.fitted ? " (unfitted)" : ""),
        plot::compared_samples(reference, shown(row)->model, {}, radians(exclude_sun_deg)),
        {}};
    std::erase_if(curve.plane, [&](const plot::Sample& s) {
      return !(s.model > 0) || s.wavelength_nm != wavelength_nm;
    });
    if (!curve.plane.empty()) figure.curves.push_back(std::move(curve));
  }
  figure.subtitle =
      fmt::format("{}{}; scale free per sun position", any_fitted ? "fitted" : "unfitted",
                  wavelength_nm > 0 ? fmt::format("; at {:g} nm", wavelength_nm) : "");
  return figure;
}

plot::FisheyeFigure fisheye_of(const refs::Reference& reference,
                               const std::vector<fit::ModelComparison>& rows, const Preset& preset,
                               Transfer transfer, int threads) {
  constexpr std::size_t kMostSuns = 5;
  std::set<double> all;
  for (const refs::Sample& sample : reference.samples) all.insert(sample.sun_zenith);
  const std::vector<double> suns(all.begin(), all.end());
  const std::size_t count = std::min(suns.size(), kMostSuns);
  plot::FisheyeFigure figure{fmt::format("Skies of the models, {}", reference.name), {}, {}};
  for (std::size_t k = 0; k < count; ++k) {
    figure.sun_zenith_deg.push_back(
        degrees(suns[count > 1 ? k * (suns.size() - 1) / (count - 1) : 0]));
  }
  const SpectralData spectra = refs::spectral_data_of(preset.atmosphere);
  for (const fit::ModelComparison& row : rows) {
    const Atmosphere<double>& atmosphere =
        row.fitted ? row.fit->preset.atmosphere : preset.atmosphere;
    const auto model = make_sky_model(row.model, spectra, threads, transfer);
    plot::FisheyeRow strip{row.model, {}};
    for (const double sun : figure.sun_zenith_deg) {
      try {
        if (strip.skies.empty()) model->prepare(atmosphere, color_rule(spectra).nodes);
        strip.skies.push_back(plot::fisheye_sky(*model, atmosphere, spectra, radians(sun)));
      } catch (const std::logic_error&) {  // the table says why
        strip.skies.emplace_back();
      }
    }
    if (std::ranges::any_of(strip.skies, [](const auto& sky) { return sky.has_value(); }))
      figure.rows.push_back(std::move(strip));
  }
  return figure;
}

void run_compare(const CompareOptions& options, const FigureOptions& page,
                 const CLI::App& command) {
  const plot::Sheet sheet = parse_sheet(page);
  const WholeDirectory out(options.out, result_files(), options.force);
  require_netcdf(options.netcdf);
  const CompareRequest request = compare_request(options);
  const auto& [preset, reference, names] = request;
  if (options.reference != kOurs) warn_of_unused_options(command, options.reference);
  std::vector<fit::ModelComparison> rows;
  {
    Progress progress("comparing with " + reference.name);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const double share = 1.0 / static_cast<double>(names.size());
      progress.show(share * static_cast<double>(i), names[i]);
      const auto model = model_of(options, request, names[i]);
      rows.push_back(
          compare_with(options, request, *model, [&](double fraction, const std::string& status) {
            progress.show(share * (static_cast<double>(i) + fraction),
                          fmt::format("{}: {}", names[i], status));
          }));
    }
  }
  check_light(rows);
  const std::string text = fit::comparison_text(reference, rows);
  const nlohmann::json json = fit::comparison_json(reference, rows);
  Figures figures;
  out.publish([&](const std::filesystem::path& staging) {
    write_file(staging / kTextFile, text);
    write_file(staging / kCsvFile, fit::comparison_csv(reference, rows));
    write_file(staging / kJsonFile, json_text(json));
    const plot::Comparison figure =
        figure_of(reference, rows, parse_number("--exclude-sun-deg", options.exclude_sun));
    if (figure.curves.empty()) return;
    figures.draw(staging, kFigure,
                 [&] { plot::write_comparison(figure, figure_files(staging, kFigure), sheet); });
    figures.draw(staging, kFisheye, [&] {
      plot::Sheet all_suns = sheet;  // those of the other figure are chosen
      all_suns.panels.clear();
      const Transfer transfer = transfer_for(reference, options.scalar);
      plot::write_figure(
          plot::fisheye_figure(fisheye_of(reference, rows, preset, transfer, options.threads),
                               all_suns),
          figure_files(staging, kFisheye));
    });
  });
  if (!options.netcdf.empty()) leave_netcdf(options.netcdf, fit::netcdf_of(reference, rows));
  print(options.json ? json_text(json) : text);
  figures.expect_all(options.out);
  if (std::ranges::none_of(rows, [](const auto& row) { return shown(row).has_value(); }))
    throw std::runtime_error(
        fmt::format("{}: none of the models can answer for these suns", reference.name));
}

}  // namespace

void add_compare_command(CLI::App& app) {
  const auto options = std::make_shared<CompareOptions>();
  const auto page = std::make_shared<FigureOptions>();
  CLI::App* const command =
      app.add_subcommand("compare", "Compares sky models with a reference, side by side.");
  add_compare_options(*command, *options);
  add_result_options(*command, options->out, options->force, options->json, "comparison.json");
  add_netcdf_option(*command, options->netcdf, "Write the values of all models");
  add_figure_options(*command, *page);
  command->footer(
      "Leaves comparison.txt, .csv and .json, and the figures comparison and fisheye as .svg, .png "
      "and\n"
      ".pdf in the directory. --panels are those of the figure comparison, one per sun.\n"
      "\n"
      "Agreement with a CIE sky says little about a model: single scattering alone, fitted, "
      "reaches "
      "it as\n"
      "well. Compare with truth and measurements first.\n"
      "\n"
      "Models:\n" +
      named_lines(sky_models()) + variant_lines() +
      "Styles of a page, in which the panels are arranged anew:\n" + style_lines() +
      "\nExamples:\n"
      "  skyfit compare --reference truth:earth-550nm-ground --out compared\n"
      "  skyfit compare --reference cie:12 --models reference,bodare,oneil --fitted --out "
      "compared\n"
      "  skyfit compare --reference model:reference --preset earth-clear --out compared");
  command->callback([options, page, command] { run_compare(*options, *page, *command); });
}

}  // namespace skyfit::cli
