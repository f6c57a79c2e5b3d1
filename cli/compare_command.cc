// SPDX-License-Identifier: Apache-2.0
// `skyfit compare`: every sky model against one reference.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/light_check.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "data_refs/spectra.h"
#include "data_refs/truth.h"
#include "fit/exchange/result_netcdf.h"
#include "fit/model_comparison.h"
#include "fit/problem/sky_values.h"
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
constexpr const char* kOurs = "model:reference";

struct CompareOptions {
  std::string reference, sampling = "principal", sun_zenith = "0:80:10", models, preset, out,
                         netcdf;
  std::string exclude_sun = "3";
  ImportArguments import;
  int starts = 4, threads = default_threads();
  bool fitted = false, scalar = false, force = false, json = false;
};

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

std::vector<std::string> model_names(const std::string& text) {
  std::vector<std::string> names;
  if (text.empty()) {
    for (const SkyModelEntry& entry : sky_models()) names.emplace_back(entry.name);
    return names;
  }
  std::istringstream parts(text);
  for (std::string name; std::getline(parts, name, ',');) names.push_back(name);
  for (const std::string& name : names) {
    try {
      make_sky_model(name, refs::standard_spectral_data(), 1);
    } catch (const std::invalid_argument& unknown) {
      throw UsageError("--models", text, unknown.what());
    }
  }
  return names;
}

bool is_truth(const std::string& name) {
  return std::ranges::count(refs::truth_references(), name, &refs::TruthEntry::name) > 0;
}

Preset preset_of(const CompareOptions& options) {
  if (!options.preset.empty()) return preset_named(options.preset);
  return is_truth(options.reference) ? refs::truth_preset(options.reference)
                                     : preset_named("bodare-2014");
}

// Our own solver as the reference: its luminances where an analytic sky would be sampled.
refs::Reference solved_reference(const CompareOptions& options, const Preset& preset) {
  refs::Reference reference =
      refs::load_reference("cie:12", parse_sun_zeniths(options.sun_zenith),
                           parse_sampling(options.sampling));  // for its directions
  reference.name = kOurs;
  reference.description = fmt::format("the model \"reference\" with the preset {}", preset.name);
  reference.quantity = refs::Quantity::kLuminance;
  const SpectralData spectra = refs::spectral_data_of(preset.atmosphere);
  reference.transfer = transfer_of(options.scalar);
  const auto model = make_sky_model("reference", spectra, options.threads, reference.transfer);
  const fit::Dataset data = fit::dataset(reference, spectra, {true, 0, {}, 0});
  const fit::SkyState state =
      fit::start_state(preset.atmosphere, static_cast<int>(data.scans.size()));
  const fit::SampleValues values = fit::sky_values(*model, data, state, {});
  for (std::size_t i = 0; i < data.samples.size(); ++i)
    reference.samples[data.samples[i].index].value = values.value(static_cast<Eigen::Index>(i));
  return reference;
}

std::vector<fit::ModelComparison> compare_all(const CompareOptions& options,
                                              const std::vector<std::string>& names,
                                              const refs::Reference& reference,
                                              const Preset& preset) {
  Progress progress("comparing with " + reference.name);
  fit::FitOptions how;
  how.starts = options.starts;
  how.threads = options.threads;
  how.start = preset;
  how.exclude_sun = radians(
      parse_list_within("--exclude-sun-deg", options.exclude_sun, 0, 180, "an angle in degrees")
          .front());
  fit::validate(how);
  std::vector<fit::ModelComparison> rows;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double share = 1.0 / static_cast<double>(names.size());
    how.progress = [&](double fraction, const std::string& status) {
      progress.show(share * (static_cast<double>(i) + fraction),
                    fmt::format("{}: {}", names[i], status));
    };
    progress.show(share * static_cast<double>(i), names[i]);
    const SpectralData spectra = refs::spectral_data_of(preset.atmosphere);
    rows.push_back(fit::compare_model(reference, spectra,
                                      *make_sky_model(names[i], spectra, options.threads,
                                                      transfer_for(reference, options.scalar)),
                                      preset.atmosphere, how.exclude_sun,
                                      options.fitted ? &how : nullptr));
  }
  return rows;
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
  const std::vector<std::string> names = model_names(options.models);
  const Preset preset = preset_of(options);
  if (options.reference == kOurs && options.preset.empty())
    throw UsageError("--preset", "", fmt::format("expected one with --reference {}", kOurs));
  const refs::Reference reference = fit::comparison_reference(
      options.reference == kOurs
          ? solved_reference(options, preset)
          : refs::load_reference(options.reference, parse_sun_zeniths(options.sun_zenith),
                                 parse_sampling(options.sampling),
                                 parse_import_options(options.import)),
      refs::standard_spectral_data());
  if (options.reference != kOurs) warn_of_unused_options(command, options.reference);
  const auto rows = compare_all(options, names, reference, preset);
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
  command
      ->add_option(
          "--reference", options->reference,
          "Shipped reference (skyfit references), perez:EPSILON,DELTA, a CSV of\n"
          "samples, or model:reference, the reference model with the atmosphere of --preset")
      ->required()
      ->type_name("NAME|FILE");
  add_sampling_options(*command, options->sampling, options->sun_zenith);
  add_import_options(*command, options->import);
  command->add_option("--models", options->models, "The models; by default all")
      ->type_name("NAME,NAME");
  command
      ->add_option("--preset", options->preset,
                   "The unfitted atmosphere; by default that of a truth, else bodare-2014")
      ->type_name("FILE|NAME");
  command->add_flag("--fitted", options->fitted,
                    "Fit every model to the reference as well (minutes for bruneton)");
  command->add_option("--starts", options->starts, "Starts of the phase parameters of a fit")
      ->capture_default_str();
  command
      ->add_option("--exclude-sun-deg", options->exclude_sun, "Leave out samples closer to the sun")
      ->type_name("ANGLE")
      ->capture_default_str();
  add_scalar_option(*command, options->scalar);
  add_result_options(*command, options->out, options->force, options->json, "comparison.json");
  add_netcdf_option(*command, options->netcdf, "Write the values of all models");
  add_threads_option(*command, options->threads);
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
