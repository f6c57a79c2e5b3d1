// SPDX-License-Identifier: Apache-2.0
// `skyfit view`: a preset's sky as one page for a browser.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/sky_page_file.h"
#include "model/base/whole_file.h"

namespace skyfit::cli {
namespace {

struct ViewArguments {
  std::string preset, with, parameters, out;
  int threads = default_threads();
};

std::vector<PageSlider> sliders_of(const ViewArguments& arguments, const Preset& preset) {
  if (!arguments.parameters.empty()) {
    const auto parameters = parse_parameters("--parameters", arguments.parameters);
    for (auto at = parameters.begin(); at != parameters.end(); ++at) {
      require_parameter(preset.atmosphere, *at);
      if (std::find(parameters.begin(), at, *at) != at)
        throw UsageError("--parameters", arguments.parameters, "expected each parameter once");
    }
    return page_sliders(preset.atmosphere, parameters);
  }
  if (arguments.with.empty()) return usual_sliders(preset, arguments.preset);
  const std::string file = (std::filesystem::path(arguments.with) / "preset.json").string();
  if (!std::filesystem::exists(file))
    throw UsageError("--with", arguments.with,
                     "expected a directory that skyfit fit left, which has a preset.json");
  return fitted_sliders(preset, preset_named(file), file);
}

void run_view(const ViewArguments& arguments) {
  require_output_files({arguments.out}, {".html"});
  const Preset preset = preset_named(arguments.preset);
  const auto sliders = sliders_of(arguments, preset);
  const SkyPage page = make_sky_page(preset, sliders, arguments.threads);
  write_whole_file(arguments.out, page.html);
  print(fmt::format("{}: {:.2f} MB, {} sliders\n", arguments.out,
                    1e-6 * static_cast<double>(page.html.size()), sliders.size()));
  print("largest error of the luminance (suns to 88 deg, views to 89 deg from the zenith):\n");
  for (std::size_t i = 0; i < kComparedAltitudes_m.size(); ++i)
    print(fmt::format(
        "  from {:.0f} m: {:.2g} %, with the sun at {:.0f} deg, view {:.0f} deg, azimuth "
        "{:.0f} deg\n",
        kComparedAltitudes_m[i], 100 * page.errors.preset[i].error,
        degrees(page.errors.preset[i].at.sun_zenith), degrees(page.errors.preset[i].at.view_zenith),
        degrees(page.errors.preset[i].at.relative_azimuth)));
  for (std::size_t i = 0; i < sliders.size(); ++i) {
    const ParameterInfo info = parameter_info(sliders[i].parameter);
    print(
        fmt::format("  with {} = {:.4g} to {:.4g}{}: {:.2g} % at tabulated values, {:.2g} % "
                    "half-way between\n",
                    info.name, sliders[i].low, sliders[i].high,
                    info.unit == "1" ? "" : fmt::format(" {}", info.unit),
                    100 * page.errors.tabulated[i], 100 * page.errors.half_way[i]));
  }
}

}  // namespace

void add_view_command(CLI::App& app) {
  const auto arguments = std::make_shared<ViewArguments>();
  CLI::App& command =
      *app.add_subcommand("view", "Writes a preset's sky as one page for a browser.");
  command.add_option("preset", arguments->preset, "Shipped preset or preset file")
      ->required()
      ->type_name("PRESET");
  command.add_option("--out", arguments->out, "The page")->required()->type_name("FILE.html");
  auto* const with =
      command
          .add_option("--with", arguments->with,
                      "Directory of a fit, whose fitted parameters the sliders are; by\n"
                      "default those of the preset's own fit, if it has one")
          ->type_name("FIT_DIR");
  command
      .add_option("--parameters", arguments->parameters,
                  "The parameters that are sliders, NAME,NAME; skyfit parameters\n"
                  "lists them")
      ->type_name("LIST")
      ->excludes(with);
  add_threads_option(command, arguments->threads);
  command.footer(
      "The page needs WebGL 2 and no network: drag the sun or the view, move the sliders, point "
      "at\n"
      "the sky to measure it. Its light comes from look-up tables of the model reference. How far\n"
      "it is from `skyfit sky` is measured as it is made, printed here and stated in the page.\n"
      "Sliders are approximate: they blend tables of the preset's value and of two others.\n"
      "\n"
      "Examples:\n"
      "  skyfit view earth-clear --out sky.html\n"
      "  skyfit view fitted/preset.json --out sky.html\n"
      "  skyfit view earth-hazy --parameters aerosol.optical_depth,aerosol.scale_height --out "
      "haze.html");
  command.callback([arguments] { of_preset(arguments->preset, [&] { run_view(*arguments); }); });
}

}  // namespace skyfit::cli
