// SPDX-License-Identifier: Apache-2.0
#include "render/gl/passes/resolve.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "model/numerics/angles.h"
#include "render/gl/atmosphere/atmosphere_pass.h"
#include "render/gl/passes/view_basis.h"
#include "render/image/gamut.h"
#include "render/image/silhouette.h"

namespace skyfit {
namespace {

// Calls f(pixel, sample, values) with the `channels` values of every sample of a target, those of a
// pixel in the same order whatever the threads; OpenGL's rows run upward, those of samples and of a
// frame downward. The target is read in bands: as a whole it may be larger than all else that a
// frame needs.
template <class F>
void for_numbered_samples(const FrameGraph& graph, const std::string& target, GLenum format,
                          int channels, const Frame& frame, int samples_per_side, F&& f) {
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
        const float* value = &values[static_cast<std::size_t>(y) * columns * channels];
        const std::size_t sample =
            static_cast<std::size_t>((frame.height - low) * samples_per_side - 1 - y) * columns;
        for (std::size_t x = 0; x < columns; ++x, value += channels)
          f(first + x / samples_per_side, sample + x, value);
      }
    });
  }
}

// Without the sample's number.
template <class F>
void for_samples(const FrameGraph& graph, const std::string& target, GLenum format, int channels,
                 const Frame& frame, int samples_per_side, F&& f) {
  for_numbered_samples(
      graph, target, format, channels, frame, samples_per_side,
      [&](std::size_t pixel, std::size_t, const float* values) { f(pixel, values); });
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

// The pixels on the line between sky and ground, which is smoothed from sample to sample.
class Edges {
 public:
  Edges(const Frame& frame, int samples_per_side)
      : width_(frame.width),
        side_(static_cast<std::size_t>(samples_per_side)),
        columns_(side_ * width_),
        is_sky_(columns_ * side_ * frame.height),
        index_(width_ * frame.height, kNone) {}

  // By several threads.
  void set(std::size_t sample, bool is_sky) { is_sky_[sample] = is_sky ? 1 : 0; }

  // After all samples are set.
  void find() {
    std::vector<std::uint8_t> sky(index_.size(), 0);
    for (std::size_t row = 0; row * columns_ < is_sky_.size(); ++row) {
      const std::uint8_t* sample = &is_sky_[row * columns_];
      std::uint8_t* count = &sky[row / side_ * width_];
      for (std::size_t x = 0; x < width_; ++x, ++count) {
        for (std::size_t i = 0; i < side_; ++i)
          *count = static_cast<std::uint8_t>(*count + *sample++);
      }
    }
    const auto part_of = [&](std::size_t pixel) -> Part& {
      if (index_[pixel] == kNone) {
        index_[pixel] = static_cast<std::uint32_t>(parts_.size());
        parts_.push_back({pixel, pixel, double(sky[pixel]), {}, {}});
      }
      return parts_[index_[pixel]];
    };
    for (std::size_t pixel = 0; pixel < sky.size(); ++pixel) {
      if (sky[pixel] > 0 && sky[pixel] < side_ * side_) part_of(pixel);
    }
    for (const SilhouetteSample& at : silhouette(is_sky_, static_cast<int>(columns_),
                                                 static_cast<int>(is_sky_.size() / columns_))) {
      Part& part = part_of(pixel_of(at.sample));
      part.beside = pixel_of(at.beside);
      part.sky_samples += is_sky_[at.sample] != 0 ? -at.share : at.share;
    }
  }

  // After find(), for every sample; by several threads, of a pixel by one.
  void add(std::size_t pixel, std::size_t sample, const float* light) {
    if (index_[pixel] == kNone) return;
    Part& part = parts_[index_[pixel]];
    Mean& mean = is_sky_[sample] != 0 ? part.sky : part.ground;
    for (std::size_t k = 0; k < 3; ++k) mean.sum[k] += light[k];
    mean.count += 1;
  }

  // After all samples are added; the frame's light is resolved. What a pixel has no sample of has
  // the light of the pixel across the line.
  std::vector<EdgePixel> pixels(const Frame& frame) const {
    const auto light = [&](const Part& part, Mean Part::*side) {
      const std::uint32_t across = index_[part.beside];
      const Mean& mean =
          (part.*side).count > 0 || across == kNone ? part.*side : parts_[across].*side;
      const float* pixel = &frame.rgb[3 * part.beside];
      std::array<float, 3> rgb = {pixel[0], pixel[1], pixel[2]};
      if (mean.count > 0)
        for (std::size_t k = 0; k < 3; ++k) rgb[k] = std::max(mean.sum[k] / mean.count, 0.0f);
      return rgb;
    };
    std::vector<EdgePixel> found;
    for (const Part& part : parts_) {
      const double share = part.sky_samples / static_cast<double>(side_ * side_);
      found.push_back({part.pixel, static_cast<float>(std::clamp(share, 0.0, 1.0)),
                       light(part, &Part::sky), light(part, &Part::ground)});
    }
    std::ranges::sort(found, {}, &EdgePixel::pixel);
    return found;
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;
  struct Mean {
    std::array<float, 3> sum{};
    float count = 0;
  };
  struct Part {
    std::size_t pixel, beside;
    double sky_samples;
    Mean sky, ground;
  };

  std::size_t pixel_of(std::size_t sample) const {
    return sample / columns_ / side_ * width_ + sample % columns_ / side_;
  }

  std::size_t width_, side_, columns_;
  std::vector<std::uint8_t> is_sky_;  // [sample]
  std::vector<std::uint32_t> index_;  // [pixel] in parts_
  std::vector<Part> parts_;
};

}  // namespace

void resolve_light(const FrameGraph& graph, int samples_per_side, Frame& frame) {
  const auto pixels = static_cast<std::size_t>(frame.width) * frame.height;
  const float part = 1.0f / static_cast<float>(samples_per_side * samples_per_side);
  frame.depth_m.assign(pixels, std::numeric_limits<float>::infinity());
  Edges edges(frame, samples_per_side);
  for_numbered_samples(graph, "distance", GL_RED, 1, frame, samples_per_side,
                       [&](std::size_t pixel, std::size_t sample, const float* kilometres) {
                         frame.depth_m[pixel] =
                             std::min(frame.depth_m[pixel], 1e3f * kilometres[0]);
                         edges.set(sample, std::isinf(kilometres[0]));
                       });
  edges.find();
  frame.rgb.assign(3 * pixels, 0);
  frame.luminance.assign(pixels, 0);
  for_numbered_samples(graph, "light", GL_RGBA, 4, frame, samples_per_side,
                       [&](std::size_t pixel, std::size_t sample, const float* light) {
                         for (std::size_t k = 0; k < 3; ++k)
                           frame.rgb[3 * pixel + k] += part * light[k];
                         frame.luminance[pixel] += part * light[3];
                         edges.add(pixel, sample, light);
                       });
  bring_into_gamut(color_space(frame.primaries), {1, 1, 1}, frame.rgb);
  resolve_discs(graph, samples_per_side, frame);
  frame.edges = edges.pixels(frame);
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
  const double pixel = 4 * tall * wide / static_cast<double>(pixels);  // in the plane at distance 1
  for (DiscPixel& disc : frame.discs) {
    const auto x = static_cast<int>(disc.pixel % frame.width),
               y = static_cast<int>(disc.pixel / frame.width);
    const double u = wide * ((2 * x + 1.0) / frame.width - 1),
                 v = tall * (1 - (2 * y + 1.0) / frame.height);
    disc.solid_angle_sr = static_cast<float>(pixel / std::pow(1 + u * u + v * v, 1.5));
  }
}

}  // namespace skyfit
