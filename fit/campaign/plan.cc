// SPDX-License-Identifier: Apache-2.0
#include "fit/campaign/plan.h"

#include <fmt/format.h>
#include <glob.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "data_refs/civil_time.h"
#include "data_refs/import_options.h"
#include "data_refs/joint_reference.h"
#include "fit/campaign/toml_document.h"
#include "model/base/content_hash.h"
#include "model/base/preset_reader.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"
#include "model/version.h"

namespace skyfit::fit {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, Grouping>, 4> kGroupings = {
    {{"file", Grouping::kFile},
     {"scan", Grouping::kScan},
     {"day", Grouping::kDay},
     {"site", Grouping::kSite}}};
constexpr std::array<std::pair<std::string_view, InputKind>, 2> kInputKinds = {
    {{"skies", InputKind::kSkies}, {"irradiances", InputKind::kIrradiances}}};
constexpr int kPlanVersion = 1, kMostTasksPerFile = 10'000;

// {"lobes": 1, "no-priors": true, "fix": ["a=1", "b=2"]} as --lobes 1 --no-priors --fix a=1 --fix
// b=2.
std::vector<std::string> arguments_of(const PresetReader& options) {
  std::vector<std::string> arguments;
  const auto add = [&](const std::string& name, const nlohmann::json& value) {
    if (value.is_boolean()) {
      if (value.get<bool>()) arguments.push_back("--" + name);
    } else if (value.is_string() || value.is_number()) {
      arguments.push_back("--" + name);
      arguments.push_back(value.is_string() ? value.get<std::string>() : value.dump());
    } else {
      options.fail_value(name, "a text, a number, true, or a list of these");
    }
  };
  for (const auto& [name, value] : options.value().items()) {
    if (value.is_array()) {
      for (const nlohmann::json& one : value) add(name, one);
    } else {
      add(name, value);
    }
  }
  return arguments;
}

// The value of the row that a field names.
template <class Rows>
auto named(const PresetReader& plan, std::string_view field, const Rows& rows) {
  const std::string text = plan.text(field);
  std::string names;
  for (const auto& [name, value] : rows) {
    if (name == text) return value;
    names += fmt::format("{}{}", names.empty() ? "one of " : ", ", name);
  }
  plan.fail_value(field, names);
}

int whole_number(const PresetReader& plan, std::string_view field, int lower, int upper) {
  const double value = plan.number(field);
  if (value != std::floor(value) || value < lower || value > upper)
    plan.fail_value(field, fmt::format("a whole number, {} to {}", lower, upper));
  return static_cast<int>(value);
}

// The paths that an input stands for, as the plan names them.
std::vector<std::string> matches(const CampaignPlan& plan, const std::string& input,
                                 NamedFiles named) {
  const std::string pattern = (plan.folder / input).string();
  glob_t found{};
  const int status = glob(pattern.c_str(), GLOB_ERR, nullptr, &found);
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < found.gl_pathc; ++i) paths.emplace_back(found.gl_pathv[i]);
  globfree(&found);
  if (status != 0)
    throw std::invalid_argument(fmt::format(
        "{}: inputs: {}: expected a file or a pattern of files in the folder of the plan",
        plan.inputs_place, printable(input)));
  // What describes a sky beside it is no sky.
  std::erase_if(paths, [](const std::string& path) { return path.ends_with(".sidecar.json"); });
  for (std::string& path : paths) {
    if (!fs::path(input).is_absolute())
      path = fs::path(path).lexically_relative(plan.folder).string();
    if (!named_file(plan.folder, path, named))
      throw std::invalid_argument(fmt::format("{}: inputs: {}: expected {}", plan.inputs_place,
                                              printable(path), kNamedFile));
  }
  return paths;
}

std::string site_of(const refs::Scan& scan) {
  if (!scan.site) return {};
  return fmt::format("{:.4f},{:.4f}", scan.site->latitude / kRadiansPerDegree,
                     scan.site->longitude / kRadiansPerDegree);
}

// The day by mean solar time: the date of UTC plus the longitude's share of a day.
std::string day_of(const refs::Scan& scan) {
  const std::optional<refs::Instant> time = refs::instant(scan.time_utc, 0);
  if (!time) return {};
  constexpr double kMillisecondsPerRadian = 86'400'000 / (2 * std::numbers::pi);
  const double ahead = scan.site ? scan.site->longitude * kMillisecondsPerRadian : 0;
  return refs::iso_text(*time + std::chrono::milliseconds(std::llround(ahead))).substr(0, 10);
}

// The group of a scan; throws std::invalid_argument where it cannot be told.
std::string group_of(const CampaignPlan& plan, const refs::Scan& scan) {
  const std::string site = site_of(scan), day = day_of(scan);
  if (plan.group == Grouping::kSite) {
    if (site.empty())
      throw std::invalid_argument(
          "its site is not known: expected latitude_deg and longitude_deg "
          "with \"group\": \"site\"");
    return site;
  }
  if (day.empty())
    throw std::invalid_argument("its time is not known: expected one with \"group\": \"day\"");
  return site.empty() ? day : day + " at " + site;
}

// That the sidecar of an image names; what is wrong with a sidecar the fit says.
std::optional<std::string> mask_of(const fs::path& file, NamedFiles named) {
  refs::ImportOptions options;
  options.named_files = named;
  try {
    return refs::with_sidecar(options, file).mask;
  } catch (const std::exception&) {
    return {};
  }
}

std::string key_of(const CampaignPlan& plan, const Task& task, NamedFiles named) {
  ContentHash hash;
  hash.add(kVersion);
  if (plan.kind == InputKind::kIrradiances) hash.add("irradiances\n");
  if (!plan.irradiances.empty()) {
    hash.add("beside\n");
    hash.add_file(plan.folder / plan.irradiances);
  }
  for (const std::string& option : plan.options) {
    hash.add(option + "\n");
    if (fs::is_regular_file(option)) hash.add_file(option);  // a preset, say
  }
  for (const Task::Part& part : task.parts) {
    hash.add(part.file.filename().string());
    for (const int scan : part.scans) hash.add(fmt::format("[{}]", scan));
    hash.add_file(part.file);
    hash.add_file(part.file.string() + ".sidecar.json");
    if (const auto mask = mask_of(part.file, named)) hash.add_file(*mask);
  }
  return hash.text();
}

// What a file holds, as far as grouping asks.
struct Contents {
  std::vector<refs::Scan> scans;
  std::string problem;
};

std::vector<Task> grouped(const CampaignPlan& plan, const std::vector<std::string>& names,
                          const std::vector<Contents>& contents) {
  std::map<std::string, Task> tasks;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const fs::path file = plan.folder / names[i];
    const auto add = [&](const std::string& name, std::vector<int> scans, std::string problem) {
      Task& task = tasks[name];
      task.name = name;
      if (!problem.empty()) task.problem = std::move(problem);
      if (task.parts.empty() || task.parts.back().file != file) {
        task.parts.push_back({file, std::move(scans)});
      } else {
        std::ranges::copy(scans, std::back_inserter(task.parts.back().scans));
      }
    };
    if (plan.group == Grouping::kFile || !contents[i].problem.empty()) {
      add(names[i], {}, contents[i].problem);
      continue;
    }
    for (int scan = 0; scan < std::ssize(contents[i].scans); ++scan) {
      const std::string name = fmt::format("{}[{}]", names[i], scan + 1);
      if (plan.group == Grouping::kScan) {
        add(name, {scan}, {});
        continue;
      }
      try {
        add(group_of(plan, contents[i].scans[static_cast<std::size_t>(scan)]), {scan}, {});
      } catch (const std::invalid_argument& unknown) {
        add(name, {scan}, unknown.what());
      }
    }
  }
  std::vector<Task> list;
  for (auto& [name, task] : tasks) list.push_back(std::move(task));
  return list;
}

// One per scan, also where nothing is known of them.
std::vector<refs::Scan> scans_of(const refs::Reference& reference) {
  std::vector<refs::Scan> scans = reference.scans;
  for (const refs::Sample& sample : reference.samples)
    scans.resize(std::max(scans.size(), static_cast<std::size_t>(sample.scan) + 1));
  return scans;
}

refs::Reference only_scans(refs::Reference reference, const std::vector<int>& scans) {
  if (scans.empty()) return reference;
  const std::vector<refs::Scan> all = scans_of(reference);
  std::map<int, int> place;
  std::vector<refs::Scan> kept;
  for (const int scan : scans) {
    place[scan] = static_cast<int>(kept.size());
    kept.push_back(all.at(static_cast<std::size_t>(scan)));
  }
  std::erase_if(reference.samples, [&](const refs::Sample& s) { return !place.contains(s.scan); });
  for (refs::Sample& sample : reference.samples) sample.scan = place.at(sample.scan);
  reference.scans = std::move(kept);
  return reference;
}

}  // namespace

std::string CampaignPlan::place_of_option(std::string_view message) const {
  std::size_t first = message.npos;
  std::string place = option_places.at("");
  for (const auto& [name, at] : option_places) {
    if (name.empty()) continue;
    const auto is_letter = [&](std::size_t i) {
      return i < message.size() &&
             (std::isalnum(static_cast<unsigned char>(message[i])) != 0 || message[i] == '_');
    };
    const std::size_t found = message.find(name), end = found + name.size();
    if (found >= first || is_letter(end) || message.substr(end).starts_with('-') ||
        (found > 0 && is_letter(found - 1)))
      continue;
    first = found;
    place = at;
  }
  return place;
}

CampaignPlan load_plan(const fs::path& file) {
  const std::string text = read_file(file, "the plan of a campaign (JSON or TOML)");
  const PresetDocument document = lower_case(file.extension().string()) == ".toml"
                                      ? toml_document(text, file.string())
                                      : PresetDocument(text, file.string());
  const PresetReader plan = document.root();
  plan.expect_only({"skyfit_campaign", "inputs", "kind", "irradiances", "group", "options",
                    "tasks_per_file", "note"});
  if (plan.number("skyfit_campaign") != kPlanVersion)
    plan.fail_value("skyfit_campaign", fmt::format("{}", kPlanVersion));
  CampaignPlan result;
  result.folder = file.parent_path();
  result.inputs = plan.texts("inputs");
  if (result.inputs.empty()) plan.fail_value("inputs", "at least one file or pattern");
  if (plan.has("group")) result.group = named(plan, "group", kGroupings);
  if (plan.has("kind")) result.kind = named(plan, "kind", kInputKinds);
  result.inputs_place = document.place("inputs");
  if (plan.has("irradiances")) {
    result.irradiances = plan.text("irradiances");
    result.irradiances_place = document.place("irradiances");
    if (result.irradiances.empty()) plan.fail_value("irradiances", "a table of irradiances");
    if (result.kind == InputKind::kIrradiances)
      plan.fail_value("irradiances", "none beside inputs of the kind irradiances");
  }
  result.option_places[""] = document.place("options");
  if (plan.has("options")) {
    const PresetReader options = plan.object("options");
    result.options = arguments_of(options);
    for (const auto& [name, value] : options.value().items())
      result.option_places[name] = document.place("options." + name);
  }
  if (plan.has("tasks_per_file"))
    result.tasks_per_file = whole_number(plan, "tasks_per_file", 1, kMostTasksPerFile);
  return result;
}

std::vector<std::string> input_files(const CampaignPlan& plan, NamedFiles named) {
  std::set<fs::path> known;  // a file has several names
  std::set<std::string> names;
  for (const std::string& input : plan.inputs) {
    for (std::string& name : matches(plan, input, named)) {
      if (known.insert(fs::weakly_canonical(plan.folder / name / "")).second)
        names.insert(std::move(name));
    }
  }
  return {names.begin(), names.end()};
}

std::vector<Task> tasks_of(const CampaignPlan& plan, NamedFiles named, const ReadSky& read,
                           int threads) {
  if (!plan.irradiances.empty() && !named_file(plan.folder, plan.irradiances, named))
    throw std::invalid_argument(fmt::format("{}: irradiances: {}: expected {}",
                                            plan.irradiances_place, printable(plan.irradiances),
                                            kNamedFile));
  const std::vector<std::string> names = input_files(plan, named);
  std::vector<Contents> contents(names.size());
  tbb::task_arena arena(threads);
  if (plan.group != Grouping::kFile) {
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, names.size(), [&](std::size_t i) {
        try {
          contents[i].scans = scans_of(read(plan.folder / names[i]));
        } catch (const std::exception& error) {
          contents[i].problem = error.what();
        }
      });
    });
  }
  std::vector<Task> tasks = grouped(plan, names, contents);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, tasks.size(),
                      [&](std::size_t i) { tasks[i].key = key_of(plan, tasks[i], named); });
  });
  return tasks;
}

refs::Reference task_reference(const Task& task, const ReadSky& read) {
  if (!task.problem.empty()) throw std::invalid_argument(task.problem);
  std::vector<refs::Reference> references;
  for (const Task::Part& part : task.parts)
    references.push_back(only_scans(read(part.file), part.scans));
  return refs::joint_reference(references);
}

}  // namespace skyfit::fit
