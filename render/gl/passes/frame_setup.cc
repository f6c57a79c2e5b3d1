// SPDX-License-Identifier: Apache-2.0
#include "render/gl/passes/frame_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/gl/atmosphere/atmosphere_pass.h"
#include "render/gl/passes/gbuffer.h"
#include "render/scene/second_light.h"

namespace skyfit {
namespace {

constexpr std::int64_t kMaxSamples = std::int64_t{1} << 25;  // 16 bytes each in the largest texture

}  // namespace

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

void add_targets(int width, int height, bool layers, FrameGraph& graph) {
  add_gbuffer(width, height, graph);
  graph.add_target("light", GL_RGBA32F, width, height);
  graph.add_target("distance", GL_R32F, width, height);
  graph.add_target(kDiscWrite, GL_RGBA32F, width, height);
  if (!layers) return;
  for (const std::string& layer : kLayerWrites) graph.add_target(layer, GL_RGBA32F, width, height);
}

std::vector<glm::dvec3> directions_of_suns(const FrameOptions& options) {
  const auto direction = [](double zenith, double azimuth) {
    return glm::dvec3(std::sin(zenith) * std::cos(azimuth), -std::sin(zenith) * std::sin(azimuth),
                      std::cos(zenith));
  };
  std::vector<glm::dvec3> suns = {direction(options.sun_zenith, 0)};
  if (const auto second = second_light(options))
    suns.push_back(direction(second->zenith, second->azimuth));
  return suns;
}

std::int64_t device_clock_ns() {
  GLint64 now = 0;
  glGetInteger64v(GL_TIMESTAMP, &now);
  return now;
}

}  // namespace skyfit
