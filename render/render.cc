// SPDX-License-Identifier: Apache-2.0
#include "render/render.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <system_error>

#include "render/module/module.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kModuleFile = "skyfit_render_module.so";

// Beside the program or above it (build tree), in the library directory of its prefix (installed),
// where CMake installs it.
std::vector<fs::path> module_candidates() {
  std::vector<fs::path> files;
  std::error_code none;
  fs::path directory = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (int level = 0; level < 3 && !directory.empty(); ++level) {
    files.push_back(directory / kModuleFile);
    files.push_back(directory / SKYFIT_RENDER_MODULE_SUBDIR / kModuleFile);
    directory = directory.parent_path();
  }
  files.push_back(fs::path(SKYFIT_RENDER_MODULE_DIR) / kModuleFile);
  return files;
}

const RenderModule& open_module() {
  for (const fs::path& file : module_candidates()) {
    std::error_code none;
    if (!fs::exists(file, none)) continue;
    void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr)
      throw std::runtime_error(fmt::format("render: cannot load {}", dlerror()));
    using Entry = const RenderModule* (*)();
    const auto entry = reinterpret_cast<Entry>(dlsym(handle, "skyfit_render_module"));
    if (entry == nullptr || entry()->revision != kRenderModuleRevision) {
      throw std::runtime_error(
          fmt::format("render: {} belongs to another version of skyfit", file.string()));
    }
    return *entry();
  }
  throw std::runtime_error(
      fmt::format("render: {} is not installed with this program", kModuleFile));
}

const RenderModule& module() {
  static const RenderModule& opened = open_module();
  return opened;
}

void add_metadata(const Preset& preset, const FrameOptions& options, Frame& frame) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  const Camera& camera = options.camera;
  const auto add = [&](const char* name, double value) {
    frame.metadata.emplace_back(name, fmt::format("{:.9g}", value));
  };
  frame.metadata.emplace_back("skyfit:preset", preset_to_json(preset));
  add("skyfit:sun_zenith_deg", options.sun_zenith * kDegrees);
  add("skyfit:camera_altitude_m", camera.altitude_m);
  add("skyfit:camera_view_zenith_deg", camera.view_zenith * kDegrees);
  add("skyfit:camera_azimuth_deg", camera.azimuth * kDegrees);
  add("skyfit:camera_vertical_fov_deg", camera.vertical_fov * kDegrees);
}

}  // namespace

Frame render_frame(const Preset& preset, const AtmosphereTables& tables,
                   const FrameOptions& options, const std::function<void(double)>& progress) {
  validate(options);
  Frame frame = module().render_frame(tables, options, progress);
  add_metadata(preset, options, frame);
  return frame;
}

void write_exr(const Frame& frame, const fs::path& file) { module().write_exr(frame, file); }

void write_png(const Frame& frame, const fs::path& file, const ToneOptions& tone) {
  module().write_png(frame, file, tone);
}

}  // namespace skyfit
