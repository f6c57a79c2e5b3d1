// SPDX-License-Identifier: Apache-2.0
#include "fit/model_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "fit/problem/free_parameters.h"
#include "fit/problem/starts.h"
#include "fit/result/errors.h"
#include "fit/result/record.h"
#include "model/base/counted.h"
#include "model/base/misfit.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// What the model can tell of one scan, or of all.
Eigen::VectorXd values_of(const SkyModel& model, const Dataset& data,
                          const Atmosphere<double>& atmosphere) {
  const SkyState state = start_state(atmosphere, static_cast<int>(data.scans.size()));
  return sky_values(model, data, state, {}).value;
}

// The reference with weight 0 on what the model cannot do: scans that it refuses, samples where it
// is not bright. `problem` says which.
refs::Reference possible_part(refs::Reference reference, const SkyModel& model,
                              const SpectralData& spectra, const Atmosphere<double>& atmosphere,
                              std::string& problem) {
  const Dataset all = dataset(reference, spectra, {true, 0, {}, 0});
  int dark = 0;
  std::map<std::string, int> refusals;  // suns by reason
  const auto leave_out = [&](const Sample& sample, std::string_view reason) {
    reference.samples[sample.index].weight = 0;
    reference.samples[sample.index].zero_weight_reason = reason;
  };
  for (std::size_t scan = 0; scan < all.scans.size(); ++scan) {
    const Dataset own = only_scan(all, static_cast<int>(scan));
    try {
      const Eigen::VectorXd value = values_of(model, own, atmosphere);
      for (std::size_t k = 0; k < own.samples.size(); ++k) {
        if (value(static_cast<Eigen::Index>(k)) > 0 ||
            reference.samples[own.samples[k].index].weight == 0)
          continue;
        leave_out(own.samples[k], "the model is dark there");
        ++dark;
      }
    } catch (const std::logic_error& cannot) {  // a point or an atmosphere that it refuses
      for (const Sample& sample : own.samples) leave_out(sample, cannot.what());
      ++refusals[cannot.what()];
    }
  }
  for (const auto& [reason, suns] : refusals) {
    problem += fmt::format("{}{} of {} refused: {}", problem.empty() ? "" : "; ", suns,
                           counted(std::ssize(all.scans), "sun"), reason);
  }
  if (dark > 0) {
    problem +=
        fmt::format("{}dark at {} samples, which are left out", problem.empty() ? "" : "; ", dark);
  }
  return reference;
}

// Every scan with its own scale, which is profiled out of the logarithms.
constexpr Likelihood kCompared{Link::kLog, Scale::kProfiled, {}, false, Loss::kNone, 3};

ModelErrors errors_of(const refs::Reference& reference, const SkyModel& model,
                      const Atmosphere<double>& atmosphere, const Dataset& compared) {
  const Eigen::VectorXd value = values_of(model, compared, atmosphere);
  const Whitened white = whiten(compared, kCompared, {value, Eigen::MatrixXd(value.size(), 0)}, 1);
  ModelErrors errors;
  errors.samples = static_cast<int>(compared.samples.size());
  errors.model.assign(reference.samples.size(), std::numeric_limits<double>::quiet_NaN());
  double squares = 0, weights = 0, log_scales = 0, scans = 0;
  for (std::size_t k = 0; k < compared.samples.size(); ++k) {
    const Sample& sample = compared.samples[k];
    const double model_value =
        white.scale(compared.scan_of(sample)) * value(static_cast<Eigen::Index>(k));
    errors.model[sample.index] = model_value;
    const double error = std::log(model_value / sample.value);
    const double weight = reference.samples[sample.index].weight;
    squares += weight * error * error;
    weights += weight;
    if (100 * std::abs(error) <= std::abs(errors.worst_percent)) continue;
    errors.worst_percent = 100 * error;
    errors.worst = sample.index;
  }
  errors.rms_log_percent = 100 * std::sqrt(squares / weights);
  for (const double scale : white.scale) {
    if (!std::isfinite(scale)) continue;
    log_scales += std::log(scale);
    ++scans;
  }
  errors.scale = std::exp(log_scales / scans);
  return errors;
}

// The least of a few runs, at least one and until a tenth of a second has passed.
template <class Work>
double least_seconds(const Work& work) {
  const Clock::time_point begin = Clock::now();
  double least = std::numeric_limits<double>::infinity();
  do {
    const Clock::time_point start = Clock::now();
    work();
    least = std::min(least, seconds_since(start));
  } while (seconds_since(begin) < 0.1);
  return least;
}

// What the model can do of the reference, with an atmosphere.
std::optional<ModelErrors> evaluated(const refs::Reference& reference, const SkyModel& model,
                                     const SpectralData& spectra,
                                     const Atmosphere<double>& atmosphere, double exclude_sun,
                                     std::string& problem, ModelComparison& row) {
  const Clock::time_point begin = Clock::now();
  const std::vector<WavelengthNode> nodes = dataset(reference, spectra, {true, 0, {}, 0}).nodes;
  const std::size_t bytes = model.prepare(atmosphere, nodes);
  const double precompute_seconds = bytes > 0 ? seconds_since(begin) : 0;
  const refs::Reference possible = possible_part(reference, model, spectra, atmosphere, problem);
  const Dataset compared = dataset(possible, spectra, {false, exclude_sun, {}, 0});
  if (compared.samples.empty()) return {};
  row.table_bytes = bytes;
  row.precompute_seconds = precompute_seconds;
  row.seconds_per_direction = least_seconds([&] { values_of(model, compared, atmosphere); }) /
                              static_cast<double>(compared.lines_of_sight.size());
  return errors_of(possible, model, atmosphere, compared);
}

// One row of the table as text fields, in the order of kColumns.
constexpr std::string_view kColumns[] = {"model",
                                         "transfer",
                                         "state",
                                         "samples",
                                         "rms_log_percent",
                                         "scale",
                                         "worst_percent",
                                         "worst_sun_zenith_deg",
                                         "worst_view_zenith_deg",
                                         "worst_relative_azimuth_deg",
                                         "worst_wavelength_nm",
                                         "precompute_s",
                                         "time_per_direction_us",
                                         "tables_mb",
                                         "remark"};

nlohmann::json fields(const refs::Reference& reference, const ModelComparison& row, bool fitted) {
  const std::optional<ModelErrors>& errors = fitted ? row.fitted : row.unfitted;
  nlohmann::json line = {{"model", row.model},
                         {"transfer", transfer_name(row.transfer)},
                         {"state", fitted ? "fitted" : "unfitted"}};
  if (errors) {
    const refs::Sample& worst = reference.samples[errors->worst];
    line["samples"] = errors->samples;
    line["rms_log_percent"] = errors->rms_log_percent;
    line["scale"] = errors->scale;
    line["worst_percent"] = errors->worst_percent;
    line["worst_sun_zenith_deg"] = worst.sun_zenith * kDegreesPerRadian;
    line["worst_view_zenith_deg"] = worst.view_zenith * kDegreesPerRadian;
    line["worst_relative_azimuth_deg"] = worst.relative_azimuth * kDegreesPerRadian;
    if (worst.wavelength_nm > 0) line["worst_wavelength_nm"] = worst.wavelength_nm;
    line["precompute_s"] = row.precompute_seconds;
    line["time_per_direction_us"] = 1e6 * row.seconds_per_direction;
    line["tables_mb"] = 1e-6 * static_cast<double>(row.table_bytes);
  }
  line["remark"] = fitted ? row.fit_problem : row.problem;
  return line;
}

template <class Use>
void for_each_line(const refs::Reference& reference, const std::vector<ModelComparison>& rows,
                   const Use& use) {
  for (const ModelComparison& row : rows) {
    use(row, fields(reference, row, false));
    if (row.fit || !row.fit_problem.empty()) use(row, fields(reference, row, true));
  }
}

}  // namespace

refs::Reference comparison_reference(const refs::Reference& reference,
                                     const SpectralData& spectra) {
  std::map<std::pair<int, int>, std::vector<const refs::Sample*>> directions;
  std::set<double> wavelengths;
  for (const refs::Sample& sample : reference.samples) {
    directions[{sample.scan, sample.direction}].push_back(&sample);
    wavelengths.insert(sample.wavelength_nm);
  }
  if (reference.quantity != refs::Quantity::kSpectralRadiance || !gives_luminance(reference))
    return reference;
  constexpr double kLumenPerWatt = 683.002;
  refs::Reference luminances = reference;
  luminances.quantity = refs::Quantity::kLuminance;
  luminances.samples.clear();
  for (const auto& [place, samples] : directions) {
    const bool whole =
        samples.size() == wavelengths.size() &&
        std::ranges::all_of(samples, [](const refs::Sample* s) { return s->weight > 0; });
    if (!whole) continue;
    std::vector<const refs::Sample*> ascending = samples;
    std::ranges::sort(ascending, {}, [](const refs::Sample* s) { return s->wavelength_nm; });
    refs::Sample sum = *ascending.front();
    sum.wavelength_nm = sum.value = 0;
    sum.sigma.reset();
    for (std::size_t k = 0; k < ascending.size(); ++k) {
      const double low = ascending[k > 0 ? k - 1 : k]->wavelength_nm,
                   high = ascending[std::min(k + 1, ascending.size() - 1)]->wavelength_nm;
      sum.value += kLumenPerWatt * 0.5 * (high - low) *
                   spectra.y_bar.at_or_zero(ascending[k]->wavelength_nm) * ascending[k]->value;
    }
    luminances.samples.push_back(sum);
  }
  return luminances;
}

ModelComparison compare_model(const refs::Reference& reference, const SpectralData& spectra,
                              const SkyModel& model, const Atmosphere<double>& atmosphere,
                              double exclude_sun, const FitOptions* options) {
  ModelComparison row;
  row.model = std::string(model.name());
  row.transfer = model.transfer();
  if (dataset(reference, spectra, {false, exclude_sun, {}, 0}).samples.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: no sample with weight is farther than {:.6g} deg from the sun, expected "
                    "at least one",
                    reference.name, exclude_sun * kDegreesPerRadian));
  }
  row.unfitted = evaluated(reference, model, spectra, atmosphere, exclude_sun, row.problem, row);
  if (options == nullptr) return row;
  try {
    FitOptions own = *options;
    own.lobes = model.lobes();
    own.link = kCompared.link;
    own.scale = kCompared.scale;
    own.pointing = Pointing::kStated;
    std::string refused;
    const Atmosphere<double> base = start_atmosphere(own);
    const Start start =
        choose_starts(base, choose_free_parameters(own, model, base), 1, false).front();
    const refs::Reference possible =
        possible_part(reference, model, spectra, start.atmosphere, refused);
    if (dataset(possible, spectra, {false, exclude_sun, {}, 0}).samples.empty())
      throw std::invalid_argument(refused);
    row.fit = fit_atmosphere(possible, spectra, model, own);
    row.fitted = evaluated(reference, model, spectra, row.fit->preset.atmosphere, exclude_sun,
                           row.fit_problem, row);
  } catch (const std::exception& cannot) {
    row.fit_problem = cannot.what();
  }
  return row;
}

std::string comparison_text(const refs::Reference& reference,
                            const std::vector<ModelComparison>& rows) {
  constexpr std::string_view kRow = "{}{:<9}{:>8}{:>8}{:>10}{:>8}  {:<14}{:>11}{:>14}{:>8}\n";
  std::size_t width = 17;
  for (const ModelComparison& row : rows) width = std::max(width, row.model.size() + 1);
  const auto padded = [&](std::string_view model) { return fmt::format("{:<{}}", model, width); };
  std::string text = fmt::format(
      "Reference {}: {}\n"
      "RMS of log(model/reference) with a free scale per sun position, above {:g} % as a factor; "
      "worst "
      "direction as sun zenith/view zenith/azimuth.\n{}\n",
      reference.name, reference.description, kMostPercent,
      reference.transfer == Transfer::kScalar
          ? "The reference was computed without polarisation; so are the models.\n"
          : "");
  text += fmt::format(kRow, padded("model"), "", "samples", "RMS", "scale", "worst", "at",
                      "precompute", "per direction", "tables");
  text += fmt::format(kRow, padded(""), "", "", "%", "ref/model", "%", "deg", "s", "us", "MB");
  for_each_line(reference, rows, [&](const ModelComparison&, const nlohmann::json& line) {
    const std::string model = line["model"], state = line["state"], remark = line["remark"];
    if (line.contains("rms_log_percent")) {
      const auto number = [&](const char* name, std::string_view format) {
        return fmt::format(fmt::runtime(format), line[name].get<double>());
      };
      const bool relative = reference.quantity == refs::Quantity::kRelativeLuminance;
      text += fmt::format(kRow, padded(model), state, line["samples"].get<int>(),
                          log_misfit(line["rms_log_percent"].get<double>(), 2),
                          relative ? "-" : number("scale", "{:.4g}"),
                          log_misfit(line["worst_percent"].get<double>(), 1),
                          fmt::format("{}/{}/{}", number("worst_sun_zenith_deg", "{:.4g}"),
                                      number("worst_view_zenith_deg", "{:.4g}"),
                                      number("worst_relative_azimuth_deg", "{:.4g}")),
                          number("precompute_s", "{:.3g}"),
                          number("time_per_direction_us", "{:.3g}"), number("tables_mb", "{:.4g}"));
    } else {
      text += fmt::format("{}{:<9}no figures\n", padded(model), state);
    }
    if (!remark.empty()) text += fmt::format("{}{:9}{}\n", padded(""), "", remark);
  });
  return text;
}

std::string comparison_csv(const refs::Reference& reference,
                           const std::vector<ModelComparison>& rows) {
  std::string text = fmt::format("{}\n", fmt::join(kColumns, ","));
  for_each_line(reference, rows, [&](const ModelComparison&, const nlohmann::json& line) {
    std::string_view separator;
    for (const std::string_view column : kColumns) {
      text += separator;
      separator = ",";
      const auto value = line.find(column);
      if (value == line.end()) continue;
      if (value->is_number()) {
        text += fmt::format("{:.9g}", value->get<double>());
      } else {
        text += csv_field(value->get<std::string>());
      }
    }
    text += '\n';
  });
  return text;
}

nlohmann::json comparison_json(const refs::Reference& reference,
                               const std::vector<ModelComparison>& rows) {
  nlohmann::json lines = nlohmann::json::array();
  for_each_line(reference, rows, [&](const ModelComparison& row, nlohmann::json line) {
    for (auto& field : line) {
      if (field.is_number()) field = finite_or_null(field.get<double>());
    }
    if (line["state"] == "fitted" && row.fit)
      line["preset"] = nlohmann::json::parse(preset_to_json(row.fit->preset));
    lines.push_back(std::move(line));
  });
  return {{"reference", {{"name", reference.name}, {"description", reference.description}}},
          {"models", lines}};
}

}  // namespace skyfit::fit
