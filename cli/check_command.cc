// SPDX-License-Identifier: Apache-2.0
// `skyfit check`: reads a preset or a file of samples the way the other commands do and says what
// it holds.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/output.h"
#include "data_refs/references.h"
#include "data_refs/table_csv.h"
#include "model/preset.h"

namespace skyfit::cli {
namespace {

// A preset is a JSON object; samples are CSV.
bool looks_like_json(const std::filesystem::path& file) {
  if (file.extension() == ".json") return true;
  std::ifstream in(file);
  char first = 0;
  return in >> first && first == '{';
}

nlohmann::json summary_of_preset(const std::string& file) {
  const Preset preset = load_preset(file, refs::load_table_csv);
  return {
      {"file", file}, {"kind", "preset"}, {"name", preset.name}, {"fitted", !preset.fit.is_null()}};
}

nlohmann::json summary_of_samples(const std::string& file) {
  const refs::Reference reference = refs::load_reference(file, {}, refs::Sampling::kPrincipalPlane);
  std::set<int> scans;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::ptrdiff_t weighted = 0;
  for (const refs::Sample& sample : reference.samples) {
    scans.insert(sample.scan);
    low = std::min(low, degrees(sample.sun_zenith));
    high = std::max(high, degrees(sample.sun_zenith));
    if (sample.weight > 0) ++weighted;
  }
  return {{"file", file},
          {"kind", "samples"},
          {"quantity",
           reference.quantity == refs::Quantity::kLuminance ? "luminance" : "relative luminance"},
          {"samples", reference.samples.size()},
          {"samples_with_weight", weighted},
          {"scans", scans.size()},
          {"sun_zenith_deg", {low, high}}};
}

std::string line_of(const nlohmann::json& summary) {
  const std::string file = summary["file"];
  if (summary["kind"] == "preset") {
    return fmt::format("{}: valid preset \"{}\"{}\n", file, summary["name"].get<std::string>(),
                       summary["fitted"].get<bool>() ? ", the result of a fit" : "");
  }
  return fmt::format(
      "{}: valid samples of {}: {} ({} with weight) in {} scans, sun zenith {:.9g} to {:.9g} deg\n",
      file, summary["quantity"].get<std::string>(), summary["samples"].get<std::size_t>(),
      summary["samples_with_weight"].get<std::size_t>(), summary["scans"].get<std::size_t>(),
      summary["sun_zenith_deg"][0].get<double>(), summary["sun_zenith_deg"][1].get<double>());
}

void run_check(const std::string& file, bool json) {
  if (!std::filesystem::is_regular_file(file)) {
    throw std::runtime_error(
        fmt::format("{}: expected a preset (.json) or samples (.csv), {}", file,
                    std::filesystem::exists(file) ? "this is no file" : "there is no such file"));
  }
  const nlohmann::json summary =
      looks_like_json(file) ? summary_of_preset(file) : summary_of_samples(file);
  print(json ? summary.dump(2) + "\n" : line_of(summary));
}

}  // namespace

void add_check_command(CLI::App& app) {
  struct Options {
    std::string file;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* const command = app.add_subcommand(
      "check", "Says whether a preset or a file of samples is valid, and what it holds.");
  command->add_option("file", options->file, "preset.json or samples as CSV")
      ->required()
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print the summary as JSON");
  command->footer("Example: skyfit check fitted/preset.json");
  command->callback([options] { run_check(options->file, options->json); });
}

}  // namespace skyfit::cli
