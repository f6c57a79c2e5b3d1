// SPDX-License-Identifier: Apache-2.0
// `skyfit references`: lists the shipped references or prints the samples of one, or of a measured
// sky in any format, as CSV that `fit` reads back.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "data_refs/references.h"
#include "data_refs/sample_csv.h"
#include "data_refs/truth.h"

namespace skyfit::cli {
namespace {

struct ReferencesOptions {
  std::string name, sampling = "principal", sun_zenith = "0:80:10";
  ImportArguments import;
  bool json = false;
};

void print_list(bool json) {
  std::vector<refs::ReferenceEntry> entries = refs::shipped_references();
  entries.push_back({"perez:EPSILON,DELTA",
                     "Perez, Seals & Michalsky 1993, all-weather sky: clearness, brightness"});
  entries.push_back(
      {"perez:FILE@TIME",
       "The same of an hour of a weather file: EPW, WEA, TMY2, TMY3, NSRDB or PVGIS"});
  for (const refs::TruthEntry& entry : refs::truth_references())
    entries.push_back({std::string(entry.name), std::string(entry.description)});
  if (json) {
    auto list = nlohmann::json::array();
    for (const refs::ReferenceEntry& entry : entries)
      list.push_back({{"name", entry.name}, {"description", entry.description}});
    return print(json_text(list));
  }
  std::size_t longest = 0;
  for (const refs::ReferenceEntry& entry : entries) longest = std::max(longest, entry.name.size());
  for (const refs::ReferenceEntry& entry : entries)
    print(fmt::format("{:<{}}{}\n", entry.name, longest + 2, entry.description));
}

void run_references(const ReferencesOptions& options, const CLI::App& command) {
  if (options.name.empty()) return print_list(options.json);
  if (options.json)
    throw UsageError("--json", "true", "expected without a name, whose samples are CSV");
  const refs::Reference reference =
      refs::load_reference(options.name, parse_sun_zeniths(options.sun_zenith),
                           parse_sampling(options.sampling), parse_import_options(options.import));
  warn_of_unused_options(command, options.name);
  print(refs::sample_csv_text(reference));
}

}  // namespace

void add_references_command(CLI::App& app) {
  const auto options = std::make_shared<ReferencesOptions>();
  CLI::App* const command = app.add_subcommand(
      "references", "Lists the shipped references, or prints the samples of one as CSV.");
  command->add_option("name", options->name, "A shipped reference or a measured sky")
      ->type_name("NAME");
  add_sampling_options(*command, options->sampling, options->sun_zenith);
  add_import_options(*command, options->import);
  command->add_flag("--json", options->json, "Print the list as JSON");
  command->footer(
      "Examples:\n"
      "  skyfit references cie:12 --sampling tregenza --sun-zenith-deg 30,60 > sky.csv\n"
      "  skyfit references scan.csv --exclude-sample 0 > sky.csv");
  command->callback([options, command] { run_references(*options, *command); });
}

}  // namespace skyfit::cli
