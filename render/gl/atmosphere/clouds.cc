// SPDX-License-Identifier: Apache-2.0
#include "render/gl/atmosphere/clouds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/gl/context/uniform_block.h"
#include "render/gl/terrain/noise.h"

namespace skyfit {
namespace {

constexpr int kSide = 64, kLevels = 7;
static_assert(1 << (kLevels - 1) == kSide);
constexpr double kDeviation = 1.0 / 6;
// Of the sum of four octaves with the weights of clouds.glsl.
const double kSumDeviation =
    kDeviation * std::sqrt(0.30 * 0.30 + 0.40 * 0.40 + 0.22 * 0.22 + 0.08 * 0.08);
constexpr double kMiddleOfEdge = 0.025;  // of the smoothstep in clouds.glsl, above its threshold

// Fractal, repeating, mean 1/2, deviation 1/6.
std::vector<std::uint16_t> noise_texels() {
  std::vector<double> values;
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const glm::dvec3 p = glm::dvec3(x, y, z) / double{kSide};
        double sum = 0, amplitude = 1;
        for (int period = 3; period <= 24; period *= 2) {
          sum += amplitude * periodic_gradient_noise(p * double(period), period);
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
    const double normal = 0.5 + kDeviation * (value - mean) / std::sqrt(square);
    texels.push_back(static_cast<std::uint16_t>(std::lround(65535 * std::clamp(normal, 0.0, 1.0))));
  }
  return texels;
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

Clouds::Clouds() {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_3D, 1, &id);
  noise_ = GlTexture(id);
  glTextureStorage3D(id, kLevels, GL_R16, kSide, kSide, kSide);
  glTextureSubImage3D(id, 0, 0, 0, 0, kSide, kSide, kSide, GL_RED, GL_UNSIGNED_SHORT,
                      noise_texels().data());
  glGenerateTextureMipmap(id);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void Clouds::bind(const CloudLayer& clouds, GLuint program, GLuint unit,
                  UniformBuffers& buffers) const {
  glBindTextureUnit(unit, noise_.id());
  UniformBlock block(program, "Clouds");
  block.set("cloud_km", 1e-3 * clouds.altitude_m);
  block.set("cloud_opacity", clouds.opacity);
  block.set("cloud_threshold", 0.5 + kSumDeviation * exceeded_by(clouds.cover) - kMiddleOfEdge);
  block.bind(buffers);
}

}  // namespace skyfit
