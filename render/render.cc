// SPDX-License-Identifier: Apache-2.0
#include "render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "model/base/module_file.h"
#include "model/base/npy_file.h"
#include "model/literature/evaluate.h"
#include "model/numerics/angles.h"
#include "render/dem/dem_module.h"
#include "render/module/module.h"
#include "render/scene/second_light.h"
#include "render/sky_map/mapped_frame.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

const RenderModule& module() {
  static const auto& opened = module_named<RenderModule>("skyfit_render_module");
  return opened;
}

void add_metadata(const std::string& preset, const FrameOptions& options, Frame& frame) {
  const Camera& camera = options.camera;
  const auto add = [&](const char* name, double value) {
    frame.metadata.emplace_back(name, fmt::format("{:.9g}", value));
  };
  frame.metadata.emplace_back("skyfit:preset", preset);
  add("skyfit:sun_zenith_deg", options.sun_zenith * kDegreesPerRadian);
  add("skyfit:camera_altitude_m", camera.altitude_m);
  add("skyfit:camera_azimuth_deg", camera.azimuth * kDegreesPerRadian);
  if (has_direction(options.projection))
    add("skyfit:camera_view_zenith_deg", camera.view_zenith * kDegreesPerRadian);
  if (options.projection == PictureProjection::kPerspective) {
    add("skyfit:camera_vertical_fov_deg", camera.vertical_fov * kDegreesPerRadian);
  } else {
    const MapProjectionEntry& entry = entry_of(options.projection);
    frame.metadata.emplace_back("skyfit:projection", entry.name);
    if (entry.field_of_view > 0)
      add("skyfit:field_of_view_deg",
          options.field_of_view.value_or(entry.field_of_view) * kDegreesPerRadian);
  }
  if (options.site) {
    add("skyfit:latitude_deg", options.site->latitude * kDegreesPerRadian);
    add("skyfit:longitude_deg", options.site->longitude * kDegreesPerRadian);
    add("skyfit:sun_azimuth_deg", options.site->sun_azimuth * kDegreesPerRadian);
  }
}

constexpr double kRoom = 0.3;  // m, of a camera above the ground

Scene above_its_lowest(Scene scene, double by) {
  scene.lowest_m += by;
  scene.highest_m += by;
  scene.water_level_m += by;
  for (PlacedMesh& mesh : scene.meshes) mesh.altitude_m += by;
  for (RegionalDem& dem : scene.dems) dem.zero_m += by;
  return scene;
}

}  // namespace

std::string dem_library() { return module_named<DemModule>("skyfit_dem_module").library(); }

std::vector<fs::path> texture_files(const fs::path& directory) {
  return module().texture_files(directory);
}

double basin_depth_m(const Scene& scene) {
  if (scene.height_map.empty()) return 0;
  return std::max(0.0, -std::max(scene.lowest_m, scene.water_level_m));
}

Renderer::Renderer(const Scene& scene, GraphicsDevice device, std::shared_ptr<ContentCache> cache)
    : basin_depth_m_(basin_depth_m(scene)) {
  validate(scene);
  drawer_ = module().make_drawer(above_its_lowest(scene, basin_depth_m_), device, std::move(cache));
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;

std::string Renderer::device() const { return drawer_->device(); }

void Renderer::set_atmosphere(const Preset& preset, const AtmosphereTables& tables,
                              TablePrecision precision) {
  drawer_->set_atmosphere(tables, precision);
  limits_ = tables.sky_rays.limits;
  preset_ = preset_to_json(preset);
}

void Renderer::set_ground(const Atmosphere<double>& atmosphere, const ColorRule& color) {
  drawer_->set_ground(atmosphere, color);
}

void Renderer::prepare(const FrameOptions& options) {
  validate(options);
  if (!is_above_ground(options)) return;
  const FrameOptions from_lowest = raised(options);
  if (options.projection == PictureProjection::kPerspective) {
    drawer_->prepare(from_lowest);
  } else {
    for (const FrameOptions& face : cube_faces(from_lowest)) drawer_->prepare(face);
  }
}

std::vector<std::string> Renderer::warnings() const { return drawer_->warnings(); }

double Renderer::ground_height_m(const std::optional<Site>& site) const {
  return drawer_->ground_height_m(site) - basin_depth_m_;
}

bool Renderer::is_above_ground(const FrameOptions& options) const {
  return options.camera.altitude_m >= ground_height_m(options.site) + kRoom;
}

// What the drawer wants: heights from the lowest ground, which is the bottom of its atmosphere.
FrameOptions Renderer::raised(const FrameOptions& options) const {
  FrameOptions raised = options;
  raised.camera.altitude_m += basin_depth_m_;
  if (raised.terrain.eye) raised.terrain.eye->altitude_m += basin_depth_m_;
  for (CloudLayer& clouds : raised.clouds) clouds.altitude_m += basin_depth_m_;
  return raised;
}

FrameOptions Renderer::above_lowest_ground(const FrameOptions& options) const {
  validate(options);
  if (preset_.empty()) throw std::logic_error("render: a frame needs an atmosphere");
  if (!is_above_ground(options)) {
    throw std::invalid_argument(
        fmt::format("render.camera.altitude_m = {:.9g}: must be above the ground, {:.9g} m",
                    options.camera.altitude_m, ground_height_m(options.site) + kRoom));
  }
  if (limits_) {
    std::vector<SkyPoint> suns = {{options.camera.altitude_m, options.sun_zenith, 0, 0}};
    if (const auto second = second_light(options))
      suns.push_back({options.camera.altitude_m, second->zenith});
    literature::check_daylight(limits_->model, suns, limits_->highest_m);
  }
  return raised(options);
}

FrameStatistics Renderer::submit(const FrameOptions& options) {
  if (options.projection != PictureProjection::kPerspective)
    throw std::invalid_argument("render.projection: must be perspective on a device");
  return drawer_->submit(above_lowest_ground(options));
}

FrameStatistics Renderer::wait() { return drawer_->wait(); }

Frame Renderer::draw(const FrameOptions& options, const std::function<void(double)>& progress) {
  const FrameOptions from_lowest = above_lowest_ground(options);
  Frame frame;
  if (options.projection == PictureProjection::kPerspective) {
    frame = drawer_->draw(from_lowest, progress);
  } else {
    frame = mapped_frame(
        from_lowest,
        [&](const FrameOptions& face, const std::function<void(double)>& report) {
          return drawer_->draw(face, report);
        },
        progress);
    if (options.glare == Glare::kEye) frame.glare = module().glare_of(frame);
  }
  add_metadata(preset_, options, frame);
  return frame;
}

Frame render_frame(const Preset& preset, const AtmosphereTables& tables,
                   const FrameOptions& options, const std::function<void(double)>& progress) {
  validate(options);
  Renderer renderer;
  renderer.set_atmosphere(preset, tables);
  return renderer.draw(options, progress);
}

void write_exr(const Frame& frame, const fs::path& file) { module().write_exr(frame, file); }

void write_npy(const Frame& frame, const fs::path& file) {
  write_npy(file,
            {static_cast<std::size_t>(frame.height), static_cast<std::size_t>(frame.width), 3},
            frame.rgb);
}

void write_png(const Frame& frame, const fs::path& file, const ToneOptions& tone) {
  ToneOptions exposed = tone;
  if (!exposed.exposure) exposed.exposure = metered_exposure(frame);
  module().write_png(frame, file, exposed);
}

void write_png(const FrameGrid& grid, const fs::path& file) { module().write_grid(grid, file); }

}  // namespace skyfit
