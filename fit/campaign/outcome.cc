// SPDX-License-Identifier: Apache-2.0
#include "fit/campaign/outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "data_refs/civil_time.h"
#include "fit/exchange/result_netcdf.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

struct Column {
  std::string_view name, meaning, units;
  double Outcome::*value;
};
constexpr Column kColumns[] = {
    {"time", "begin of the first scan, UTC", kSecondsSince1970, &Outcome::time},
    {"latitude", "latitude of the first scan's site, north > 0", "degree_north",
     &Outcome::latitude},
    {"longitude", "longitude of the first scan's site, east > 0", "degree_east",
     &Outcome::longitude},
    {"elevation", "height of the first scan's site above the sea", "m", &Outcome::elevation},
    {"sun_zenith", "zenith angle of the sun at the begin of the first scan", "degree",
     &Outcome::sun_zenith},
    {"scans", "scans of the task", "1", &Outcome::scans},
    {"samples", "samples that were fitted", "1", &Outcome::samples},
    {"converged", "1: the fit converged", "1", &Outcome::converged},
    {"rms_log", "root mean square of the logarithm of model over sample, scan by scan", "percent",
     &Outcome::rms_log},
    {"luminance_error", "root mean square of model over sample less 1, of luminances", "percent",
     &Outcome::luminance},
    {"spectral_error", "2-norm of model less sample over that of the samples, 400 to 700 nm",
     "percent", &Outcome::spectral},
    {"mean_bias", "mean of the luminances' model over sample less 1", "percent", &Outcome::bias},
    {"sigma_factor", "factor on the assumed noise", "1", &Outcome::sigma_factor},
    {"chi_square_per_dof", "chi square per degree of freedom, without that factor", "1",
     &Outcome::chi_square_per_dof},
};

constexpr const char *kTask = "task", *kKey = "key", *kReason = "reason", *kParameter = "parameter",
                     *kUnit = "parameter_unit", *kValue = "parameter_value",
                     *kSigma = "parameter_sigma", *kAtBound = "at_bound",
                     *kIdentifiable = "identifiable", *kCovarianceName = "covariance_parameter",
                     *kCovarianceName2 = "covariance_parameter_2", *kCovariance = "covariance";
constexpr int kAbsent = -1;  // of a flag of an unknown that a task has not

// All names in the order in which they come, and the place of each.
class Names {
 public:
  void add(const std::string& name) {
    if (place_.try_emplace(name, list_.size()).second) list_.push_back(name);
  }
  std::size_t at(const std::string& name) const { return place_.at(name); }
  const std::vector<std::string>& list() const { return list_; }

 private:
  std::map<std::string, std::size_t> place_;
  std::vector<std::string> list_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string();
}

NetcdfFile variables_of(const std::vector<Outcome>& outcomes, std::string_view title) {
  NetcdfFile file = netcdf_file(title);
  const std::size_t tasks = outcomes.size();
  file.dimensions.emplace_back(kTask, tasks);
  const auto add_texts = [&](const char* name, std::string Outcome::*text, const char* meaning) {
    std::vector<std::string> values;
    for (const Outcome& o : outcomes) values.push_back(o.*text);
    file.variables.push_back({name, {kTask}, std::move(values), meaning, ""});
  };
  add_texts(kTask, &Outcome::task, "name of the task");
  add_texts(kReason, &Outcome::reason, "why the task has no fit; empty where it has one");
  add_texts(kKey, &Outcome::key, "changes with options, files and the version of skyfit");
  for (const Column& column : kColumns) {
    std::vector<double> values;
    for (const Outcome& o : outcomes) values.push_back(o.*column.value);
    file.variables.push_back({std::string(column.name),
                              {kTask},
                              std::move(values),
                              std::string(column.meaning),
                              std::string(column.units)});
  }

  Names parameters, covariance_parameters;
  std::map<std::string, std::string> units;
  for (const Outcome& o : outcomes) {
    for (const Outcome::Value& value : o.unknowns) {
      parameters.add(value.name);
      units[value.name] = value.unit;
    }
    for (const std::string& name : o.covariance_names) covariance_parameters.add(name);
  }
  const std::size_t count = parameters.list().size(), side = covariance_parameters.list().size();
  if (count == 0) return file;
  file.dimensions.emplace_back(kParameter, count);
  file.variables.push_back(
      {kParameter, {kParameter}, parameters.list(), "name of the unknown", ""});
  std::vector<std::string> unit_list;
  for (const std::string& name : parameters.list()) unit_list.push_back(units.at(name));
  file.variables.push_back({kUnit, {kParameter}, std::move(unit_list), "unit of its values", ""});
  const auto add_table = [&](const char* name, auto Outcome::Value::*member, auto absent,
                             const char* meaning, const char* unit) {
    std::vector<decltype(absent)> values(tasks * count, absent);
    for (std::size_t t = 0; t < tasks; ++t) {
      for (const Outcome::Value& value : outcomes[t].unknowns)
        values[t * count + parameters.at(value.name)] = value.*member;
    }
    file.variables.push_back({name, {kTask, kParameter}, std::move(values), meaning, unit});
  };
  add_table(kValue, &Outcome::Value::value, Outcome::kNone, "fitted value, in parameter_unit", "");
  add_table(kSigma, &Outcome::Value::sigma, Outcome::kNone,
            "one standard deviation, in parameter_unit; missing at a bound", "");
  add_table(kAtBound, &Outcome::Value::at_bound, kAbsent,
            "1: the value is at its bound; -1: the task has no such unknown", "1");
  add_table(kIdentifiable, &Outcome::Value::identifiable, kAbsent,
            "0: the value is that of the prior; -1: the task has no such unknown", "1");
  if (side == 0) return file;
  for (const char* name : {kCovarianceName, kCovarianceName2}) {
    file.dimensions.emplace_back(name, side);
    file.variables.push_back(
        {name, {name}, covariance_parameters.list(), "name of the unknown", ""});
  }
  std::vector<double> matrices(tasks * side * side, Outcome::kNone);
  for (std::size_t t = 0; t < tasks; ++t) {
    const Outcome& o = outcomes[t];
    for (std::size_t i = 0; i < o.covariance_names.size(); ++i) {
      for (std::size_t j = 0; j < o.covariance_names.size(); ++j) {
        matrices[(t * side + covariance_parameters.at(o.covariance_names[i])) * side +
                 covariance_parameters.at(o.covariance_names[j])] =
            o.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    }
  }
  file.variables.push_back({kCovariance,
                            {kTask, kCovarianceName, kCovarianceName2},
                            std::move(matrices),
                            "covariance, in the products of the parameters' units",
                            ""});
  return file;
}

}  // namespace

std::string iso_time(const Outcome& outcome) {
  if (!std::isfinite(outcome.time)) return {};
  return refs::iso_text(
      refs::Instant(std::chrono::milliseconds(std::llround(1000 * outcome.time))));
}

double Outcome::misfit() const {
  if (std::isfinite(spectral)) return spectral;
  return std::isfinite(luminance) ? luminance : rms_log;
}

Outcome outcome_of(const Task& task, const Result& result) {
  Outcome o;
  o.task = task.name;
  o.key = task.key;
  if (!result.scans.empty()) {
    const ScanInfo& first = result.scans.front().info;
    o.time = seconds_since_1970(first.time_utc);
    o.sun_zenith = first.sun_zenith / kRadiansPerDegree;
    if (static_cast<std::size_t>(first.number) < result.reference.scans.size()) {
      const refs::Scan& scan = result.reference.scans[static_cast<std::size_t>(first.number)];
      if (scan.site) {
        o.latitude = scan.site->latitude / kRadiansPerDegree;
        o.longitude = scan.site->longitude / kRadiansPerDegree;
      }
      if (scan.elevation_m) o.elevation = *scan.elevation_m;
    }
  }
  o.scans = static_cast<double>(result.scans.size());
  o.samples = result.samples;
  o.converged = result.converged ? 1 : 0;
  o.rms_log = result.errors.rms_log;
  o.luminance = result.errors.luminance;
  o.spectral = result.errors.spectral;
  o.bias = result.errors.mean_bias;
  o.sigma_factor = result.sigma_factor;
  o.chi_square_per_dof = result.chi_square_per_dof;
  for (const UnknownRow& row : result.unknowns)
    o.unknowns.push_back({row.unknown.name(), cf_unit(row.unknown.unit()), row.fitted, row.sigma,
                          row.at_bound ? 1 : 0, row.identifiable ? 1 : 0});
  for (const int i : result.covariance_unknowns)
    o.covariance_names.push_back(result.unknowns[static_cast<std::size_t>(i)].unknown.name());
  o.covariance = result.covariance;
  if (o.covariance.size() == 0) o.covariance_names.clear();
  return o;
}

Outcome failure_of(const Task& task, std::string reason, const std::filesystem::path& folder) {
  const std::string prefix = folder.empty() ? "" : (folder / "").string();
  for (std::size_t at = 0; !prefix.empty() && (at = reason.find(prefix, at)) != std::string::npos;)
    reason.erase(at, prefix.size());
  Outcome o;
  o.task = task.name;
  o.key = task.key;
  o.reason = printable(reason);
  return o;
}

NetcdfFile netcdf_of(const std::vector<Outcome>& outcomes, std::string_view title) {
  NetcdfFile file = variables_of(outcomes, title);
  set_coordinates(file, kTask, {"time", "latitude", "longitude", "elevation"});
  return file;
}

std::vector<Outcome> outcomes_of(const NetcdfFile& file, std::string_view source) {
  using Texts = std::vector<std::string>;
  using Numbers = std::vector<double>;
  const auto has = [&](const char* dimension) {
    return std::ranges::count(file.dimensions, dimension,
                              &std::pair<std::string, std::size_t>::first) > 0;
  };
  const Texts &tasks = netcdf_values<Texts>(file, kTask, source),
              &keys = netcdf_values<Texts>(file, kKey, source),
              &reasons = netcdf_values<Texts>(file, kReason, source);
  std::vector<Outcome> outcomes(tasks.size());
  // Every variable has the size of its dimensions; that these are the right ones is checked here.
  const auto expect_size = [&](std::size_t size, std::size_t expected) {
    if (size != expected)
      throw std::runtime_error(fmt::format("{}: expected results of a campaign", source));
  };
  expect_size(keys.size(), tasks.size());
  expect_size(reasons.size(), tasks.size());
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    outcomes[t].task = tasks[t];
    outcomes[t].key = keys[t];
    outcomes[t].reason = reasons[t];
  }
  for (const Column& column : kColumns) {
    const Numbers& values = netcdf_values<Numbers>(file, column.name, source);
    expect_size(values.size(), tasks.size());
    for (std::size_t t = 0; t < tasks.size(); ++t) outcomes[t].*column.value = values[t];
  }
  if (!has(kParameter)) return outcomes;
  const Texts &names = netcdf_values<Texts>(file, kParameter, source),
              &units = netcdf_values<Texts>(file, kUnit, source);
  const Numbers &values = netcdf_values<Numbers>(file, kValue, source),
                &sigmas = netcdf_values<Numbers>(file, kSigma, source);
  const std::vector<int>&at_bound = netcdf_values<std::vector<int>>(file, kAtBound, source),
        &identifiable = netcdf_values<std::vector<int>>(file, kIdentifiable, source);
  const std::size_t count = names.size();
  expect_size(units.size(), count);
  for (const std::size_t size :
       {values.size(), sigmas.size(), at_bound.size(), identifiable.size()})
    expect_size(size, tasks.size() * count);
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    for (std::size_t p = 0; p < count; ++p) {
      const std::size_t i = t * count + p;
      if (at_bound[i] != kAbsent)
        outcomes[t].unknowns.push_back(
            {names[p], units[p], values[i], sigmas[i], at_bound[i], identifiable[i]});
    }
  }
  if (!has(kCovarianceName)) return outcomes;
  const Texts& sides = netcdf_values<Texts>(file, kCovarianceName, source);
  const Numbers& matrices = netcdf_values<Numbers>(file, kCovariance, source);
  const std::size_t side = sides.size();
  expect_size(matrices.size(), tasks.size() * side * side);
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    const auto at = [&](std::size_t i, std::size_t j) {
      return matrices[(t * side + i) * side + j];
    };
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < side; ++i) {
      if (!std::isnan(at(i, i))) own.push_back(i);
    }
    Outcome& o = outcomes[t];
    const auto size = static_cast<Eigen::Index>(own.size());
    o.covariance.resize(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
      o.covariance_names.push_back(sides[own[static_cast<std::size_t>(i)]]);
      for (Eigen::Index j = 0; j < size; ++j)
        o.covariance(i, j) = at(own[static_cast<std::size_t>(i)], own[static_cast<std::size_t>(j)]);
    }
  }
  return outcomes;
}

std::vector<int> outliers(const std::vector<Outcome>& outcomes) {
  constexpr double kNormal = 1.4826, kFar = 5;
  std::vector<double> misfits;
  for (const Outcome& o : outcomes) {
    if (std::isfinite(o.misfit())) misfits.push_back(o.misfit());
  }
  std::vector<int> flags(outcomes.size(), 0);
  if (misfits.empty()) return flags;
  const double middle = median(misfits);
  for (double& misfit : misfits) misfit = std::abs(misfit - middle);
  const double limit = middle + kFar * kNormal * median(misfits);
  std::ranges::transform(outcomes, flags.begin(),
                         [&](const Outcome& o) { return o.misfit() > limit ? 1 : 0; });
  return flags;
}

std::string campaign_csv(const std::vector<Outcome>& outcomes) {
  Names parameters;
  for (const Outcome& o : outcomes) {
    for (const Outcome::Value& value : o.unknowns) parameters.add(value.name);
  }
  std::string text = "task,state,reason";
  for (const Column& column : kColumns) text += fmt::format(",{}", column.name);
  for (const std::string& name : parameters.list())
    text += fmt::format(",{0},sigma_{0}", csv_field(name));
  text += '\n';
  const std::vector<int> far = outliers(outcomes);
  for (std::size_t t = 0; t < outcomes.size(); ++t) {
    const Outcome& o = outcomes[t];
    const char* state = !o.reason.empty() ? "failed" : far[t] != 0 ? "outlier" : "fitted";
    text += fmt::format("{},{},{}", csv_field(o.task), state, csv_field(o.reason));
    for (const Column& column : kColumns)
      text += fmt::format(
          ",{}", column.value == &Outcome::time ? iso_time(o) : csv_number(o.*column.value));
    std::vector<std::string> cells(2 * parameters.list().size());
    for (const Outcome::Value& value : o.unknowns) {
      const std::size_t at = 2 * parameters.at(value.name);
      cells[at] = csv_number(value.value);
      cells[at + 1] = csv_number(value.sigma);
    }
    for (const std::string& cell : cells) text += fmt::format(",{}", cell);
    text += '\n';
  }
  return text;
}

std::string campaign_text(const std::vector<Outcome>& outcomes) {
  constexpr std::size_t kMostListed = 20;
  std::vector<std::string> failed, far;
  int unconverged = 0;
  std::vector<double> misfits;
  Names parameters;
  std::map<std::string, std::vector<double>> values;
  std::map<std::string, std::string> units;
  const std::vector<int> flags = outliers(outcomes);
  for (std::size_t t = 0; t < outcomes.size(); ++t) {
    const Outcome& o = outcomes[t];
    if (!o.reason.empty()) {
      const bool is_named = o.reason.starts_with(o.task);
      failed.push_back(is_named ? "  " + o.reason
                                : fmt::format("  {}: {}", printable(o.task), o.reason));
      continue;
    }
    if (std::isfinite(o.misfit())) misfits.push_back(o.misfit());
    if (flags[t] != 0)
      far.push_back(fmt::format("  {}: misfit {:.3g} %", printable(o.task), o.misfit()));
    unconverged += o.converged == 1 ? 0 : 1;
    for (const Outcome::Value& value : o.unknowns) {
      parameters.add(value.name);
      values[value.name].push_back(value.value);
      units[value.name] = value.unit;
    }
  }
  std::string text = fmt::format("{} task{}: {} fitted, {} of them outliers, {} failed\n",
                                 outcomes.size(), outcomes.size() == 1 ? "" : "s",
                                 outcomes.size() - failed.size(), far.size(), failed.size());
  if (unconverged > 0)
    text += fmt::format("NOT CONVERGED: {} of those fitted (column converged)\n", unconverged);
  if (!misfits.empty())
    text += fmt::format(
        "misfit (spectral error, else that of luminances, else rms_log): median {:.3g} %\n",
        median(misfits));
  for (const std::string& name : parameters.list()) {
    const std::vector<double>& all = values.at(name);
    const double middle = median(all);
    std::vector<double> away;
    for (const double value : all) away.push_back(std::abs(value - middle));
    const std::string unit = units.at(name) == "1" ? "" : fmt::format(" {}", units.at(name));
    text += fmt::format("{}: median {:.4g}{}, half of the tasks within {:.3g}{} of it\n", name,
                        middle, unit, median(away), unit);
  }
  const auto list = [&](std::string_view title, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    text += fmt::format("{}\n", title);
    for (std::size_t i = 0; i < std::min(lines.size(), kMostListed); ++i) text += lines[i] + "\n";
    if (lines.size() > kMostListed)
      text += fmt::format("  and {} more, see campaign.csv\n", lines.size() - kMostListed);
  };
  list("outliers (misfit above the median by five robust standard deviations):", far);
  list("failed:", failed);
  return text;
}

}  // namespace skyfit::fit
