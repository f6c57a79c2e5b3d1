// SPDX-License-Identifier: Apache-2.0
#include "cli/compare_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "cli/arguments.h"
#include "data_refs/spectra.h"
#include "data_refs/truth.h"
#include "fit/problem/sky_values.h"
#include "model/registry.h"

namespace skyfit::cli {
namespace {

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

Preset preset_of(const CompareOptions& options, const std::string& reference) {
  if (options.atmosphere) return *options.atmosphere;
  if (!options.preset.empty()) return preset_named(options.preset);
  return is_truth(reference) ? refs::truth_preset(reference) : preset_named("bodare-2014");
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

CompareRequest request_of(const CompareOptions& options, Preset preset,
                          const refs::Reference& reference) {
  std::vector<std::string> names = model_names(options.models);
  return {std::move(preset), fit::comparison_reference(reference, refs::standard_spectral_data()),
          std::move(names)};
}

}  // namespace

void add_compare_options(CLI::App& command, CompareOptions& options) {
  command
      .add_option(
          "--reference", options.reference,
          "Shipped reference (skyfit references), perez:EPSILON,DELTA, a CSV of\n"
          "samples, or model:reference, the reference model with the atmosphere of --preset")
      ->required()
      ->type_name("NAME|FILE");
  add_sampling_options(command, options.sampling, options.sun_zenith);
  add_import_options(command, options.import);
  command.add_option("--models", options.models, "The models; by default all")
      ->type_name("NAME,NAME");
  command
      .add_option("--preset", options.preset,
                  "The unfitted atmosphere; by default that of a truth, else bodare-2014")
      ->type_name("FILE|NAME");
  command.add_flag("--fitted", options.fitted,
                   "Fit every model to the reference as well (minutes for bruneton)");
  command.add_option("--starts", options.starts, "Starts of the phase parameters of a fit")
      ->capture_default_str();
  command
      .add_option("--exclude-sun-deg", options.exclude_sun, "Leave out samples closer to the sun")
      ->type_name("ANGLE")
      ->capture_default_str();
  add_scalar_option(command, options.scalar);
  add_threads_option(command, options.threads);
}

CompareRequest compare_request(const CompareOptions& options) {
  if (options.reference != kOurs) {
    return compare_request(
        options, refs::load_reference(options.reference, parse_sun_zeniths(options.sun_zenith),
                                      parse_sampling(options.sampling),
                                      parse_import_options(options.import)));
  }
  if (options.preset.empty() && !options.atmosphere)
    throw UsageError("--preset", "", fmt::format("expected one with --reference {}", kOurs));
  const Preset preset = preset_of(options, kOurs);
  return request_of(options, preset, solved_reference(options, preset));
}

CompareRequest compare_request(const CompareOptions& options, const refs::Reference& reference) {
  return request_of(options, preset_of(options, reference.name), reference);
}

std::unique_ptr<SkyModel> model_of(const CompareOptions& options, const CompareRequest& request,
                                   const std::string& name) {
  return make_sky_model(name, refs::spectral_data_of(request.preset.atmosphere), options.threads,
                        transfer_for(request.reference, options.scalar));
}

fit::ModelComparison compare_with(
    const CompareOptions& options, const CompareRequest& request, const SkyModel& model,
    const std::function<void(double fraction, const std::string& status)>& progress) {
  fit::FitOptions how;
  how.starts = options.starts;
  how.threads = options.threads;
  how.start = request.preset;
  how.exclude_sun = radians(
      parse_list_within("--exclude-sun-deg", options.exclude_sun, 0, 180, "an angle in degrees")
          .front());
  how.progress = progress;
  fit::validate(how);
  return fit::compare_model(request.reference, refs::spectral_data_of(request.preset.atmosphere),
                            model, request.preset.atmosphere, how.exclude_sun,
                            options.fitted ? &how : nullptr);
}

}  // namespace skyfit::cli
