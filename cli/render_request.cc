// SPDX-License-Identifier: Apache-2.0
#include "cli/render_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "cli/arguments.h"
#include "cli/output.h"
#include "cli/render_arguments.h"
#include "cli/table_options.h"
#include "model/base/input_file.h"
#include "model/base/text.h"
#include "model/base/whole_file.h"
#include "model/registry.h"

namespace skyfit::cli {
namespace {

namespace fs = std::filesystem;

Sequence load_sequence(const std::string& file, const Keyframe& start) {
  const std::string text = read_file(file, "a sequence (JSON)");
  const fs::path folder = fs::path(file).parent_path();
  const auto preset = [&](const std::string& name) {
    const auto path = named_file(folder, name, named_files());
    const bool beside = path && fs::exists(*path);
    if (!beside && std::ranges::count(refs::shipped_preset_names(), name) > 0)
      return preset_named(name);
    if (!path)
      throw std::invalid_argument(
          fmt::format("{}: preset = {}: expected {}", file, in_quotes(name), kNamedFile));
    return preset_named(path->string());
  };
  return parse_sequence(text, file, start, {preset, parse_instant});
}

// Every camera that the request holds, as far as it can be judged before there is a ground.
void check_cameras(const RenderRequest& request) {
  const auto flat = [](const std::optional<Site>&) { return 0.0; };
  for (const Keyframe& keyframe : request.sequence.keyframes) {
    FrameOptions frame = request.frame;
    place_camera(keyframe.camera, shot_at(request.sequence, keyframe.time_s, sun_over).sun,
                 keyframe.preset.atmosphere.bottom_radius_m, flat, frame);
    validate(frame);
  }
}

// Options that would be ignored.
void require_mode(const CLI::App& command, bool is_day, bool is_sequence) {
  const auto require = [&](const char* option, bool mode, std::string_view expected) {
    if (command.count(option) > 0 && !mode)
      throw UsageError(option, command.get_option(option)->results().front(), expected);
  };
  for (const char* option : {"--step-min", "--frames", "--frames-per-second"})
    require(option, is_day, "expected with --time FROM..TO");
  for (const char* option : {"--adaptation-s", "--format"})
    require(option, is_sequence, "expected with a sequence (--sequence, or --time FROM..TO)");
  require("--metering", false, "expected with --strip or --rows");
}

std::vector<std::string> parse_formats(const std::string& text) {
  if (text == "png") return {".png"};
  if (text == "exr") return {".exr"};
  if (text == "png,exr" || text == "exr,png") return {".png", ".exr"};
  throw UsageError("--format", text, "expected png, exr or png,exr");
}

}  // namespace

RenderRequest frame_request(const RenderOptions& options, const CLI::App& command) {
  check_combinations(command);
  const bool is_file = command.count("--sequence") > 0;
  const bool is_day = options.time.find("..") != std::string::npos;
  if (!is_file && !options.start && command.count("--preset") == 0)
    throw UsageError("--preset", "", "expected a shipped preset or a preset file");
  require_mode(command, is_day, is_file || is_day);
  RenderRequest request;
  request.is_sequence = is_file || is_day;
  request.extensions = parse_formats(options.format);
  request.out = options.out;
  request.out_dir = options.out_dir;
  request.frame = parse_frame(options, command);
  request.tone = parse_tone(options, command);
  request.adaptation_s =
      parse_number_within("--adaptation-s", options.adaptation, 0, 3600, "a time in seconds");
  const Keyframe start = parse_start(options, command);
  if (is_file) {
    request.sequence = load_sequence(options.sequence, start);
    // The heights of a named view follow the radius of the planet, which the file may name.
    const Preset& first = request.sequence.keyframes.front().preset;
    if (first.atmosphere.bottom_radius_m != start.preset.atmosphere.bottom_radius_m) {
      RenderOptions on_planet = options;
      on_planet.start = first;
      request.sequence = load_sequence(options.sequence, parse_start(on_planet, command));
    }
  } else if (is_day) {
    request.sequence = parse_day(options, command, start);
  } else {
    request.sequence.keyframes = {start};
  }
  if (options.atmosphere == "off") {
    for (Keyframe& keyframe : request.sequence.keyframes) {
      keyframe.preset.atmosphere.constituents.clear();
      keyframe.preset.fit = nullptr;
    }
  } else if (options.atmosphere != "on") {
    throw UsageError("--atmosphere", options.atmosphere, "expected on or off");
  }
  check_cameras(request);
  request.scene = parse_scene(options, command);
  request.device = options.gpu ? GraphicsDevice::kGpu : GraphicsDevice::kSoftware;
  if (!draws_frames(options.model)) {
    throw UsageError("--model", options.model,
                     fmt::format("expected {}; skyfit compare draws the skies of all variants",
                                 drawing_models()));
  }
  request.model = options.model;
  request.light = {transfer_of(options.scalar), options.orders};
  if (options.orders > 0 && options.model != "reference")
    throw UsageError("--orders", std::to_string(options.orders), "expected the model reference");
  if (options.stokes) {
    if (options.model != "reference")
      throw UsageError("--stokes", "true", "expected the model reference, which has polarisation");
    request.stokes = options.iau ? PolarisationAngle::kIau : PolarisationAngle::kClockwise;
  }
  request.table_sizes = parse_table_sizes("--table-size", options.table_size);
  request.table_precision = parse_table_precision("--table-precision", options.table_precision);
  if (command.count("--update-frames") > 0) {
    const std::string typed = std::to_string(options.update_frames);
    constexpr int kSlices[] = {2, 4, 8, 16, 32};
    if (std::ranges::count(kSlices, options.update_frames) == 0)
      throw UsageError("--update-frames", typed, "expected 2, 4, 8, 16 or 32");
    if (options.model != "bodare")
      throw UsageError("--update-frames", typed, "expected the model bodare without variants");
  }
  request.update_frames = options.update_frames;
  request.panels = options.panels;
  request.stats = options.stats;
  request.threads = options.threads;
  if (options.no_cache) return request;
  if (const auto directory = user_cache_directory()) {
    request.cache = std::make_shared<ContentCache>(*directory);
  } else {
    request.cache_trouble = kNoCachePlace;
  }
  return request;
}

void check_outputs(const RenderOptions& options, const CLI::App& command,
                   const RenderRequest& request) {
  const auto is_exr = [](const std::string& name) { return name.ends_with(".exr"); };
  if (request.is_sequence) {
    if (!options.out.empty())
      throw UsageError("--out", options.out.front(), "expected --out-dir for a sequence");
    if (options.out_dir.empty())
      throw UsageError("--out-dir", "", "expected a directory for the frames of a sequence");
  } else {
    if (!options.out_dir.empty())
      throw UsageError("--out-dir", options.out_dir,
                       "expected a sequence (--sequence, or --time FROM..TO)");
    if (options.out.empty())
      throw UsageError("--out", "", "expected name.png, name.exr or name.npy");
    if (options.panels && std::ranges::any_of(options.out, is_stdout))
      throw UsageError("--panels", "true", "expected files: panels are written beside --out");
    require_output_files(options.out, {".png", ".exr", ".npy"});
  }
  const auto is_linear = [](const std::string& name) {
    return name.ends_with(".exr") || name.ends_with(".npy");
  };
  const std::vector<std::string>& names = request.is_sequence ? request.extensions : request.out;
  const bool has_exr = std::ranges::any_of(names, is_exr);
  const auto require_exr = [&](bool wanted, const char* option, const std::string& value) {
    if (wanted && !has_exr) throw UsageError(option, value, "expected an output that ends in .exr");
  };
  const bool has_png =
      std::ranges::any_of(options.out, [](const auto& name) { return name.ends_with(".png"); });
  if (options.panels && !has_png)
    throw UsageError("--panels", "true", "expected an output that ends in .png");
  require_exr(command.count("--layers") > 0, "--layers", "true");
  require_exr(options.stokes, "--stokes", "true");
  if (request.frame.primaries != Primaries::kRec709 && std::ranges::none_of(names, is_linear))
    throw UsageError("--primaries", options.primaries,
                     "expected an output that ends in .exr or .npy");
}

RenderRequest render_request(const RenderOptions& options, const CLI::App& command) {
  RenderRequest request = frame_request(options, command);
  check_outputs(options, command, request);
  return request;
}

}  // namespace skyfit::cli
