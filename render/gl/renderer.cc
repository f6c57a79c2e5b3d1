// SPDX-License-Identifier: Apache-2.0
#include "render/gl/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "render/gl/atmosphere_pass.h"
#include "render/gl/context.h"
#include "render/gl/passes.h"
#include "render/gl/terrain_pass.h"
#include "render/gl/view_basis.h"

namespace skyfit {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::int64_t kMaxSamples = std::int64_t{1} << 25;  // 16 bytes each in the largest texture

// Large pictures have small pixels: fewer samples where the textures would not fit.
int affordable_samples(const FrameOptions& options) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  const int longer = std::max(options.width, options.height);
  if (longer > limit) {
    throw std::invalid_argument(
        fmt::format("render: {} x {} pixels: this OpenGL draws at most {} on a side", options.width,
                    options.height, limit));
  }
  int samples = options.samples_per_side;
  const std::int64_t pixels = std::int64_t{options.width} * options.height;
  while (samples > 1 && (longer * samples > limit || pixels * samples * samples > kMaxSamples))
    --samples;
  return samples;
}

void add_targets(int width, int height, FrameGraph& graph) {
  graph.add_target("color", GL_RGBA8, width, height);
  graph.add_target("normal_reflectance", GL_RGBA16F, width, height);
  graph.add_target("depth", GL_DEPTH_COMPONENT32F, width, height);
  graph.add_target("light", GL_RGBA32F, width, height);
  graph.add_target("distance", GL_R32F, width, height);
}

// Calls f(pixel, sample) for every sample; OpenGL's rows run upward, a frame's downward.
template <class F>
void for_samples(const Frame& frame, int samples, F&& f) {
  const auto width = static_cast<std::size_t>(frame.width) * samples;
  for (int y = 0; y < frame.height * samples; ++y) {
    const auto row = static_cast<std::size_t>(frame.height - 1 - y / samples) * frame.width;
    for (std::size_t x = 0; x < width; ++x)
      f(row + x / samples, static_cast<std::size_t>(y) * width + x);
  }
}

void resolve_light(const FrameGraph& graph, int samples, Frame& frame) {
  const auto pixels = static_cast<std::size_t>(frame.width) * frame.height;
  const float part = 1.0f / static_cast<float>(samples * samples);
  const std::vector<float> light = graph.read_back("light", GL_RGBA, 4);
  frame.rgb.assign(3 * pixels, 0);
  frame.luminance.assign(pixels, 0);
  for_samples(frame, samples, [&](std::size_t pixel, std::size_t sample) {
    for (std::size_t k = 0; k < 3; ++k) frame.rgb[3 * pixel + k] += part * light[4 * sample + k];
    frame.luminance[pixel] += part * light[4 * sample + 3];
  });
  const std::vector<float> distance = graph.read_back("distance", GL_RED, 1);
  frame.depth_m.assign(pixels, std::numeric_limits<float>::infinity());
  for_samples(frame, samples, [&](std::size_t pixel, std::size_t sample) {
    frame.depth_m[pixel] = std::min(frame.depth_m[pixel], 1e3f * distance[sample]);
  });
}

void add_directions(const Camera& camera, Frame& frame) {
  const ViewBasis basis = view_basis(camera);
  const double tall = std::tan(0.5 * camera.vertical_fov);
  const double wide = tall * frame.width / frame.height;
  for (int y = 0; y < frame.height; ++y) {
    const double v = tall * (1 - (2 * y + 1.0) / frame.height);
    for (int x = 0; x < frame.width; ++x) {
      const double u = wide * ((2 * x + 1.0) / frame.width - 1);
      const glm::dvec3 ray = glm::normalize(basis.forward + u * basis.right + v * basis.up);
      const double zenith = std::atan2(std::hypot(ray.x, ray.y), ray.z);
      frame.view_zenith_deg.push_back(static_cast<float>(kDegrees * zenith));
      frame.view_azimuth_deg.push_back(static_cast<float>(kDegrees * std::atan2(-ray.y, ray.x)));
    }
  }
}

class GlRenderer final : public FrameDrawer {
 public:
  GlRenderer(const Scene&, GraphicsDevice) : context_(make_osmesa_context()) {}

  void set_atmosphere(const AtmosphereTables& tables) override {
    const double bottom = tables.atmosphere.bottom_radius_m;
    relief_.emplace(bottom, tables.atmosphere.ground_albedo);
    bottom_m_ = bottom;
    add_tables(tables, graph_);
    atmosphere_.emplace(tables);
  }

  double ground_height_m(const std::optional<Site>&) const override {
    return relief_->height_m(relief_->site_z(), 0.1);
  }

  Frame draw(const FrameOptions& options, const std::function<void(double)>& progress) override {
    const auto report = [&](double done) {
      if (progress) progress(done);
    };
    const double aspect = static_cast<double>(options.width) / options.height;
    FrameOptions sampled = options;
    sampled.samples_per_side = affordable_samples(options);
    const int samples = sampled.samples_per_side;
    TerrainSettings settings;
    settings.pixel_angle = options.camera.vertical_fov / (options.height * samples);
    const TerrainMesh mesh = make_terrain(*relief_, bottom_m_, options.camera, aspect, settings);
    report(0.5);
    add_targets(options.width * samples, options.height * samples, graph_);
    const TerrainPass terrain(mesh);
    const Projection projection = make_projection(options.camera, aspect);
    const std::vector<Pass> passes = {
        {"terrain", {}, {"color", "normal_reflectance", "depth"}, [&] { terrain.draw(projection); }},
        {"atmosphere", kAtmosphereReads, {"light", "distance"}, [&] {
           atmosphere_->draw(projection, sampled);
         }}};
    graph_.run(passes);
    report(0.8);

    Frame frame;
    frame.width = options.width;
    frame.height = options.height;
    frame.statistics.triangles = terrain.triangles();
    resolve_light(graph_, samples, frame);
    add_directions(options.camera, frame);
    report(1);
    return frame;
  }

 private:
  std::unique_ptr<GlContext> context_;
  FrameGraph graph_;
  double bottom_m_ = 0;
  std::optional<Relief> relief_;
  std::optional<AtmospherePass> atmosphere_;
};

}  // namespace

std::unique_ptr<FrameDrawer> make_drawer(const Scene& scene, GraphicsDevice device) {
  return std::make_unique<GlRenderer>(scene, device);
}

}  // namespace skyfit
