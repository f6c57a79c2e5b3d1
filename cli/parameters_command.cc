// SPDX-License-Identifier: Apache-2.0
// `skyfit parameters PRESET`: the parameters of an atmosphere, as --free, --fix, --prior,
// --per-scan and --strip name them.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "model/atmosphere/parameters.h"

namespace skyfit::cli {
namespace {

using nlohmann::json;

json json_of(const Atmosphere<double>& atmosphere) {
  json list = json::array();
  for (const Parameter& parameter : parameters_of(atmosphere)) {
    const ParameterInfo info = parameter_info(parameter, atmosphere);
    json row = {{"name", info.name},      {"value", get_parameter(atmosphere, parameter)},
                {"unit", info.unit},      {"lower", info.lower},
                {"upper", info.upper},    {"free_by_default", info.free_by_default},
                {"meaning", info.meaning}};
    if (info.prior) row["prior"] = {{"mean", info.prior->mean}, {"sigma", info.prior->sigma}};
    list.push_back(row);
  }
  return list;
}

std::string text_of(const Atmosphere<double>& atmosphere) {
  std::string text = fmt::format("{:<34}{:>12} {:<4} {:<24} {:<20} {}\n", "parameter", "value",
                                 "unit", "bounds of a fit", "prior", "free by default; meaning");
  for (const Parameter& parameter : parameters_of(atmosphere)) {
    const ParameterInfo info = parameter_info(parameter, atmosphere);
    text += fmt::format(
        "{:<34}{:>12.6g} {:<4} {:<24} {:<20} {}; {}\n", info.name,
        get_parameter(atmosphere, parameter), info.unit,
        fmt::format("{:.4g} to {:.4g}", info.lower, info.upper),
        info.prior ? fmt::format("{:.4g} +- {:.2g}", info.prior->mean, info.prior->sigma) : "-",
        info.free_by_default ? "yes" : "no", info.meaning);
  }
  return text;
}

}  // namespace

void add_parameters_command(CLI::App& app) {
  struct Options {
    std::string preset;
    bool json = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* const command = app.add_subcommand(
      "parameters", "Lists the parameters of an atmosphere, with bounds, priors and meaning.");
  command->add_option("preset", options->preset, "A shipped preset or a file")
      ->required()
      ->type_name("PRESET");
  command->add_flag("--json", options->json, "Print the list as JSON");
  command->footer("Example: skyfit parameters earth-clear");
  command->callback([options] {
    const Preset preset = preset_named(options->preset);
    print(options->json ? json_of(preset.atmosphere).dump(2) + "\n" : text_of(preset.atmosphere));
  });
}

}  // namespace skyfit::cli
