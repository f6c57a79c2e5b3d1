// SPDX-License-Identifier: Apache-2.0
// `skyfit references`: lists the shipped references or prints the samples of one as CSV that `fit`
// reads back.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "data_refs/references.h"
#include "data_refs/truth.h"

namespace skyfit::cli {
namespace {

struct ReferencesOptions {
  std::string name, sampling = "principal", sun_zenith = "0:80:10";
  bool json = false;
};

void print_list(bool json) {
  auto list = nlohmann::json::array();
  const auto add = [&](std::string_view name, std::string_view description) {
    if (json) {
      list.push_back({{"name", name}, {"description", description}});
    } else {
      print(fmt::format("{:<34}{}\n", name, description));
    }
  };
  for (const refs::ReferenceEntry& entry : refs::shipped_references())
    add(entry.name, entry.description);
  add("perez:EPSILON,DELTA",
      "Perez, Seals & Michalsky 1993, all-weather sky: clearness, brightness");
  for (const refs::TruthEntry& entry : refs::truth_references()) add(entry.name, entry.description);
  if (json) print(list.dump(2) + "\n");
}

void print_samples(const refs::Reference& reference) {
  const bool sigma =
      std::ranges::all_of(reference.samples, [](const auto& s) { return s.sigma.has_value(); });
  print(fmt::format(
      "# {}: {}\nsun_zenith_deg,view_zenith_deg,relative_azimuth_deg,{}{},weight,scan\n",
      reference.name, reference.description,
      reference.quantity == refs::Quantity::kLuminance ? "luminance_cd_m2" : "relative_luminance",
      sigma ? ",sigma" : ""));
  for (const refs::Sample& sample : reference.samples) {
    print(fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}{},{:.9g},{}\n", degrees(sample.sun_zenith),
                      degrees(sample.view_zenith), degrees(sample.relative_azimuth), sample.value,
                      sigma ? fmt::format(",{:.9g}", *sample.sigma) : "", sample.weight,
                      sample.scan));
  }
}

void run_references(const ReferencesOptions& options, const CLI::App& command) {
  if (options.name.empty()) return print_list(options.json);
  const refs::Reference reference = refs::load_reference(
      options.name, parse_sun_zeniths(options.sun_zenith), parse_sampling(options.sampling));
  warn_of_unused_sampling(command, options.name);
  print_samples(reference);
}

}  // namespace

void add_references_command(CLI::App& app) {
  const auto options = std::make_shared<ReferencesOptions>();
  CLI::App* const command = app.add_subcommand(
      "references", "Lists the shipped references, or prints the samples of one as CSV.");
  command->add_option("name", options->name, "A shipped reference or a CSV of samples")
      ->type_name("NAME");
  add_sampling_options(*command, options->sampling, options->sun_zenith);
  command->add_flag("--json", options->json, "Print the list as JSON");
  command->footer(
      "Example: skyfit references cie:12 --sampling tregenza --sun-zenith-deg 30,60 > sky.csv");
  command->callback([options, command] { run_references(*options, *command); });
}

}  // namespace skyfit::cli
