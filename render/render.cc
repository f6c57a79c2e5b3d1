// SPDX-License-Identifier: Apache-2.0
#include "render/render.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "model/module_file.h"
#include "render/module/module.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

const RenderModule& module() {
  static const auto& opened = module_named<RenderModule>("skyfit_render_module");
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
