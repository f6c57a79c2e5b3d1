// SPDX-License-Identifier: Apache-2.0
#include "render/gl/passes/resolve.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "model/numerics/angles.h"
#include "render/gl/atmosphere/atmosphere_pass.h"
#include "render/gl/passes/view_basis.h"
#include "render/image/gamut.h"

namespace skyfit {
namespace {

// Calls f(pixel, values) with the `channels` values of every sample of a target, those of a pixel
// in the same order whatever the threads; OpenGL's rows run upward, a frame's downward. The target
// is read in bands: as a whole it may be larger than all else that a frame needs.
template <class F>
void for_samples(const FrameGraph& graph, const std::string& target, GLenum format, int channels,
                 const Frame& frame, int samples_per_side, F&& f) {
  constexpr int kBand = 64;  // rows of pixels
  const auto columns = static_cast<std::size_t>(frame.width) * samples_per_side;
  for (int low = 0; low < frame.height; low += kBand) {
    const int rows = std::min(kBand, frame.height - low);
    const std::vector<float> values =
        graph.read_rows(target, format, channels, low * samples_per_side, rows * samples_per_side);
    tbb::parallel_for(0, rows, [&](int row) {
      const std::size_t first =
          static_cast<std::size_t>(frame.height - 1 - low - row) * frame.width;
      for (int y = row * samples_per_side; y < (row + 1) * samples_per_side; ++y) {
        const float* sample = &values[static_cast<std::size_t>(y) * columns * channels];
        for (std::size_t x = 0; x < columns; ++x, sample += channels)
          f(first + x / samples_per_side, sample);
      }
    });
  }
}

// No light is negative. `values`: [pixel][3], in units of `unit` in each channel.
void bring_into_gamut(const ColorSpace& space, const ColorChannels& unit,
                      std::vector<float>& values) {
  tbb::parallel_for(std::size_t{0}, values.size() / 3, [&](std::size_t pixel) {
    const std::size_t i = 3 * pixel;
    if (std::min({values[i], values[i + 1], values[i + 2]}) >= 0) return;
    ColorChannels color;
    for (std::size_t k = 0; k < 3; ++k) color[k] = unit[k] * values[i + k];
    const ColorChannels mapped = into_gamut(color, luminance_of(color, space), space);
    for (std::size_t k = 0; k < 3; ++k) values[i + k] = static_cast<float>(mapped[k] / unit[k]);
  });
}

// [pixel][3], the mean of the samples.
std::vector<float> resolve_color(const FrameGraph& graph, const std::string& name,
                                 int samples_per_side, const Frame& frame) {
  std::vector<float> values(3 * frame.luminance.size(), 0);
  const float part = 1.0f / static_cast<float>(samples_per_side * samples_per_side);
  for_samples(graph, name, GL_RGB, 3, frame, samples_per_side,
              [&](std::size_t pixel, const float* sample) {
                for (std::size_t k = 0; k < 3; ++k) values[3 * pixel + k] += part * sample[k];
              });
  return values;
}

// [pixel][3] of the direct light, which is in the alphas of three layers.
std::vector<float> resolve_direct(const FrameGraph& graph, int samples_per_side,
                                  const Frame& frame) {
  std::vector<float> values(3 * frame.luminance.size(), 0);
  const float part = 1.0f / static_cast<float>(samples_per_side * samples_per_side);
  std::size_t k = 0;
  for (const char* layer : {"in_scatter", "reflected", "transmittance"}) {
    for_samples(
        graph, layer, GL_RGBA, 4, frame, samples_per_side,
        [&](std::size_t pixel, const float* sample) { values[3 * pixel + k] += part * sample[3]; });
    ++k;
  }
  return values;
}

void resolve_discs(const FrameGraph& graph, int samples_per_side, Frame& frame) {
  const float part = 1.0f / static_cast<float>(samples_per_side * samples_per_side);
  std::vector<std::array<float, 4>> sums(frame.luminance.size(), {0, 0, 0, 0});
  for_samples(graph, kDiscWrite, GL_RGBA, 4, frame, samples_per_side,
              [&](std::size_t pixel, const float* sample) {
                if (sample[3] <= 0) return;
                for (std::size_t k = 0; k < 4; ++k) sums[pixel][k] += part * sample[k];
              });
  const ColorSpace& space = color_space(frame.primaries);
  for (std::size_t pixel = 0; pixel < sums.size(); ++pixel) {
    const std::array<float, 4>& sum = sums[pixel];
    if (sum[3] <= 0) continue;
    const ColorChannels light = {sum[0], sum[1], sum[2]};
    const double luminance = luminance_of(light, space);
    const ColorChannels mapped = into_gamut(light, luminance, space);
    DiscPixel& disc = frame.discs.emplace_back();
    disc.pixel = pixel;
    disc.cover = sum[3];
    for (std::size_t k = 0; k < 3; ++k) disc.rgb[k] = static_cast<float>(mapped[k]);
    disc.luminance = static_cast<float>(luminance);
  }
}

}  // namespace

void resolve_light(const FrameGraph& graph, int samples_per_side, Frame& frame) {
  const auto pixels = static_cast<std::size_t>(frame.width) * frame.height;
  const float part = 1.0f / static_cast<float>(samples_per_side * samples_per_side);
  frame.rgb.assign(3 * pixels, 0);
  frame.luminance.assign(pixels, 0);
  for_samples(graph, "light", GL_RGBA, 4, frame, samples_per_side,
              [&](std::size_t pixel, const float* sample) {
                for (std::size_t k = 0; k < 3; ++k) frame.rgb[3 * pixel + k] += part * sample[k];
                frame.luminance[pixel] += part * sample[3];
              });
  const ColorSpace& space = color_space(frame.primaries);
  bring_into_gamut(space, {1, 1, 1}, frame.rgb);
  resolve_discs(graph, samples_per_side, frame);
  frame.depth_m.assign(pixels, std::numeric_limits<float>::infinity());
  for_samples(graph, "distance", GL_RED, 1, frame, samples_per_side,
              [&](std::size_t pixel, const float* sample) {
                frame.depth_m[pixel] = std::min(frame.depth_m[pixel], 1e3f * sample[0]);
              });
}

FrameLayers resolve_layers(const FrameGraph& graph, int samples_per_side, const Frame& frame) {
  FrameLayers layers;
  layers.in_scatter = resolve_color(graph, "in_scatter", samples_per_side, frame);
  layers.reflected = resolve_color(graph, "reflected", samples_per_side, frame);
  layers.direct = resolve_direct(graph, samples_per_side, frame);
  layers.transmittance = resolve_color(graph, "transmittance", samples_per_side, frame);
  layers.normal = resolve_color(graph, "normal", samples_per_side, frame);
  layers.albedo = resolve_color(graph, "albedo", samples_per_side, frame);
  const ColorSpace& space = color_space(frame.primaries);
  for (std::vector<float>* light : {&layers.in_scatter, &layers.reflected, &layers.direct})
    bring_into_gamut(space, {1, 1, 1}, *light);
  for (std::vector<float>* share : {&layers.transmittance, &layers.albedo})
    bring_into_gamut(space, space.white, *share);
  for (std::size_t i = 0; i < layers.normal.size(); i += 3) {
    float* const n = &layers.normal[i];
    const float length = std::hypot(n[0], n[1], n[2]);
    for (int k = 0; k < 3; ++k) n[k] = length > 0 ? n[k] / length : 0;
  }
  return layers;
}

void add_directions(const Camera& camera, Frame& frame) {
  const ViewBasis basis = view_basis(camera);
  const double tall = std::tan(0.5 * camera.vertical_fov);
  const double wide = tall * frame.width / frame.height;
  const auto pixels = static_cast<std::size_t>(frame.width) * frame.height;
  frame.view_zenith_deg.resize(pixels);
  frame.view_azimuth_deg.resize(pixels);
  tbb::parallel_for(0, frame.height, [&](int y) {
    const double v = tall * (1 - (2 * y + 1.0) / frame.height);
    for (int x = 0; x < frame.width; ++x) {
      const double u = wide * ((2 * x + 1.0) / frame.width - 1);
      const glm::dvec3 ray = basis.forward + u * basis.right + v * basis.up;
      const double zenith = std::atan2(std::sqrt(ray.x * ray.x + ray.y * ray.y), ray.z);
      const std::size_t i = static_cast<std::size_t>(y) * frame.width + x;
      frame.view_zenith_deg[i] = static_cast<float>(kDegreesPerRadian * zenith);
      frame.view_azimuth_deg[i] = static_cast<float>(kDegreesPerRadian * std::atan2(-ray.y, ray.x));
    }
  });
}

}  // namespace skyfit
