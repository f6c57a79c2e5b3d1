// SPDX-License-Identifier: Apache-2.0
#include "fit/model_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "fit/problem/free_parameters.h"
#include "fit/problem/observations.h"
#include "fit/problem/residuals.h"
#include "fit/problem/starts.h"
#include "fit/result/preset_record.h"

namespace skyfit::fit {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// The reference with weight 0 on what the model cannot do: scans that it refuses, samples where it
// is not bright. `problem` says which.
refs::Reference possible_part(refs::Reference reference, const SkyModel& model,
                              const LuminanceRule& rule, const Atmosphere<double>& atmosphere,
                              std::string& problem) {
  std::map<int, std::vector<std::size_t>> scans;
  for (std::size_t i = 0; i < reference.samples.size(); ++i)
    scans[reference.samples[i].scan].push_back(i);
  int dark = 0;
  std::map<std::string, int> refusals;  // suns by reason
  for (const auto& [scan, samples] : scans) {
    std::vector<SkyPoint> points;
    for (const std::size_t i : samples) points.push_back(sky_point(reference.samples[i]));
    try {
      const Luminance luminance = model_luminance(model, rule, atmosphere, points, {});
      for (std::size_t k = 0; k < samples.size(); ++k) {
        refs::Sample& sample = reference.samples[samples[k]];
        if (luminance.value(static_cast<Eigen::Index>(k)) > 0 || sample.weight == 0) continue;
        sample.weight = 0;
        sample.zero_weight_reason = "the model is dark there";
        ++dark;
      }
    } catch (const std::logic_error& cannot) {  // a point or an atmosphere that it refuses
      for (const std::size_t i : samples) {
        reference.samples[i].weight = 0;
        reference.samples[i].zero_weight_reason = cannot.what();
      }
      ++refusals[cannot.what()];
    }
  }
  for (const auto& [reason, suns] : refusals) {
    problem += fmt::format("{}{} of {} suns refused: {}", problem.empty() ? "" : "; ", suns,
                           scans.size(), reason);
  }
  if (dark > 0) {
    problem +=
        fmt::format("{}dark at {} samples, which are left out", problem.empty() ? "" : "; ", dark);
  }
  return reference;
}

ModelErrors errors_of(const refs::Reference& reference, const SkyModel& model,
                      const LuminanceRule& rule, const Atmosphere<double>& atmosphere,
                      const Observations& observations) {
  Luminance all{Eigen::VectorXd::Constant(static_cast<Eigen::Index>(reference.samples.size()),
                                          std::numeric_limits<double>::quiet_NaN()),
                {}};
  all.value(observations.sample) =
      model_luminance(model, rule, atmosphere, observations.points, {}).value;
  all.derivative.resize(all.value.size(), 0);
  const LogResiduals residuals = log_residuals(observations, select(all, observations));
  ModelErrors errors;
  errors.samples = observations.count();
  const Eigen::VectorXd error = residuals.residual.cwiseQuotient(observations.weight.cwiseSqrt());
  errors.rms_log_percent =
      100 * std::sqrt(residuals.residual.squaredNorm() / observations.weight.sum());
  errors.scale = std::exp(residuals.log_scale.mean());
  Eigen::Index worst = 0;
  error.cwiseAbs().maxCoeff(&worst);
  errors.worst_percent = 100 * error(worst);
  errors.worst = observations.sample[static_cast<std::size_t>(worst)];
  std::map<int, double> scale_of;
  for (int s = 0; s < observations.scans; ++s)
    scale_of[observations.scan_name[static_cast<std::size_t>(s)]] =
        std::exp(residuals.log_scale(s));
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    const auto scale = scale_of.find(reference.samples[i].scan);
    errors.model.push_back(scale == scale_of.end()
                               ? std::numeric_limits<double>::quiet_NaN()
                               : scale->second * all.value(static_cast<Eigen::Index>(i)));
  }
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
                                     const LuminanceRule& rule,
                                     const Atmosphere<double>& atmosphere, double exclude_sun,
                                     std::string& problem, ModelComparison& row) {
  const Clock::time_point begin = Clock::now();
  const std::size_t bytes = model.prepare(atmosphere, rule.nodes);
  const double precompute_seconds = bytes > 0 ? seconds_since(begin) : 0;
  const Observations observations =
      observe(possible_part(reference, model, rule, atmosphere, problem), exclude_sun);
  if (observations.count() == 0) return {};
  row.table_bytes = bytes;
  row.precompute_seconds = precompute_seconds;
  row.seconds_per_direction =
      least_seconds([&] { model.radiance(atmosphere, rule.nodes, observations.points, {}); }) /
      observations.count();
  return errors_of(reference, model, rule, atmosphere, observations);
}

// One row of the table as text fields, in the order of kColumns.
constexpr std::string_view kColumns[] = {"model",
                                         "state",
                                         "samples",
                                         "rms_log_percent",
                                         "scale",
                                         "worst_percent",
                                         "worst_sun_zenith_deg",
                                         "worst_view_zenith_deg",
                                         "worst_relative_azimuth_deg",
                                         "precompute_s",
                                         "time_per_direction_us",
                                         "tables_mb",
                                         "remark"};

constexpr double kDegrees = 180 / std::numbers::pi;

nlohmann::json fields(const refs::Reference& reference, const ModelComparison& row, bool fitted) {
  const std::optional<ModelErrors>& errors = fitted ? row.fitted : row.unfitted;
  nlohmann::json line = {{"model", row.model}, {"state", fitted ? "fitted" : "unfitted"}};
  if (errors) {
    const refs::Sample& worst = reference.samples[errors->worst];
    line["samples"] = errors->samples;
    line["rms_log_percent"] = errors->rms_log_percent;
    line["scale"] = errors->scale;
    line["worst_percent"] = errors->worst_percent;
    line["worst_sun_zenith_deg"] = worst.sun_zenith * kDegrees;
    line["worst_view_zenith_deg"] = worst.view_zenith * kDegrees;
    line["worst_relative_azimuth_deg"] = worst.relative_azimuth * kDegrees;
    line["precompute_s"] = row.precompute_seconds;
    line["time_per_direction_us"] = 1e6 * row.seconds_per_direction;
    line["tables_mb"] = 1e-6 * static_cast<double>(row.table_bytes);
  }
  line["remark"] = fitted ? row.fit_problem : row.problem;
  return line;
}

// RFC 4180.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
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
  if (reference.quantity != refs::Quantity::kSpectralRadiance || wavelengths.size() == 1)
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
  const Observations observations = observe(reference, exclude_sun);
  if (observations.count() == 0) {
    throw std::invalid_argument(
        fmt::format("{}: no sample with weight is farther than {:.6g} deg from the sun, expected "
                    "at least one",
                    reference.name, exclude_sun * kDegrees));
  }
  const LuminanceRule rule = rule_of(reference, spectra);
  row.unfitted = evaluated(reference, model, rule, atmosphere, exclude_sun, row.problem, row);
  if (options == nullptr) return row;
  try {
    FitOptions with_lobes = *options;
    with_lobes.lobes = model.lobes();
    std::string refused;
    const Atmosphere<double> base = start_atmosphere(with_lobes);
    const Start start =
        choose_starts(base, choose_free_parameters(with_lobes, model, base), 1, false).front();
    const refs::Reference possible =
        possible_part(reference, model, rule, start.atmosphere, refused);
    if (observe(possible, exclude_sun).count() == 0) throw std::invalid_argument(refused);
    row.fit = fit_atmosphere(possible, spectra, model, with_lobes);
    row.fitted = evaluated(reference, model, rule, row.fit->preset.atmosphere, exclude_sun,
                           row.fit_problem, row);
  } catch (const std::exception& cannot) {
    row.fit_problem = cannot.what();
  }
  return row;
}

std::string comparison_text(const refs::Reference& reference,
                            const std::vector<ModelComparison>& rows) {
  constexpr std::string_view kRow = "{:<17}{:<9}{:>8}{:>8}{:>10}{:>8}  {:<14}{:>11}{:>14}{:>8}\n";
  std::string text = fmt::format(
      "Reference {}: {}\n"
      "RMS of log(model/reference) with a free scale per sun position; worst direction as sun "
      "zenith/view zenith/azimuth.\n\n",
      reference.name, reference.description);
  text += fmt::format(kRow, "model", "", "samples", "RMS", "scale", "worst", "at", "precompute",
                      "per direction", "tables");
  text += fmt::format(kRow, "", "", "", "%", "ref/model", "%", "deg", "s", "us", "MB");
  for_each_line(reference, rows, [&](const ModelComparison&, const nlohmann::json& line) {
    const std::string model = line["model"], state = line["state"], remark = line["remark"];
    if (line.contains("rms_log_percent")) {
      const auto number = [&](const char* name, std::string_view format) {
        return fmt::format(fmt::runtime(format), line[name].get<double>());
      };
      const bool relative = reference.quantity == refs::Quantity::kRelativeLuminance;
      text += fmt::format(
          kRow, model, state, line["samples"].get<int>(), number("rms_log_percent", "{:.2f}"),
          relative ? "-" : number("scale", "{:.4g}"), number("worst_percent", "{:.1f}"),
          fmt::format("{}/{}/{}", number("worst_sun_zenith_deg", "{:.4g}"),
                      number("worst_view_zenith_deg", "{:.4g}"),
                      number("worst_relative_azimuth_deg", "{:.4g}")),
          number("precompute_s", "{:.3g}"), number("time_per_direction_us", "{:.3g}"),
          number("tables_mb", "{:.4g}"));
    } else {
      text += fmt::format("{:<17}{:<9}no figures\n", model, state);
    }
    if (!remark.empty()) text += fmt::format("{:26}{}\n", "", remark);
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
