// SPDX-License-Identifier: Apache-2.0
// `skyfit render`: pictures, strips, grids and sequences of a planet under a preset's atmosphere.
#include <fmt/format.h>

#include <memory>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/render_modes.h"
#include "cli/render_options.h"
#include "cli/render_request.h"
#include "render/scene/placement.h"

namespace skyfit::cli {
namespace {

std::string view_list() {
  constexpr double kMetresPerKm = 1000;
  std::string text = "Views:\n";
  for (const NamedView& view : named_views()) {
    text += fmt::format("  {:<10}{} (sun zenith {:.4g} deg)\n", view.name, view.meaning,
                        degrees(view.sun_zenith));
  }
  return text +
         fmt::format(
             "Heights of orbit, limb and space are those of planets with a radius of {:.9g} to "
             "{:.9g} km;\non a smaller or larger planet they are in proportion to its radius.\n",
             kSmallestLikeEarth_m / kMetresPerKm, kLargestLikeEarth_m / kMetresPerKm);
}

void run_render(const RenderOptions& options, const CLI::App& command) {
  if (!options.strip.empty() || !options.rows.empty()) {
    render_grid(grid_request(options, command));
    return;
  }
  const RenderRequest request = render_request(options, command);
  if (request.is_sequence) {
    render_sequence(request);
  } else {
    render_picture(request);
  }
}

}  // namespace

void add_render_command(CLI::App& app) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* const command =
      app.add_subcommand("render", "Renders a planet under a preset's atmosphere.");
  add_render_options(*command, *options);
  command->footer(
      "OpenEXR holds linear cd/m^2, luminance, directions and depth; PNG is tone-mapped. Neither "
      "a\n"
      "display nor a GPU is needed.\n"
      "\n" +
      view_list() +
      "\nExamples:\n"
      "  skyfit render --preset earth-clear --sun-zenith-deg 60 --size 1280x720\n"
      "         --out frame.png --out frame.exr\n"
      "  skyfit render --preset earth-clear --latitude-deg 47 --longitude-deg 8 --heading-deg 60\n"
      "         --date 2026-06-21 --time 03:00..20:00 --out-dir day\n"
      "  skyfit render --preset earth-clear --strip mie.scattering=1e-6..8e-5:4 --size 320x240\n"
      "         --out strip.png\n"
      "  skyfit render --preset earth-clear --strip mie.scattering=2e-6,4e-6,8e-6\n"
      "         --rows altitude-m=1000,3000,5000 --size 320x180 --out grid.png --out grid.exr");
  command->callback([options, command] { run_render(*options, *command); });
}

}  // namespace skyfit::cli
