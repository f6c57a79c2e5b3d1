// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "cli/arguments.h"
#include "cli/feature_options.h"
#include "cli/inputs.h"
#include "cli/render_arguments.h"
#include "data_refs/spectra.h"
#include "data_refs/table_csv.h"
#include "model/base/input_file.h"
#include "render/scene/material_file.h"
#include "render/sky_map/mapped_frame.h"

namespace skyfit::cli {

namespace fs = std::filesystem;

namespace {

constexpr double kMaxStops = 50;  // 2^50: from the darkest night to the sun's disc and beyond

// What is wrong with a frame or a scene of which an option gives the one thing that is not usual.
template <class What>
void expect_valid(std::string_view option, std::string_view text, const What& what) {
  try {
    validate(what);
  } catch (const std::invalid_argument& error) {
    throw UsageError(option, text, error.what());
  }
}

PlacedMesh parse_mesh(const std::string& text) {
  constexpr std::string_view kForm =
      "FILE@LATITUDE,LONGITUDE,ALTITUDE[,HEADING[,SCALE]] in degrees and metres";
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos) throw UsageError("--mesh", text, fmt::format("expected {}", kForm));
  const auto values = parse_tuple("--mesh", text.substr(at + 1), 3, 5, kForm);
  const Place place = parse_place("--mesh", text, values);
  PlacedMesh mesh;
  mesh.file = text.substr(0, at);
  require_regular_file(mesh.file, "a mesh for --mesh", kMostMeshBytes);
  mesh.latitude = place.latitude;
  mesh.longitude = place.longitude;
  mesh.altitude_m = values[2];
  if (values.size() > 3) mesh.heading = radians(values[3]);
  if (values.size() > 4) mesh.scale = values[4];
  Scene alone;
  alone.meshes = {mesh};
  expect_valid("--mesh", text, alone);
  return mesh;
}

// A file may have an @ in its name.
RegionalDem parse_dem(const std::string& text) {
  RegionalDem dem;
  dem.file = text;
  const std::size_t at = text.rfind('@');
  const std::string band = at == std::string::npos ? "" : text.substr(at + 1);
  const bool is_number = !band.empty() && band.find_first_not_of("0123456789") == std::string::npos;
  if (is_number && !fs::exists(dem.file)) {
    constexpr double kMostBands = 65535;  // of a TIFF
    const double number = parse_number("--dem", band);
    if (!(number >= 1 && number <= kMostBands))
      throw UsageError("--dem", text, "expected FILE@BAND, the band a number from 1 on");
    dem.band = static_cast<int>(number);
    dem.file = text.substr(0, at);
  }
  require_regular_file(dem.file, "a GeoTIFF or .hgt for --dem", kMostImageBytes);
  return dem;
}

void parse_dems(const RenderOptions& options, const CLI::App& command, Scene& scene) {
  for (const std::string& dem : options.dems) scene.dems.push_back(parse_dem(dem));
  if (options.dem_surroundings != "planet" && options.dem_surroundings != "sea")
    throw UsageError("--dem-surroundings", options.dem_surroundings, "expected planet or sea");
  scene.dem_surroundings =
      options.dem_surroundings == "sea" ? DemSurroundings::kSea : DemSurroundings::kPlanet;
  if (command.count("--dem-edge-m") > 0)
    scene.dem_edge_m =
        parse_number_within("--dem-edge-m", options.dem_edge, 0, 1e7, "a length in metres");
}

// Of an option that may be typed once, and was.
std::string typed(const CLI::App& command, const std::string& option) {
  return command.get_option(option)->results().front();
}

// Null: that of the first sun.
std::shared_ptr<const SpectralData> parse_second_spectrum(const CLI::App& command) {
  Star star;
  if (command.count("--second-sun-temperature-k") > 0) {
    star.spectrum = StarSpectrum::kBlackBody;
    const std::string text = typed(command, "--second-sun-temperature-k");
    star.temperature_k = parse_number("--second-sun-temperature-k", text);
    expect_valid("--second-sun-temperature-k", text, star);
  } else if (command.count("--second-sun-spectrum") > 0) {
    star.spectrum = StarSpectrum::kTabulated;
    star.table = std::make_shared<const SpectrumTable>(
        refs::load_table_csv(typed(command, "--second-sun-spectrum"), kIrradianceFormat),
        kIrradianceFormat);
  } else {
    return nullptr;
  }
  auto spectra = std::make_shared<const SpectralData>(under(refs::standard_spectral_data(), star));
  if (!(illuminance_of(*spectra) > 0))
    throw UsageError("--second-sun-spectrum", typed(command, "--second-sun-spectrum"),
                     "expected irradiance between 380 and 780 nm");
  return spectra;
}

// The features of several numbers.
void parse_sky_objects(const CLI::App& command, FrameOptions& frame) {
  if (command.count("--moon") > 0) {
    const std::string text = typed(command, "--moon");
    const auto values =
        parse_tuple("--moon", text, 2, 4, "ZENITH,AZIMUTH or ZENITH,AZIMUTH,DISTANCE,RADIUS");
    if (values.size() == 3)
      throw UsageError("--moon", text, "expected a radius after the distance");
    frame.moon = Moon{.zenith = radians(values[0]), .azimuth = radians(values[1])};
    if (values.size() == 4) {
      frame.moon->distance_m = values[2];
      frame.moon->radius_m = values[3];
    }
    frame.moon->lights = command.get_option("--moonlight")->as<bool>();
    FrameOptions alone;
    alone.moon = frame.moon;
    expect_valid("--moon", text, alone);
  }
  if (command.count("--second-sun") > 0) {
    const std::string text = typed(command, "--second-sun");
    const auto values = parse_tuple("--second-sun", text, 3, 3, "ZENITH,AZIMUTH,SHARE");
    frame.second_sun = SecondSun{radians(values[0]), radians(values[1]), values[2],
                                 parse_second_spectrum(command)};
    FrameOptions alone;
    alone.second_sun = frame.second_sun;
    expect_valid("--second-sun", text, alone);
  }
  FrameOptions sheets;
  for (const std::string& text : command.get_option("--clouds")->results()) {
    const auto values =
        parse_tuple("--clouds", text, 1, 3, "COVER, COVER,ALTITUDE or COVER,ALTITUDE,OPACITY");
    CloudLayer& clouds = sheets.clouds.emplace_back(CloudLayer{.cover = values[0]});
    if (values.size() > 1) clouds.altitude_m = values[1];
    if (values.size() > 2) clouds.opacity = values[2];
    expect_valid("--clouds", text, sheets);
  }
  frame.clouds = sheets.clouds;
}

// Of another projection than perspective: size and field of view, and what has no meaning there.
void parse_map(const RenderOptions& options, const CLI::App& command, FrameOptions& frame) {
  const MapProjectionEntry& entry = entry_of(frame.projection);
  const auto refuse = [&](const char* option, const char* expected) {
    if (command.count(option) > 0) throw UsageError(option, typed(command, option), expected);
  };
  if (!has_direction(frame.projection)) {
    for (const char* option : {"--pitch-deg", "--view-zenith-deg", "--look-at"})
      refuse(option, "expected with --projection perspective or angular; the others are upright");
  }
  if (entry.field_of_view <= 0) {
    refuse("--field-of-view-deg",
           "expected with --projection perspective, fisheye or angular; the others show all "
           "directions");
  } else if (command.count("--field-of-view-deg") > 0) {
    frame.field_of_view = parse_angle("--field-of-view-deg", options.field_of_view, 1, 360);
  }
  if (command.count("--size") == 0)
    frame.width = entry.make(frame.height, entry.field_of_view)->width();
  expect_valid("--size", options.size, frame);
}

}  // namespace

Scene parse_scene(const RenderOptions& options, const CLI::App& command) {
  Scene scene;
  if (command.count("--height-map") > 0) {
    scene.height_map = options.height_map;
    require_regular_file(scene.height_map, "an image for --height-map", kMostImageBytes);
    if (scene.height_map.extension() == ".hgt")
      throw UsageError(
          "--height-map", options.height_map,
          "expected a picture of the whole planet; --dem reads the heights of a region");
  }
  if (command.count("--color-map") > 0) {
    if (scene.height_map.empty())
      throw UsageError(
          "--color-map", options.color_map,
          "expected with --height-map; the ground without a map has colours of its own");
    scene.color_map = options.color_map;
    require_regular_file(scene.color_map, "an image for --color-map", kMostImageBytes);
  }
  const auto [low, high] =
      parse_ends("--height-range-m", options.height_range, "LOW..HIGH in metres");
  scene.lowest_m = parse_number("--height-range-m", low);
  scene.highest_m = parse_number("--height-range-m", high);
  if (!(scene.lowest_m < scene.highest_m))
    throw UsageError("--height-range-m", options.height_range, "expected LOW..HIGH, LOW < HIGH");
  Scene heights;
  heights.lowest_m = scene.lowest_m;
  heights.highest_m = scene.highest_m;
  expect_valid("--height-range-m", options.height_range, heights);
  scene.water_level_m =
      parse_number_within("--water-level-m", options.water_level, -1e5, 1e5, "a height in metres");
  parse_dems(options, command, scene);
  for (const std::string& mesh : options.meshes) scene.meshes.push_back(parse_mesh(mesh));
  scene.textures = options.textures;
  scene.named_files = named_files();
  if (!scene.textures.empty() && !std::filesystem::is_directory(scene.textures))
    throw UsageError("--textures", options.textures, "no such directory");
  const OwnMaterials own = read_materials(scene.textures, scene.named_files, scene.color_map);
  scene.soil = own.soil;
  scene.rock = own.rock;
  validate(scene);
  return scene;
}

FrameOptions parse_frame(const RenderOptions& options, const CLI::App& command) {
  const ImageSize size = parse_image_size("--size", options.size);
  FrameOptions frame = frame_with_features(command);
  frame.width = size.width;
  frame.height = size.height;
  if (frame.projection != PictureProjection::kPerspective) parse_map(options, command, frame);
  frame.samples_per_side = options.samples_per_side;
  frame.layers |= options.panels;
  frame.primaries = parse_primaries(options.primaries);
  parse_sky_objects(command, frame);
  validate(frame);
  return frame;
}

ToneOptions parse_tone(const RenderOptions& options, const CLI::App& command) {
  ToneOptions tone;
  tone.exposure_stops = parse_number("--exposure-ev", options.exposure_ev);
  if (std::abs(tone.exposure_stops) > kMaxStops)
    throw UsageError("--exposure-ev", options.exposure_ev,
                     fmt::format("expected stops from {} to {}", -kMaxStops, kMaxStops));
  if (command.count("--exposure") > 0) {
    tone.exposure = parse_number("--exposure", options.exposure);
    if (!(*tone.exposure > 0 && *tone.exposure <= 1e12))
      throw UsageError("--exposure", options.exposure, "expected m^2/cd > 0, at most 1e12");
  }
  if (options.tone == "filmic") {
    tone.curve = ToneCurve::kFilmic;
  } else if (options.tone == "exponential") {
    tone.curve = ToneCurve::kExponential;
  } else if (options.tone == "clip") {
    tone.curve = ToneCurve::kClip;
  } else {
    throw UsageError("--tone", options.tone, "expected filmic, exponential or clip");
  }
  if (options.view_transform != "hue" && options.view_transform != "channels")
    throw UsageError("--view-transform", options.view_transform, "expected hue or channels");
  tone.transform = options.view_transform == "hue" ? ViewTransform::kHue : ViewTransform::kChannels;
  return tone;
}

}  // namespace skyfit::cli
