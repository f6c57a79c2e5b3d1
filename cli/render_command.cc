// SPDX-License-Identifier: Apache-2.0
// `skyfit render`: a frame of the planet under a preset's atmosphere.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "data_refs/spectra.h"
#include "model/sky_model.h"
#include "model/tables.h"
#include "render/plot/whole_files.h"
#include "render/render.h"

namespace skyfit::cli {
namespace {

constexpr double kTablesShare = 0.8;  // of the time that a frame takes
constexpr double kMaxStops = 50;      // 2^50: from the darkest night to the sun's disc and beyond

struct RenderOptions {
  std::string preset, model = "reference", view = "ground", size = "1280x720", sun_zenith;
  std::string altitude, view_zenith, azimuth, field_of_view, exposure = "0";
  std::vector<std::string> out;
  int samples_per_side = FrameOptions{}.samples_per_side, threads = default_threads();
};

double parse_angle(std::string_view option, const std::string& text, double lower, double upper) {
  const auto values = parse_list_within(option, text, lower, upper, "an angle in degrees");
  if (values.size() != 1) throw UsageError(option, text, "expected one angle in degrees");
  return radians(values.front());
}

FrameOptions frame_options(const RenderOptions& options, const CLI::App& command) {
  const auto given = [&](const char* option) { return command.count(option) > 0; };
  const NamedView& view = find_view(options.view);
  const ImageSize size = parse_image_size("--size", options.size);
  FrameOptions frame;
  frame.width = size.width;
  frame.height = size.height;
  frame.camera = view.camera;
  frame.sun_zenith = view.sun_zenith;
  frame.samples_per_side = options.samples_per_side;
  if (given("--sun-zenith-deg"))
    frame.sun_zenith = parse_angle("--sun-zenith-deg", options.sun_zenith, 0, 180);
  if (given("--altitude-m"))
    frame.camera.altitude_m = parse_number("--altitude-m", options.altitude);
  if (given("--view-zenith-deg")) {
    frame.camera.view_zenith = parse_angle("--view-zenith-deg", options.view_zenith, 0, 180);
  }
  if (given("--azimuth-deg"))
    frame.camera.azimuth = parse_angle("--azimuth-deg", options.azimuth, -360, 360);
  if (given("--field-of-view-deg")) {
    frame.camera.vertical_fov = parse_angle("--field-of-view-deg", options.field_of_view, 1, 150);
  }
  validate(frame);
  return frame;
}

ToneOptions tone_options(const std::string& stops) {
  ToneOptions tone;
  tone.exposure_stops = parse_number("--exposure-stops", stops);
  if (std::abs(tone.exposure_stops) <= kMaxStops) return tone;
  throw UsageError("--exposure-stops", stops,
                   fmt::format("expected stops from {} to {}", -kMaxStops, kMaxStops));
}

Frame draw(const Preset& preset, const SkyModel& model, const FrameOptions& frame, int threads) {
  Progress progress("rendering");
  const AtmosphereTables tables = compute_tables_of(
      model, preset.atmosphere, color_rule(refs::standard_spectral_data()), TableSizes{}, threads,
      [&](double done) { progress.show(kTablesShare * done, "tables of the atmosphere"); });
  return render_frame(preset, tables, frame, [&](double done) {
    progress.show(kTablesShare + (1 - kTablesShare) * done, "frame");
  });
}

void run_render(const RenderOptions& options, const CLI::App& command) {
  const FrameOptions frame_size = frame_options(options, command);
  const ToneOptions tone = tone_options(options.exposure);
  require_output_files(options.out, {".png", ".exr"});
  const Frame frame =
      draw(preset_named(options.preset),
           *make_sky_model(options.model, refs::standard_spectral_data(), options.threads),
           frame_size, options.threads);
  plot::WholeFiles files(
      std::vector<std::filesystem::path>(options.out.begin(), options.out.end()));
  for (std::size_t i = 0; i < options.out.size(); ++i) {
    if (files.temporary(i).extension() == ".exr") {
      write_exr(frame, files.temporary(i));
    } else {
      write_png(frame, files.temporary(i), tone);
    }
  }
  files.commit();
}

void add_camera_options(CLI::App& command, RenderOptions& options) {
  command
      .add_option("--sun-zenith-deg", options.sun_zenith,
                  "Sun zenith angle, 0 to 180; by default one that suits the view")
      ->type_name("ANGLE");
  command
      .add_option("--altitude-m", options.altitude, "Height of the camera, instead of the view's")
      ->type_name("LENGTH");
  command
      .add_option("--view-zenith-deg", options.view_zenith,
                  "Zenith angle of the picture's centre, instead of the view's")
      ->type_name("ANGLE");
  command
      .add_option("--azimuth-deg", options.azimuth,
                  "Azimuth of the picture's centre, 0 = toward the sun")
      ->type_name("ANGLE");
  command.add_option("--field-of-view-deg", options.field_of_view, "Vertical field of view")
      ->type_name("ANGLE");
}

std::string view_list() {
  std::string text = "Views:\n";
  for (const NamedView& view : named_views()) {
    text += fmt::format("  {:<10}{} (sun zenith {:.4g} deg)\n", view.name, view.meaning,
                        degrees(view.sun_zenith));
  }
  return text;
}

}  // namespace

void add_render_command(CLI::App& app) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* const command =
      app.add_subcommand("render", "Renders a planet under a preset's atmosphere.");
  command->add_option("--preset", options->preset, "Shipped preset or preset file")
      ->required()
      ->type_name("FILE|NAME");
  command
      ->add_option("--model", options->model,
                   "Sky model: reference, bruneton, bodare, schafhitzel or oneil")
      ->type_name("NAME")
      ->capture_default_str();
  command->add_option("--view", options->view, "Where the camera stands")
      ->type_name("NAME")
      ->capture_default_str();
  add_camera_options(*command, *options);
  command->add_option("--size", options->size, "Size in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  command
      ->add_option("--samples-per-side", options->samples_per_side,
                   "A pixel is the mean of the square of this, 1 to 4")
      ->capture_default_str();
  command->add_option("--exposure-stops", options->exposure, "Brightens the PNG by powers of two")
      ->type_name("STOPS")
      ->capture_default_str();
  command->add_option("--out", options->out, "frame.png or frame.exr; may be repeated")
      ->required()
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_threads_option(*command, options->threads);
  command->footer(
      "OpenEXR holds linear cd/m^2, luminance, directions and depth; PNG "
      "is tone-mapped. Neither a\n"
      "display nor a GPU is needed.\n"
      "\n" +
      view_list() +
      "\nExample: skyfit render --preset earth-clear --view ground --sun-zenith-deg 60 "
      "--size 1280x720\n"
      "           --out frame.png --out frame.exr");
  command->callback([options, command] { run_render(*options, *command); });
}

}  // namespace skyfit::cli
