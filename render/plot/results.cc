// SPDX-License-Identifier: Apache-2.0
#include "render/plot/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "data_refs/joint_reference.h"
#include "data_refs/perez_sky.h"
#include "data_refs/references.h"
#include "model/atmosphere/derived.h"
#include "model/base/misfit.h"
#include "model/base/preset_reader.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"
#include "render/plot/evaluate.h"

namespace skyfit::plot {
namespace {

using nlohmann::json;

// What the preset's `fit` member says about the fit.
struct FitRecord {
  std::string reference, description, model;
  Transfer transfer;
  refs::Quantity quantity;
  double exclude_sun_deg;
  bool scale_is_profiled;
};

template <class T>
T field(const FitOutcome& fit, const char* pointer, const char* expected) {
  const json::json_pointer place(pointer);
  const json& record = fit.preset.fit;
  try {
    if (record.contains(place)) return record.at(place).get<T>();
  } catch (const json::exception&) {
    throw std::invalid_argument(fmt::format("{}: fit{} = {}: expected {}", fit.folder, pointer,
                                            json_excerpt(record.at(place)), expected));
  }
  throw std::invalid_argument(
      fmt::format("{}: fit{}: missing, expected {}", fit.folder, pointer, expected));
}

// Records without one are older than polarisation.
Transfer transfer_of(const FitOutcome& fit) {
  if (!fit.preset.fit.contains("transfer")) return Transfer::kScalar;
  const auto name = field<std::string>(fit, "/transfer", "vector or scalar");
  return name == transfer_name(Transfer::kVector) ? Transfer::kVector : Transfer::kScalar;
}

FitRecord record_of(const FitOutcome& fit) {
  const auto quantity =
      field<std::string>(fit, "/reference/quantity", "luminance_cd_m2 or relative_luminance");
  if (quantity != "luminance_cd_m2" && quantity != "relative_luminance")
    throw std::invalid_argument(fmt::format(
        "{}: fit/reference/quantity = {}: expected luminance_cd_m2 or relative_luminance",
        fit.folder, in_quotes(quantity)));
  return {field<std::string>(fit, "/reference/name", "the reference's name"),
          field<std::string>(fit, "/reference/description", "one line of text"),
          field<std::string>(fit, "/model", "the name of a sky model"),
          transfer_of(fit),
          quantity == "luminance_cd_m2" ? refs::Quantity::kLuminance
                                        : refs::Quantity::kRelativeLuminance,
          field<double>(fit, "/reference/exclude_sun_deg", "a number"),
          field<std::string>(fit, "/likelihood/scale", "how the luminance scale was fitted") ==
              "profiled"};
}

bool is_analytic(const std::string& reference) {
  return (refs::is_perez_name(reference) && !refs::is_joint_name(reference)) ||
         std::ranges::any_of(refs::shipped_references(), [&](const refs::ReferenceEntry& entry) {
           return entry.name == reference;
         });
}

// A sample of weight 0 may hold anything.
std::vector<Sample> positive_samples(const FitOutcome& fit) {
  std::vector<Sample> samples = fit.samples;
  std::erase_if(samples, [](const Sample& s) { return !(s.reference > 0 && s.model > 0); });
  return samples;
}

std::vector<Sample> hemisphere_samples(const FitOutcome& fit, const FitRecord& record,
                                       const SpectralData& spectra, const SkyModel& model) {
  if (!is_analytic(record.reference)) return positive_samples(fit);
  std::set<double> suns;
  for (const auto& sample : fit.samples) suns.insert(sample.sun_zenith_deg * kRadiansPerDegree);
  const auto reference =
      refs::load_reference(record.reference, {suns.begin(), suns.end()}, refs::Sampling::kTregenza);
  return evaluated_samples(reference, fit.preset.atmosphere, spectra, model,
                           record.exclude_sun_deg * kRadiansPerDegree);
}

std::string label_of(std::span<const FitOutcome> fits, std::size_t index) {
  const Preset& preset = fits[index].preset;
  if (fits.size() == 1) return fmt::format("fitted, {}", aerosol_kind(preset.atmosphere));
  const auto same_name = [&](const FitOutcome& other) { return other.preset.name == preset.name; };
  if (std::ranges::count_if(fits, same_name) == 1) return preset.name;
  return fmt::format("{} ({})", preset.name, fits[index].folder);
}

std::string subtitle_of(const Comparison& comparison, const FitRecord& record,
                        std::string_view scale) {
  if (comparison.curves.size() > 1) return std::string(scale);
  const Curve& curve = comparison.curves.front();
  return fmt::format(
      "fitted with the model \"{}\": RMS log error {} in the panels, {} over the whole sky; {}",
      record.model, log_misfit_with_unit(rms_log_percent(plane_samples(curve)), 2),
      log_misfit_with_unit(rms_log_percent(curve.hemisphere), 2), scale);
}

}  // namespace

FitOutcome read_fit_outcome(const std::filesystem::path& directory) {
  return {directory.string(), load_preset(directory / "preset.json"),
          directions_only(read_samples_csv(directory / "samples.csv"))};
}

Comparison comparison_of(std::span<const FitOutcome> fits, const SpectralData& spectra,
                         const ModelNamed& model_named) {
  if (fits.empty() || fits.size() > kMapCurves)
    throw std::invalid_argument(
        fmt::format("figure: {} fits: expected 1 to {}", fits.size(), kMapCurves));
  const FitRecord first = record_of(fits[0]);
  Comparison comparison;
  comparison.reference_label = "reference " + first.reference;
  comparison.quantity = first.quantity;
  comparison.exclude_sun_deg = first.exclude_sun_deg;
  bool one_reference = true, all_profiled = true;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const FitRecord record = record_of(fits[i]);
    if (record.quantity != first.quantity)
      throw std::invalid_argument(fmt::format("{}: its reference has another unit than that of {}",
                                              fits[i].folder, fits[0].folder));
    one_reference &= record.reference == first.reference;
    all_profiled &= record.scale_is_profiled;
    comparison.exclude_sun_deg = std::max(comparison.exclude_sun_deg, record.exclude_sun_deg);
    comparison.curves.push_back(
        {label_of(fits, i), positive_samples(fits[i]),
         hemisphere_samples(fits[i], record, spectra, model_named(record.model, record.transfer))});
  }
  comparison.title = one_reference ? first.description : "Fits compared";
  comparison.subtitle = subtitle_of(
      comparison, first,
      all_profiled ? "luminance scale free per sun position" : "luminances as the fit scales them");
  return comparison;
}

}  // namespace skyfit::plot
