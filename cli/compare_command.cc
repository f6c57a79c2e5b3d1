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
#include "cli/inputs.h"
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
constexpr const char* kFigureFiles[] = {"comparison.svg", "comparison.png"};
constexpr const char* kFisheyeFile = "fisheye.png";

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

void run_compare(const CompareOptions& options, const CLI::App& command) {
  const WholeDirectory out(
      options.out, {kTextFile, kCsvFile, kJsonFile, kFigureFiles[0], kFigureFiles[1], kFisheyeFile},
      options.force);
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
  out.publish([&](const std::filesystem::path& staging) {
    write_file(staging / kTextFile, text);
    write_file(staging / kCsvFile, fit::comparison_csv(reference, rows));
    write_file(staging / kJsonFile, json_text(json));
    const plot::Comparison figure =
        figure_of(reference, rows, parse_number("--exclude-sun-deg", options.exclude_sun));
    if (figure.curves.empty()) return;
    plot::write_comparison(figure, {staging / kFigureFiles[0], staging / kFigureFiles[1]});
    plot::write_fisheye(fisheye_of(reference, rows, preset, transfer_for(reference, options.scalar),
                                   options.threads),
                        {staging / kFisheyeFile});
  });
  if (!options.netcdf.empty()) fit::write_netcdf(options.netcdf, fit::netcdf_of(reference, rows));
  print(options.json ? json_text(json) : text);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* const command =
      app.add_subcommand("compare", "Compares sky models with a reference, side by side.");
  add_compare_options(*command, *options);
  add_result_options(*command, options->out, options->force, options->json, "comparison.json");
  add_netcdf_option(*command, options->netcdf, "Write the values of all models");
  command->footer(
      "Leaves comparison.txt, comparison.csv, comparison.json, comparison.svg, comparison.png and\n"
      "fisheye.png in the directory. Agreement with a CIE sky says little about a model: single\n"
      "scattering alone, fitted, reaches it as well. Compare with truth and measurements "
      "first.\n\n"
      "Models:\n" +
      named_lines(sky_models()) + variant_lines() +
      "\nExamples:\n"
      "  skyfit compare --reference truth:earth-550nm-ground --out compared\n"
      "  skyfit compare --reference cie:12 --models reference,bodare,oneil --fitted --out "
      "compared\n"
      "  skyfit compare --reference model:reference --preset earth-clear --out compared");
  command->callback([options, command] { run_compare(*options, *command); });
}

}  // namespace skyfit::cli
