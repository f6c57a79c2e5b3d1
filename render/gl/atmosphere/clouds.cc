// SPDX-License-Identifier: Apache-2.0
#include "render/gl/atmosphere/clouds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "render/gl/context/uniform_block.h"
#include "render/gl/terrain/noise.h"

namespace skyfit {
namespace {

constexpr int kSide = 64, kLevels = 7;
static_assert(1 << (kLevels - 1) == kSide);
#include "render/shaders/cloud_octaves.glsl"

// Of the octaves' mean with their weights.
double mean_deviation() {
  double squares = 0, sum = 0, weight = 1;
  for (int i = 0; i < kCloudOctaves; ++i) {
    squares += weight * weight;
    sum += weight;
    weight *= double{kCloudGain};
  }
  return double{kCloudDeviation} * std::sqrt(squares) / sum;
}

// The value that a share `part` of a normal distribution exceeds, in deviations from its mean.
double exceeded_by(double part) {
  double low = -8, high = 8;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > part ? low : high) = middle;
  }
  return low;
}

}  // namespace

std::vector<std::uint16_t> cloud_noise() {
  std::vector<double> values;
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const glm::dvec3 p = glm::dvec3(x, y, z) / double{kSide};
        double sum = 0, amplitude = 1;
        glm::dvec3 shift(0);
        for (int period = 3; period <= 24; period *= 2) {
          shift += kOctaveShift;
          sum += amplitude * periodic_gradient_noise(p * double(period) + shift, period);
          amplitude *= 0.55;
        }
        values.push_back(sum);
      }
    }
  }
  const auto count = static_cast<double>(values.size());
  double mean = 0, square = 0;
  for (const double value : values) mean += value / count;
  for (const double value : values) square += (value - mean) * (value - mean) / count;
  std::vector<std::uint16_t> texels;
  for (const double value : values) {
    const double normal = 0.5 + double{kCloudDeviation} * (value - mean) / std::sqrt(square);
    texels.push_back(static_cast<std::uint16_t>(std::lround(65535 * std::clamp(normal, 0.0, 1.0))));
  }
  return texels;
}

Clouds::Clouds() {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_3D, 1, &id);
  noise_ = GlTexture(id);
  glTextureStorage3D(id, kLevels, GL_R16, kSide, kSide, kSide);
  glTextureSubImage3D(id, 0, 0, 0, 0, kSide, kSide, kSide, GL_RED, GL_UNSIGNED_SHORT,
                      cloud_noise().data());
  glGenerateTextureMipmap(id);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void Clouds::bind(std::span<const CloudLayer> sheets, double eye_m, GLuint program, GLuint unit,
                  UniformBuffers& buffers) const {
  // A ray meets the sheets below the eye first, from the highest to the lowest, then, where it
  // rises again, those above, from the lowest to the highest.
  std::vector<CloudLayer> in_order(sheets.begin(), sheets.end());
  std::ranges::sort(in_order, {}, [eye_m](const CloudLayer& clouds) {
    const bool below = clouds.altitude_m < eye_m;
    return std::pair(!below, below ? -clouds.altitude_m : clouds.altitude_m);
  });
  std::vector<glm::vec4> values;
  for (const CloudLayer& clouds : in_order)
    values.emplace_back(1e-3 * clouds.altitude_m, clouds.opacity,
                        0.5 + mean_deviation() * exceeded_by(clouds.cover), 0);
  glBindTextureUnit(unit, noise_.id());
  UniformBlock block(program, "Clouds");
  block.set("cloud_sheets", std::span<const glm::vec4>(values));
  block.bind(buffers);
}

}  // namespace skyfit
