// SPDX-License-Identifier: Apache-2.0
#include "cli/fit_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/arguments.h"
#include "data_refs/spectra.h"
#include "fit/result/record.h"
#include "model/base/input_file.h"
#include "model/base/preset_reader.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"
#include "model/registry.h"
#include "render/plot/comparison.h"
#include "render/plot/measured_figures.h"
#include "render/plot/results.h"

namespace skyfit::cli {
namespace {

constexpr const char *kPresetFile = "preset.json", *kReportFile = "report.json",
                     *kReportTextFile = "report.txt", *kReportPage = "report.html",
                     *kSamplesFile = "samples.csv";
constexpr const char* kFigureExtensions[] = {".svg", ".png"};
constexpr std::string_view kComparison = "comparison";

std::vector<std::string> files_of(std::string_view figure) {
  std::vector<std::string> files;
  for (const char* extension : kFigureExtensions)
    files.push_back(fmt::format("{}{}", figure, extension));
  return files;
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& directory,
                                            std::string_view figure) {
  std::vector<std::filesystem::path> files;
  for (const std::string& file : files_of(figure)) files.push_back(directory / file);
  return files;
}

// Directions of a sky are where the instrument truly points; a sample outside the model's spectra,
// or of a scan without a scale, is left out.
std::vector<plot::Sample> samples_of(const fit::Result& result) {
  std::vector<plot::Sample> samples;
  for (std::size_t i = 0; i < result.reference.samples.size(); ++i) {
    const refs::Sample& s = result.reference.samples[i];
    if (!std::isfinite(result.model[i])) continue;
    const auto scan = std::ranges::find(
        result.scans, s.scan, [](const fit::ScanOutcome& outcome) { return outcome.info.number; });
    const SkyPoint stated = fit::sky_point(s);
    const SkyPoint point =
        s.irradiance
            ? stated
            : fit::pointed(stated, scan->info.sun_azimuth + s.sun_azimuth_since, scan->instrument);
    const bool fitted = std::isfinite(result.sigma[i]);
    samples.push_back(
        {static_cast<int>(scan - result.scans.begin()) + 1, whole_degrees(s.sun_zenith),
         whole_degrees(point.view_zenith), whole_degrees(point.relative_azimuth), s.wavelength_nm,
         s.value, fitted ? result.sigma[i] : 0, result.model[i], fitted ? s.weight : 0,
         result.start_model[i], s.irradiance ? std::string(kIrradianceNames[*s.irradiance]) : ""});
  }
  return samples;
}

// Whether the sun's vertical plane, in which the figure comparison draws its curves, holds samples
// enough: three a scan.
bool shows_planes(const std::vector<plot::Sample>& samples, std::size_t scans) {
  return static_cast<std::size_t>(std::ranges::count_if(samples, plot::in_principal_plane)) >=
         3 * scans;
}

bool shows_comparison(const fit::Result& result, const std::vector<plot::Sample>& samples) {
  return result.reference.quantity == refs::Quantity::kRelativeLuminance ||
         (result.reference.quantity == refs::Quantity::kLuminance &&
          shows_planes(samples, result.scans.size()));
}

void draw_comparison(const std::filesystem::path& directory, const plot::FitOutcome& outcome,
                     const SkyModel& model, Figures& figures) {
  const auto model_named = [&](std::string_view, Transfer) -> const SkyModel& { return model; };
  figures.draw(directory, kComparison, [&] {
    plot::write_comparison(
        plot::comparison_of({&outcome, 1}, refs::spectral_data_of(outcome.preset.atmosphere),
                            model_named),
        files_in(directory, kComparison));
  });
}

void draw_measured(const std::filesystem::path& directory, const plot::MeasuredOutcome& outcome,
                   Figures& figures) {
  for (const plot::MeasuredFigure& figure : plot::measured_figures()) {
    if (!figure.can_draw(outcome)) continue;
    figures.draw(directory, figure.name, [&] {
      plot::write_figure(plot::draw(figure, {&outcome, 1}), files_in(directory, figure.name));
    });
  }
}

}  // namespace

std::vector<std::string> fit_files() {
  std::vector<std::string> files = {kPresetFile, kReportFile, kReportTextFile, kReportPage,
                                    kSamplesFile};
  const auto add = [&](std::string_view figure) {
    for (const std::string& file : files_of(figure)) files.push_back(file);
  };
  add(kComparison);
  for (const plot::MeasuredFigure& figure : plot::measured_figures()) add(figure.name);
  return files;
}

bool has_absolute_values(const fit::Result& result) {
  return result.reference.quantity != refs::Quantity::kRelativeLuminance;
}

bool has_measured_figures(const fit::Result& result) {
  return has_absolute_values(result) || result.reference.irradiance_quantity;
}

void write_fit(const std::filesystem::path& directory, const FinishedFit& finished,
               const SkyModel& model, Figures& figures) {
  const fit::Result& result = finished.result;
  write_file(directory / kPresetFile, preset_to_json(result.preset));
  write_file(directory / kReportFile, json_text(fit::report_json(result, finished.checks)));
  write_file(directory / kReportTextFile, fit::full_report(result, finished.checks));
  const std::vector<plot::Sample> samples = samples_of(result);
  write_file(directory / kSamplesFile, plot::samples_to_csv(samples));
  const std::vector<plot::Sample> directions = plot::directions_only(samples);
  if (shows_comparison(result, directions))
    draw_comparison(directory, {directory.string(), result.preset, directions}, model, figures);
  if (has_measured_figures(result))
    draw_measured(directory, measured_outcome(result, samples), figures);
}

FinishedFit read_fit(const std::filesystem::path& directory) {
  const std::filesystem::path preset = directory / kPresetFile, report = directory / kReportFile;
  const PresetDocument document(read_file(report, "what skyfit fit left"), report.string());
  return {fit::result_of(load_preset(preset), preset.string()), fit::checks_of(document.root())};
}

plot::MeasuredOutcome measured_outcome(const fit::Result& result,
                                       const std::vector<plot::Sample>& samples) {
  plot::MeasuredOutcome outcome;
  outcome.title = result.reference.name;
  outcome.spectral = result.reference.quantity == refs::Quantity::kSpectralRadiance;
  const refs::Quantity of_irradiances =
      result.reference.irradiance_quantity.value_or(result.reference.quantity);
  if (refs::is_irradiance(of_irradiances))
    outcome.irradiance_unit = of_irradiances == refs::Quantity::kIlluminance ? "lx" : "W m⁻²";
  if (has_absolute_values(result)) outcome.samples = plot::directions_only(samples);
  outcome.irradiances = plot::irradiances_only(samples);
  for (const fit::ScanOutcome& scan : result.scans) {
    outcome.scans.push_back(
        {scan.info.name, scan.info.time_utc, scan.errors.luminance, scan.errors.spectral});
  }
  for (const fit::UnknownRow& row : result.unknowns) {
    outcome.unknowns.push_back({row.unknown.name(), std::string(row.unknown.unit()),
                                row.unknown.scan + 1, row.fitted, row.sigma});
  }
  for (const int u : result.covariance_unknowns)
    outcome.covariance_unknowns.push_back(outcome.unknowns[static_cast<std::size_t>(u)].name);
  for (const auto row : result.covariance.rowwise())
    outcome.covariance.emplace_back(row.begin(), row.end());
  return outcome;
}

plot::MeasuredOutcome read_measured_outcome(const std::filesystem::path& directory) {
  const fit::Result result = read_fit(directory).result;
  const std::filesystem::path file = directory / kSamplesFile;
  const std::vector<plot::Sample> samples = plot::read_samples_csv(file);
  plot::MeasuredOutcome outcome = measured_outcome(result, samples);
  for (const plot::Sample& sample : samples) {
    if (static_cast<std::size_t>(sample.scan) <= outcome.scans.size()) continue;
    throw std::invalid_argument(fmt::format("{}: scan = {}: expected one of the {} scans of {}",
                                            file.string(), sample.scan, outcome.scans.size(),
                                            kPresetFile));
  }
  return outcome;
}

std::vector<fit::ReportFigure> report_figures(const std::filesystem::path& directory,
                                              const fit::Result& result, int threads) {
  const TemporaryDirectory drawn;
  const std::filesystem::path file = drawn.path() / "figure.svg";
  std::vector<fit::ReportFigure> figures;
  const auto add = [&](std::string_view title) {
    figures.push_back({std::string(title), read_file(file, "a figure")});
  };
  const plot::FitOutcome outcome = plot::read_fit_outcome(directory);
  if (shows_comparison(result, outcome.samples)) {
    const SpectralData spectra = refs::spectral_data_of(outcome.preset.atmosphere);
    const auto model = make_sky_model(result.model_name, spectra, threads, result.transfer);
    const auto model_named = [&](std::string_view, Transfer) -> const SkyModel& { return *model; };
    plot::write_comparison(plot::comparison_of({&outcome, 1}, spectra, model_named), {file});
    add("Reference, fit and start in the sun's vertical plane, and maps of the residual over the "
        "sky");
  }
  if (!has_measured_figures(result)) return figures;
  const plot::MeasuredOutcome measured = read_measured_outcome(directory);
  for (const plot::MeasuredFigure& figure : plot::measured_figures()) {
    if (!figure.can_draw(measured)) continue;
    plot::write_figure(plot::draw(figure, {&measured, 1}), {file});
    add(figure.meaning);
  }
  return figures;
}

}  // namespace skyfit::cli
