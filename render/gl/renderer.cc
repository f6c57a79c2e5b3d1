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

void resolve_gbuffer(const FrameGraph& graph, int samples, Frame& frame) {
  const auto pixels = static_cast<std::size_t>(frame.width) * frame.height;
  const std::vector<float> shape = graph.read_back("normal_reflectance", GL_RGBA, 4);
  const std::vector<float> color = graph.read_back("color", GL_RGBA, 4);
  frame.normal.assign(3 * pixels, 0);
  frame.reflectance.assign(4 * pixels, 0);
  // The last sample of each pixel: normals have no mean across an edge.
  for_samples(frame, samples, [&](std::size_t pixel, std::size_t sample) {
    for (std::size_t k = 0; k < 3; ++k) frame.normal[3 * pixel + k] = shape[4 * sample + k];
    const float scale = shape[4 * sample + 3] * std::numbers::pi_v<float>;
    for (std::size_t k = 0; k < 4; ++k)
      frame.reflectance[4 * pixel + k] = scale * color[4 * sample + k];
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

}  // namespace

Frame draw_frame(const AtmosphereTables& tables, const FrameOptions& options,
                 const std::function<void(double)>& progress) {
  const auto report = [&](double done) {
    if (progress) progress(done);
  };
  const double bottom = tables.atmosphere.bottom_radius_m;
  const double aspect = static_cast<double>(options.width) / options.height;
  const std::unique_ptr<GlContext> context = make_osmesa_context();
  FrameOptions sampled = options;
  sampled.samples_per_side = affordable_samples(options);
  const int samples = sampled.samples_per_side;

  const Relief relief(bottom, tables.atmosphere.ground_albedo);
  TerrainSettings settings;
  settings.pixel_angle = options.camera.vertical_fov / (options.height * samples);
  const TerrainMesh mesh = make_terrain(relief, bottom, options.camera, aspect, settings);
  report(0.5);
  FrameGraph graph;
  add_targets(options.width * samples, options.height * samples, graph);
  add_tables(tables, graph);
  const TerrainPass terrain(mesh);
  const AtmospherePass atmosphere(tables);
  const Projection projection = make_projection(options.camera, aspect);
  const std::vector<Pass> passes = {
      {"terrain", {}, {"color", "normal_reflectance", "depth"}, [&] { terrain.draw(projection); }},
      {"atmosphere", kAtmosphereReads, {"light", "distance"}, [&] {
         atmosphere.draw(projection, sampled);
       }}};
  graph.run(passes);
  report(0.8);

  Frame frame;
  frame.width = options.width;
  frame.height = options.height;
  frame.triangles = terrain.triangles();
  resolve_light(graph, samples, frame);
  if (options.keep_gbuffer) resolve_gbuffer(graph, samples, frame);
  add_directions(options.camera, frame);
  report(1);
  return frame;
}

}  // namespace skyfit
