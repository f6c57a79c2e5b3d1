// SPDX-License-Identifier: Apache-2.0
#include "cli/render_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <utility>

#include "cli/arguments.h"
#include "cli/feature_options.h"
#include "cli/grid_request.h"
#include "cli/table_options.h"
#include "model/registry.h"

namespace skyfit::cli {
namespace {

constexpr int kMostOrders = 20;

// Options of one group of the help.
class Group {
 public:
  Group(CLI::App& command, std::string name) : command_(command), name_(std::move(name)) {}

  template <class T>
  CLI::Option* option(const std::string& name, T& value, const std::string& type,
                      const std::string& meaning) {
    return command_.add_option(name, value, meaning)->type_name(type)->group(name_);
  }
  CLI::Option* flag(const std::string& name, bool& value, const std::string& meaning) {
    return command_.add_flag(name, value, meaning)->group(name_);
  }

 private:
  CLI::App& command_;
  std::string name_;
};

void add_camera_options(CLI::App& command, RenderOptions& options) {
  Group group(command, "Camera");
  group.option("--view", options.view, "NAME", "A named view; the options below change it")
      ->capture_default_str();
  group.option("--latitude-deg", options.latitude, "ANGLE", "Place of the camera, north > 0");
  group.option("--longitude-deg", options.longitude, "ANGLE", "Place of the camera, east > 0");
  group.option("--altitude-m", options.altitude, "LENGTH",
               "Height of the camera above sea level, the bottom of the atmosphere");
  group.option("--above-ground-m", options.above_ground, "LENGTH",
               "Height of the camera above the ground");
  group.option("--heading-deg", options.heading, "ANGLE",
               "Direction of the picture's centre, from north over east; needs a place");
  group.option("--azimuth-deg", options.azimuth, "ANGLE",
               "Direction of the picture's centre, 0 = toward the sun");
  group.option("--pitch-deg", options.pitch, "ANGLE",
               "Angle of the picture's centre above the horizon");
  group.option("--view-zenith-deg", options.view_zenith, "ANGLE",
               "Zenith angle of the picture's centre, 90 = the horizon");
  group.option("--look-at", options.look_at, "LAT,LON,ALT",
               "Point (degrees, metres above sea level) in the picture's centre; needs a place");
  group.option("--field-of-view-deg", options.field_of_view, "ANGLE",
               "Angle from bottom to top, 1 to 150; of --projection fisheye (180) and angular "
               "(360) across\nthe disc, 1 to 360");
}

void add_sun_options(CLI::App& command, RenderOptions& options) {
  Group group(command, "Sun");
  group.option("--sun-zenith-deg", options.sun_zenith, "ANGLE",
               "Zenith angle of the sun, 0 to 180; by default one that suits the view");
  group.option("--sun-azimuth-deg", options.sun_azimuth, "ANGLE",
               "Azimuth of the sun, from north over east; needs a place");
  group.option("--date", options.date, "YYYY-MM-DD", "Date that gives the sun over the place");
  group.option("--time", options.time, "HH:MM[..HH:MM]",
               "Time of that day, or two times for a sequence of frames");
  group
      .option("--utc-offset-h", options.utc_offset, "HOURS", "Hours that the clock is ahead of UTC")
      ->capture_default_str();
}

void add_scene_options(CLI::App& command, RenderOptions& options) {
  Group group(command, "Scene");
  group.option("--height-map", options.height_map, "FILE",
               "Picture of the planet's heights, 2:1 from pole to pole or six cube faces 6:1");
  group
      .option("--height-range-m", options.height_range, "LOW..HIGH",
              "Heights of the map's darkest and brightest value")
      ->capture_default_str();
  group.option("--color-map", options.color_map, "FILE",
               "Colours of the ground, with the layout of a height map");
  group
      .option("--water-level-m", options.water_level, "LENGTH",
              "Height of the sea and of the lowest ground, m; negative: in basins below the\n"
              "bottom radius, into which the air is continued")
      ->capture_default_str();
  group
      .option("--dem", options.dems, "FILE[@BAND]",
              "Digital elevation model of a region: a GeoTIFF, or an .hgt of SRTM, m above the "
              "sea's level; it lies where its georeference says; may be repeated")
      ->allow_extra_args(false);
  group
      .option("--dem-surroundings", options.dem_surroundings, "planet|sea",
              "What lies around the regions and where they have no data: the planet's ground, or "
              "the sea at its level")
      ->capture_default_str();
  group.option("--dem-edge-m", options.dem_edge, "LENGTH",
               "How far beyond its edge a region goes over into its surroundings, m; by default a "
               "tenth of its shorter side");
  group.option("--textures", options.textures, "DIR",
               "Textures of the ground's materials; missing ones are made and kept there, and "
               "materials.json names pictures of your own");
  group
      .option("--mesh", options.meshes, "FILE@LAT,LON,ALT[,HEADING[,SCALE]]",
              "A Wavefront OBJ at a place (degrees, metres above sea level); may be repeated")
      ->allow_extra_args(false);
  group
      .option("--atmosphere", options.atmosphere, "on|off",
              "off: the planet without its air, in the sun's light alone")
      ->capture_default_str();
}

void add_picture_options(CLI::App& command, RenderOptions& options) {
  Group group(command, "Picture");
  group.option("--size", options.size, "WxH", "Size in pixels")->capture_default_str();
  group
      .option("--samples-per-side", options.samples_per_side, "INT",
              "Samples of a pixel along each side, 1 to 4")
      ->capture_default_str();
  group.flag("--gpu", options.gpu,
             "Draw through EGL, on a GPU where there is one; stderr names the device");
  group.option("--exposure", options.exposure, "K",
               "K times the luminance goes through the tone curve, m^2/cd; by default automatic");
  group
      .option("--exposure-ev,--exposure-stops", options.exposure_ev, "EV",
              "Brightens the PNG by powers of two, on top of the exposure")
      ->capture_default_str();
  group
      .option("--tone", options.tone, "filmic|exponential|clip",
              "Tone curve of the PNG: a fit of the ACES curve, 1 - exp(-K L), or none: K L cut off "
              "at 1")
      ->capture_default_str();
  group
      .option("--view-transform", options.view_transform, "hue|channels",
              "Colours of the PNG: the tone curve goes over the luminance and the hue stays, or it "
              "goes over each channel, which is clipped by itself")
      ->capture_default_str();
  group
      .option("--primaries", options.primaries, "rec709|rec2020|xyz",
              "Primaries of the EXR's colours, all with the white D65; light outside their gamut "
              "becomes less saturated at the same luminance and hue")
      ->capture_default_str();
  group
      .option(
          "--adaptation-s", options.adaptation, "SECONDS",
          "Time in which the automatic exposure of a sequence follows the light, in the scene's "
          "time; minutes of it may pass between two frames of a day")
      ->capture_default_str();
}

void add_table_options(CLI::App& command, RenderOptions& options) {
  Group group(command, "Tables");
  group
      .option("--table-size", options.table_size, names_of(table_sizes()),
              "Texels of the tables of the atmosphere")
      ->capture_default_str();
  group
      .option("--table-precision", options.table_precision, names_of(table_precisions()),
              "Of the tables of scattered light; skyfit tables --measure prints what sizes and "
              "precisions cost")
      ->capture_default_str();
}

void add_sequence_options(CLI::App& command, RenderOptions& options) {
  Group group(command, "Sequences, strips and grids");
  group.option("--sequence", options.sequence, "FILE",
               "Keyframes of camera, sun and preset as JSON");
  group.option("--step-min", options.step_min, "MINUTES",
               "Minutes between frames of --time; by default the sequence lasts 10 s");
  group.option("--frames", options.frames, "N", "Number of frames of --time");
  group
      .option("--frames-per-second", options.frames_per_second, "N",
              "Frames per second of the video of --time")
      ->capture_default_str();
  group.option("--out-dir", options.out_dir, "DIR",
               "Directory of frame_00000.png .. and, with ffmpeg, sequence.mp4; frames that are "
               "there already are kept");
  group.option("--format", options.format, "png|exr|png,exr", "Format of the frames in --out-dir")
      ->capture_default_str();
  group.option(
      "--update-frames", options.update_frames, "2|4|8|16|32",
      "Of --model bodare: renew its tables over frames, as its authors do, where the "
      "atmosphere changes: N frames for each order of scattering but the last, which takes "
      "half, and one to gather between them; the picture lags behind by one to three "
      "updates. --stats lists what each frame does for it");
  const std::string steps = "NAME=LOW..HIGH[:N][:geometric]|NAME=VALUE,..";
  group
      .option("--strip", options.strip, steps,
              "Frames side by side in which a parameter of the preset, or an option, varies: N (5) "
              "even or geometric steps, or the values of a list. May be repeated: all move "
              "together, with as many steps each. Options: " +
                  axis_options())
      ->allow_extra_args(false);
  group
      .option("--rows", options.rows, steps,
              "Rows of frames, one below the other, in which another parameter or option varies; "
              "as --strip, with which it makes a grid")
      ->allow_extra_args(false);
  group
      .option("--metering", options.metering, "together|each",
              "The automatic exposure of a strip or a grid: one, of all frames together, or of "
              "each frame its own")
      ->capture_default_str();
}

const std::vector<OptionPair> kNeeds = {
    {"--latitude-deg", "--longitude-deg"},
    {"--longitude-deg", "--latitude-deg"},
    {"--date", "--time"},
    {"--time", "--date"},
    {"--utc-offset-h", "--date"},
    {"--height-range-m", "--height-map"},
    {"--water-level-m", "--height-map"},
    {"--dem-surroundings", "--dem"},
    {"--dem-edge-m", "--dem"},
    {"--format", "--out-dir"},
    {"--update-frames", "--out-dir"},
};
const std::vector<OptionPair> kExcludes = {
    {"--altitude-m", "--above-ground-m"},
    {"--heading-deg", "--azimuth-deg"},
    {"--pitch-deg", "--view-zenith-deg"},
    {"--look-at", "--heading-deg"},
    {"--look-at", "--azimuth-deg"},
    {"--look-at", "--pitch-deg"},
    {"--look-at", "--view-zenith-deg"},
    {"--date", "--sun-zenith-deg"},
    {"--date", "--sun-azimuth-deg"},
    {"--step-min", "--frames"},
    {"--sequence", "--time"},
    {"--sequence", "--overview-m"},
    {"--panels", "--out-dir"},
    {"--exposure", "--adaptation-s"},
    {"--stokes", "--scalar"},
    {"--stokes", "--orders"},
    {"--stokes", "--clouds"},
};

}  // namespace

void check_combinations(const CLI::App& command) {
  const auto given = [&](const std::string& option) { return command.count(option) > 0; };
  const auto fail = [&](const std::string& option, const std::string& expected) {
    const CLI::Option& typed = *command.get_option(option);
    if (typed.get_expected_max() == 0) throw UsageError(option, expected);
    throw UsageError(option, typed.results().front(), expected);
  };
  for (const auto& pairs : {kNeeds, feature_needs()})
    for (const auto& [option, other] : pairs)
      if (given(option) && !given(other)) fail(option, fmt::format("expected with {}", other));
  for (const auto& pairs : {kExcludes, feature_excludes()})
    for (const auto& [option, other] : pairs)
      if (given(option) && given(other)) fail(option, fmt::format("expected without {}", other));
}

std::string drawing_models() {
  std::vector<std::string_view> names;
  for (const SkyModelEntry& entry : sky_models()) names.push_back(entry.name);
  return fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

void add_render_options(CLI::App& command, RenderOptions& options) {
  command.add_option("--preset", options.preset, "Shipped preset or preset file")
      ->type_name("FILE|NAME");
  command
      .add_option("--model", options.model,
                  fmt::format("Sky model: {}. Variants (NAME:VARIANT): skyfit compare --help",
                              drawing_models()))
      ->type_name("NAME")
      ->capture_default_str();
  add_scalar_option(command, options.scalar);
  command
      .add_option("--orders", options.orders,
                  "Light that met air or ground N times at most, of the model reference; 1: single "
                  "scattering. Below suns of 86 deg neighbouring places are left out (docs/theory)")
      ->type_name("N|all")
      ->transform(CLI::Transformer(std::map<std::string, int>{{"all", 0}}).description(""))
      ->check(CLI::Validator(
          [](const std::string& text) -> std::string {
            const bool is_number = CLI::Range(0, kMostOrders)(text).empty();
            return is_number ? ""
                             : fmt::format("\"{}\": expected 1 to {}, or all", text, kMostOrders);
          },
          ""));
  command.add_option("--out", options.out, "frame.png, frame.exr or frame.npy; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  auto* const stokes = command.add_flag(
      "--stokes", options.stokes,
      "Add to the EXR the polarisation of the sky's luminance: stokes.Q, stokes.U (cd/m^2), its "
      "degree dolp and angle aolp (deg), in the meridian plane of each pixel, as skyfit sky "
      "--stokes; not a number where ground or objects are seen");
  add_iau_option(command, options.iau, stokes);
  command.add_flag("--panels", options.panels,
                   "Beside each PNG the parts of the picture as PNGs, as frame.depth.png; an EXR "
                   "then holds them, too");
  command.add_flag("--stats", options.stats,
                   "Print triangles, blocks, the device and the time of every pass");
  add_threads_option(command, options.threads);
  command.add_flag("--no-cache", options.no_cache,
                   "Compute tables, ground and textures anew instead of reading or keeping them in "
                   "$XDG_CACHE_HOME/skyfit or ~/.cache/skyfit");
  add_camera_options(command, options);
  add_sun_options(command, options);
  add_scene_options(command, options);
  add_picture_options(command, options);
  add_feature_options(command);
  Group(command, "Blocks of the ground")
      .option("--overview-m", options.overview, "LENGTH",
              "The picture is taken from so far above the camera, straight down, and shows the "
              "blocks that the camera sees");
  add_table_options(command, options);
  add_sequence_options(command, options);
}

}  // namespace skyfit::cli
