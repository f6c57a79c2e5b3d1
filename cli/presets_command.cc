// SPDX-License-Identifier: Apache-2.0
// `skyfit presets`: lists the shipped presets, prints one or the schema, or upgrades a file.
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "data_refs/references.h"

namespace skyfit::cli {

void add_presets_command(CLI::App& app) {
  struct Options {
    std::string name, upgrade;
    bool json = false, schema = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* const command =
      app.add_subcommand("presets", "Lists the shipped presets, or prints one as JSON.");
  auto* const preset =
      command->add_option("name", options->name, "The preset to print")->type_name("NAME");
  command->add_flag("--json", options->json, "Print the list as JSON");
  command->add_flag("--schema", options->schema, "Print the JSON Schema of presets of version 2")
      ->excludes(preset);
  command
      ->add_option("--upgrade", options->upgrade,
                   "Print the preset of any version as one of version 2")
      ->type_name("FILE");
  command->footer(
      "Examples:\n  skyfit presets earth-clear > my-sky.json\n  skyfit presets --upgrade old.json "
      "> "
      "new.json");
  command->callback([options] {
    const std::vector<std::string> names = refs::shipped_preset_names();
    if (options->schema) {
      print(refs::preset_schema_json());
    } else if (!options->upgrade.empty()) {
      print(preset_to_json(preset_named(options->upgrade)));
    } else if (!options->name.empty()) {
      print(refs::shipped_preset_json(options->name));
    } else if (options->json) {
      print(json_text(nlohmann::json(names)));
    } else {
      for (const std::string& name : names) print(name + "\n");
    }
  });
}

}  // namespace skyfit::cli
