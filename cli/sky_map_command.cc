// SPDX-License-Identifier: Apache-2.0
// `skyfit sky-map`: the light of all directions as one picture.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "data_refs/spectra.h"
#include "model/base/whole_file.h"
#include "model/registry.h"
#include "render/sky_map/frame_polarisation.h"
#include "render/sky_map/sky_map.h"

namespace skyfit::cli {
namespace {

struct SkyMapArguments {
  std::string preset, projection = "equirectangular", size = "512", out, sun_file;
  std::string sun_zenith, sun_azimuth = "0", altitude = "0", wavelengths, primaries = "rec709";
  std::string sun = "in", ground = "filled", model = "reference";
  bool scalar = false, stokes = false, iau = false;
  int threads = default_threads();
};

bool choice(std::string_view option, const std::string& text, std::string_view yes,
            std::string_view no) {
  if (text == yes || text == no) return text == yes;
  throw UsageError(option, text, fmt::format("expected {} or {}", yes, no));
}

SkyMapOptions options_of(const SkyMapArguments& arguments) {
  constexpr double kHighest_m = 1e9;
  SkyMapOptions options;
  options.altitude_m =
      parse_number_within("--altitude-m", arguments.altitude, 0, kHighest_m, "a height in metres");
  options.sun_zenith = parse_angle("--sun-zenith-deg", arguments.sun_zenith, 0, 180);
  options.sun_azimuth = parse_angle("--sun-azimuth-deg", arguments.sun_azimuth, -360, 360);
  options.sun_disc = choice("--sun", arguments.sun, "in", "out");
  options.stokes = arguments.stokes;
  options.angle = arguments.iau ? PolarisationAngle::kIau : PolarisationAngle::kClockwise;
  options.ground = choice("--ground", arguments.ground, "filled", "black");
  return options;
}

MapChannels channels_of(const SkyMapArguments& arguments, const SpectralData& spectra) {
  if (arguments.wavelengths.empty()) return xyz_channels(spectra);
  const auto& table = spectra.ozone_cross_section.wavelength_nm;
  const std::vector<double> nm =
      parse_list_within("--wavelength-nm", arguments.wavelengths, table.front(), table.back(),
                        "a wavelength in nm that the tables hold,");
  if (std::set<double>(nm.begin(), nm.end()).size() != nm.size())
    throw UsageError("--wavelength-nm", arguments.wavelengths, "expected each wavelength once");
  return spectral_channels(spectra, nm);
}

nlohmann::ordered_json sun_json(const SkyMap& map, const SkyMapOptions& options, const Star& star) {
  nlohmann::ordered_json irradiance;
  for (std::size_t c = 0; c < map.channels.size(); ++c)
    irradiance[map.channels[c]] = map.direct_normal[c];
  return {{"zenith_deg", degrees(options.sun_zenith)},
          {"azimuth_deg", degrees(options.sun_azimuth)},
          {"angular_diameter_deg", 2 * degrees(star.angular_radius_rad())},
          {"direct_normal_irradiance", irradiance},
          {"unit", map.is_xyz ? "lx (Y), CIE 1931 XYZ" : "W m-2 nm-1"}};
}

void add_metadata(const Preset& preset, const SkyMapArguments& arguments,
                  const SkyMapOptions& options, SkyMap& map) {
  map.metadata = {{"skyfit:preset", preset_to_json(preset)},
                  {"skyfit:projection", arguments.projection},
                  {"skyfit:model", arguments.model},
                  {"skyfit:transfer", std::string(transfer_name(transfer_of(arguments.scalar)))},
                  {"skyfit:unit", map.is_xyz ? "cd/m^2" : "W m-2 sr-1 nm-1"},
                  {"skyfit:sun", sun_json(map, options, preset.atmosphere.star).dump()},
                  {"skyfit:sun_disc", arguments.sun},
                  {"skyfit:ground", arguments.ground},
                  {"skyfit:altitude_m", fmt::format("{:.9g}", options.altitude_m)}};
  if (options.stokes) map.metadata.emplace_back("skyfit:stokes", stokes_convention(options.angle));
}

void print_summary(const SkyMap& map, const std::string& file) {
  print(fmt::format("{}: {} x {} pixels\n", file, map.width, map.height));
  for (std::size_t c = 0; c < map.channels.size(); ++c) {
    if (map.is_xyz && map.channels[c] != "Y") continue;
    const std::string what = map.is_xyz ? "illuminance" : "irradiance at " + map.channels[c],
                      unit = map.is_xyz ? "lx" : "W m-2 nm-1";
    print(fmt::format("{}, diffuse horizontal: {:.6g} {} ({:.6g} as the sum over the pixels)\n",
                      what, map.diffuse_horizontal[c], unit, map.map_horizontal[c]));
    print(fmt::format("{}, direct normal: {:.6g} {}\n", what, map.direct_normal[c], unit));
  }
}

void require_formats(const SkyMapArguments& arguments) {
  require_output_files({arguments.out}, {".exr", ".hdr", ".ktx2", ".npy"});
  if (arguments.out.ends_with(".exr") || arguments.out.ends_with(".npy")) return;
  constexpr const char* kNeeded = "expected with an .exr or .npy file, which may have any channels";
  if (arguments.stokes) throw UsageError("--stokes", "", kNeeded);
  if (!arguments.wavelengths.empty())
    throw UsageError("--wavelength-nm", arguments.wavelengths, kNeeded);
}

void run_sky_map(const SkyMapArguments& arguments) {
  require_formats(arguments);
  if (arguments.stokes && arguments.scalar) throw UsageError("--scalar", "", kScalarStokes);
  if (!arguments.sun_file.empty())
    require_output_files({arguments.sun_file}, {".json"}, "--sun-file");
  const Primaries primaries = parse_primaries(arguments.primaries);
  if (arguments.out.ends_with(".hdr") && primaries != Primaries::kRec709)
    throw UsageError("--primaries", arguments.primaries, "expected rec709 for a .hdr file");
  if (!arguments.wavelengths.empty() && primaries != Primaries::kRec709)
    throw UsageError("--primaries", arguments.primaries, "expected without --wavelength-nm");
  constexpr double kLeast = 8, kMost = 8192;
  const double size =
      parse_number_within("--size", arguments.size, kLeast, kMost, "a whole number of pixels");
  if (size != std::floor(size))
    throw UsageError("--size", arguments.size, "expected a whole number of pixels");
  SkyMapOptions options = options_of(arguments);
  std::unique_ptr<MapProjection> projection;
  try {
    projection = make_map_projection(arguments.projection, static_cast<int>(size));
  } catch (const std::invalid_argument& unknown) {
    throw UsageError("--projection", arguments.projection, unknown.what());
  }
  const Preset preset = preset_named(arguments.preset);
  const SpectralData spectra = refs::spectral_data_of(preset.atmosphere);
  const auto model =
      make_sky_model(arguments.model, spectra, arguments.threads, transfer_of(arguments.scalar));
  options.level_horizon = !sky_model_entry(arguments.model).sees_ground;
  if (options.ground && options.level_horizon) {
    throw UsageError("--ground", arguments.ground,
                     fmt::format("expected black: the model {} has the sky alone", model->name()));
  }
  Progress progress("mapping the sky");
  options.progress = [&](double done) { progress.show(done, arguments.projection); };
  SkyMap map =
      sky_map(*model, preset.atmosphere, channels_of(arguments, spectra), *projection, options);
  add_metadata(preset, arguments, options, map);
  write_sky_map(map, primaries, arguments.out);
  if (!arguments.sun_file.empty()) {
    write_whole_file(arguments.sun_file,
                     sun_json(map, options, preset.atmosphere.star).dump(2) + "\n");
  }
  print_summary(map, arguments.out);
}

}  // namespace

void add_sky_map_command(CLI::App& app) {
  const auto arguments = std::make_shared<SkyMapArguments>();
  CLI::App& command = *app.add_subcommand(
      "sky-map", "Writes the light of all directions as one picture, for other renderers.");
  add_particle_cache_option(command);
  const auto option = [&](const char* name, std::string& value, const char* meaning,
                          const char* type) {
    return command.add_option(name, value, meaning)->type_name(type)->capture_default_str();
  };
  option("preset", arguments->preset, "Shipped preset or preset file", "PRESET")->required();
  option("--out", arguments->out, "The picture", "FILE.{exr,hdr,ktx2,npy}")->required();
  option("--sun-zenith-deg", arguments->sun_zenith, "Zenith angle of the sun, 0 to 180", "ANGLE")
      ->required();
  option("--sun-azimuth-deg", arguments->sun_azimuth, "Azimuth of the sun, clockwise from north",
         "ANGLE");
  option("--projection", arguments->projection, "How directions become pixels, see below", "NAME");
  option("--size", arguments->size, "N of the projection, 8 to 8192", "N");
  option("--altitude-m", arguments->altitude, "Height of the observer above the ground", "LENGTH");
  option("--sun", arguments->sun, "in: the sun's disc is in the picture; out: it is not", "in|out");
  option("--sun-file", arguments->sun_file,
         "Also write direction, size and irradiance of the sun, as JSON", "FILE.json");
  option("--ground", arguments->ground,
         "filled: below the horizon the ground as the model sees it; black: nothing, as preetham "
         "and hosek-wilkie need it, which have the sky alone",
         "filled|black");
  option("--wavelength-nm", arguments->wavelengths,
         "Channels of spectral radiance, W m^-2 sr^-1 nm^-1, in the place of colour", "LIST");
  option("--primaries", arguments->primaries, "Of the colour, cd/m^2: rec709, rec2020 or xyz",
         "NAME");
  option("--model", arguments->model, "Sky model", "NAME");
  auto* const stokes = command.add_flag(
      "--stokes", arguments->stokes, "Also write layers of polarisation into the .exr, see below");
  add_iau_option(command, arguments->iau, stokes);
  add_scalar_option(command, arguments->scalar);
  add_threads_option(command, arguments->threads);
  command.footer(
      "Projections:\n" + named_lines(map_projections()) +
      "\nLight outside the primaries becomes less saturated, of the same luminance. The "
      "irradiance\n"
      "that the map gives is printed beside the model's.\n"
      "\n"
      ".ktx2 is a texture of Khronos for engines, of floats with alpha 1; of the projection cube a "
      "cube\n"
      "map in that format's left-handed axes: +X is east, +Y up, +Z north.\n"
      "\n"
      "--stokes writes stokes.Q and stokes.U (cd/m^2 of luminance, or W m^-2 sr^-1 nm^-1), dolp, "
      "the "
      "degree\n"
      "of linear polarisation (0 to 1), and aolp, its angle in degrees; with --wavelength-nm each "
      "with "
      "the\n"
      "wavelength behind its name (dolp.450nm). They are those of diffuse light, without the sun's "
      "disc;\n"
      "the reference plane is the meridian plane of a pixel's direction, with the signs of skyfit "
      "sky\n"
      "--stokes.\n"
      "\n"
      "Examples:\n"
      "  skyfit sky-map earth-clear --sun-zenith-deg 40 --size 1024 --out sky.exr\n"
      "  skyfit sky-map fitted/preset.json --sun-zenith-deg 60 --sun out --sun-file sun.json "
      "--out sky.hdr\n"
      "  skyfit sky-map earth-clear --sun-zenith-deg 40 --projection cube --size 256 --out "
      "sky.ktx2\n"
      "  skyfit sky-map earth-clear --sun-zenith-deg 30 --projection octahedral "
      "--wavelength-nm 450,550,650 --out sky.exr\n"
      "  skyfit sky-map earth-clear --sun-zenith-deg 70 --projection fisheye --stokes --out "
      "sky.exr");
  command.callback([arguments] { run_sky_map(*arguments); });
}

}  // namespace skyfit::cli
