// SPDX-License-Identifier: Apache-2.0
// The options of `skyfit render`, as they are typed, but those of feature_options.h.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/inputs.h"
#include "render/render.h"

namespace skyfit::cli {

struct RenderOptions {
  std::string preset, model = "reference";
  // Camera
  std::string view = "ground", latitude, longitude, altitude, above_ground;
  std::string heading, azimuth, pitch, view_zenith, look_at, field_of_view;
  // Sun
  std::string sun_zenith, sun_azimuth, date, time, utc_offset = "0";
  // Several frames
  std::string sequence, step_min, frames_per_second = "24", out_dir, format = "png";
  std::string adaptation = "1", metering = "together";
  std::vector<std::string> strip, rows;
  int frames = 0, update_frames = 0;  // 0: not typed
  // Scene
  std::string height_map, height_range = "0..9000", color_map, water_level = "0", textures;
  std::string atmosphere = "on", overview;
  std::vector<std::string> meshes, dems;
  std::string dem_surroundings = "planet", dem_edge;
  // Picture
  std::string size = "1280x720", exposure, exposure_ev = "0", tone = "filmic";
  std::string view_transform = "hue";
  std::string primaries = "rec709", table_precision = "float", table_size = "full";
  int samples_per_side = FrameOptions{}.samples_per_side;
  int orders = 0;  // 0: all
  bool scalar = false, panels = false, gpu = false, stats = false;
  bool no_cache = false, stokes = false, iau = false;
  std::vector<std::string> out;
  int threads = default_threads();
  std::optional<Preset> start;  // in the place of --preset, of a caller that has it in memory
};

// The models that draw frames, in a sentence.
std::string drawing_models();

void add_render_options(CLI::App& command, RenderOptions& options);

// Throws UsageError for options that need others, or that go without them.
void check_combinations(const CLI::App& command);

}  // namespace skyfit::cli
