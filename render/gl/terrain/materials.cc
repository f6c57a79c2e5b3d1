// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/materials.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <stdexcept>

#include "model/base/input_file.h"
#include "render/gl/context/uniform_block.h"
#include "render/gl/terrain/noise.h"
#include "render/image/image_files.h"

namespace skyfit {
namespace {

constexpr int kSide = kMaterialSide;
// m: a unit of each texture.
constexpr double kGrainPeriod = 1.5, kCragPeriod = 190, kFarCragPeriod = 1270;
constexpr int kLastLevel = 6;  // mipmap of one texel
static_assert(1 << kLastLevel == kSide);
constexpr int kFlatLevel = 5;  // the first mipmap that holds nothing but the mean
constexpr std::size_t kTexels = std::size_t{kSide} * kSide * kSide;

std::size_t texel(int x, int y, int z) {
  const auto wrap = [](int i) { return static_cast<std::size_t>((i + kSide) % kSide); };
  return (wrap(z) * kSide + wrap(y)) * kSide + wrap(x);
}

// Noise is 0 at its lattice's points, and ridges run through all of them: bent, the lattice does
// not show.
glm::dvec3 bent(const glm::dvec3& p) {
  constexpr int kPeriod = 4;
  constexpr double kStrength = 0.12;
  const glm::dvec3 q = p * double{kPeriod};
  const auto noise = [&](double shift) {
    return periodic_gradient_noise(q + glm::dvec3(shift), kPeriod);
  };
  return p + kStrength * glm::dvec3(noise(0.2), noise(1.4), noise(2.7));
}

double relief_of(Texture texture, const glm::dvec3& at) {
  const glm::dvec3 p = bent(at);
  double sum = 0, amplitude = 1;
  glm::dvec3 shift(0);
  for (int period = texture == Texture::kGrains ? 4 : 2; period <= kSide / 4; period *= 2) {
    shift += kOctaveShift;
    const double noise = periodic_gradient_noise(p * static_cast<double>(period) + shift, period);
    sum += amplitude * (texture == Texture::kGrains ? noise : 0.5 - std::abs(1.6 * noise));
    amplitude *= texture == Texture::kGrains ? 0.6 : 0.55;
  }
  return sum;
}

std::filesystem::path file_of(Texture texture, const std::filesystem::path& directory) {
  return directory / (texture == Texture::kGrains ? "grains.png" : "crags.png");
}

// The next mipmap. The weights 1, 3, 3, 1 along each axis leave less of the waves that two of its
// texels cannot tell from a lattice than the mean of two would.
std::vector<float> halved(std::span<const float> texels, int side) {
  const int half = side / 2;
  constexpr std::array<float, 4> kWeights = {1 / 8.0f, 3 / 8.0f, 3 / 8.0f, 1 / 8.0f};
  const auto wrap = [side](int i) { return static_cast<std::size_t>((i + side) % side); };
  std::vector<float> means;
  for (int z = 0; z < half; ++z) {
    for (int y = 0; y < half; ++y) {
      for (int x = 0; x < half; ++x) {
        std::array<float, 4> sum{};
        for (int tap = 0; tap < 64; ++tap) {
          const int i = tap & 3, j = tap >> 2 & 3, k = tap >> 4;
          const float weight = kWeights[static_cast<std::size_t>(i)] *
                               kWeights[static_cast<std::size_t>(j)] *
                               kWeights[static_cast<std::size_t>(k)];
          const std::size_t at =
              (wrap(2 * z + k - 1) * static_cast<std::size_t>(side) + wrap(2 * y + j - 1)) *
                  static_cast<std::size_t>(side) +
              wrap(2 * x + i - 1);
          for (std::size_t channel = 0; channel < 4; ++channel)
            sum[channel] += weight * texels[4 * at + channel];
        }
        means.insert(means.end(), sum.begin(), sum.end());
      }
    }
  }
  return means;
}

GlTexture solid_texture(const MaterialTexels& texels) {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_3D, 1, &id);
  GlTexture texture(id);
  glTextureStorage3D(id, kLastLevel + 1, GL_RGBA8, kSide, kSide, kSide);
  GLint level = 0;
  for (const MaterialTexels& mipmap : mipmaps_of(texels)) {
    const int side = kSide >> level;
    glTextureSubImage3D(id, level++, 0, 0, 0, side, side, side, GL_RGBA, GL_UNSIGNED_BYTE,
                        mipmap.data());
  }
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

MaterialTexels kept_texture(Texture texture, ContentCache& cache) {
  CacheKey key("texture");
  key.value(texture);
  MaterialTexels texels(4 * kTexels);
  const auto room = [&](std::size_t, std::uint64_t) {
    return std::as_writable_bytes(std::span(texels));
  };
  if (cache.find(key, room)) return texels;
  texels = make_texture(texture);
  cache.keep(key, {std::as_bytes(std::span(texels))});
  return texels;
}

}  // namespace

MaterialTexels make_texture(Texture texture) {
  std::vector<double> relief(kTexels);
  tbb::parallel_for(0, kSide, [&](int z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        relief[texel(x, y, z)] = relief_of(texture, glm::dvec3(x, y, z) / double{kSide});
      }
    }
  });
  double mean = 0, square = 0;
  for (const double value : relief) mean += value / kTexels;
  for (const double value : relief) square += (value - mean) * (value - mean) / kTexels;
  const double deviation = std::sqrt(square);
  // Brightness follows the relief: crests are lighter than hollows.
  const double contrast = texture == Texture::kGrains ? 0.16 : 0.22;
  double steepest = 0;
  const auto gradient = [&](int x, int y, int z) {
    return glm::dvec3(relief[texel(x + 1, y, z)] - relief[texel(x - 1, y, z)],
                      relief[texel(x, y + 1, z)] - relief[texel(x, y - 1, z)],
                      relief[texel(x, y, z + 1)] - relief[texel(x, y, z - 1)]);
  };
  MaterialTexels texels(4 * kTexels);
  for (int pass = 0; pass < 2; ++pass) {
    for (int z = 0; z < kSide; ++z) {
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const glm::dvec3 g = gradient(x, y, z);
          if (pass == 0) {
            steepest = std::max({steepest, std::abs(g.x), std::abs(g.y), std::abs(g.z)});
            continue;
          }
          const std::size_t i = texel(x, y, z);
          for (int k = 0; k < 3; ++k) {
            texels[4 * i + static_cast<std::size_t>(k)] =
                static_cast<std::uint8_t>(std::lround(127 + 127 * g[k] / steepest));
          }
          const double light = 1 + contrast * std::clamp((relief[i] - mean) / deviation, -3.0, 3.0);
          texels[4 * i + 3] = static_cast<std::uint8_t>(std::lround(127.5 * light));
        }
      }
    }
  }
  return texels;
}

std::vector<MaterialTexels> mipmaps_of(const MaterialTexels& texels) {
  std::vector<MaterialTexels> mipmaps = {texels};
  std::vector<float> values(texels.begin(), texels.end());
  for (int side = kSide; side > 1; side /= 2) {
    values = halved(values, side);
    MaterialTexels& rounded = mipmaps.emplace_back();
    for (const float value : values)
      rounded.push_back(static_cast<std::uint8_t>(std::lround(value)));
  }
  const MaterialTexels mean = mipmaps.back();
  for (std::size_t level = kFlatLevel; level < kLastLevel; ++level) {
    for (std::size_t i = 0; i < mipmaps[level].size(); ++i)
      mipmaps[level][i] = mean[i % mean.size()];
  }
  return mipmaps;
}

MaterialTexels load_texture(Texture texture, const std::filesystem::path& directory,
                            ContentCache* cache) {
  if (directory.empty())
    return cache != nullptr ? kept_texture(texture, *cache) : make_texture(texture);
  const std::filesystem::path file = file_of(texture, directory);
  if (!std::filesystem::exists(file)) {
    MaterialTexels texels = make_texture(texture);
    write_png_texels(texels, kSide, kSide * kSide, file);
    return texels;
  }
  require_regular_file(file, "a texture of the ground (PNG)", kMostImageBytes);
  OIIO::ImageSpec as_stored;
  as_stored.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(file.string(), &as_stored);
  if (!input)
    throw std::runtime_error(fmt::format("{}: cannot read: {}", file.string(), OIIO::geterror()));
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width != kSide || spec.height != kSide * kSide || spec.nchannels != 4) {
    throw std::runtime_error(
        fmt::format("{}: {} x {} pixels of {} channels: a texture has {} x {} of 4", file.string(),
                    spec.width, spec.height, spec.nchannels, kSide, kSide * kSide));
  }
  MaterialTexels texels(4 * kTexels);
  if (!input->read_image(0, 0, 0, 4, OIIO::TypeDesc::UINT8, texels.data())) {
    throw std::runtime_error(fmt::format("{}: cannot read: {}", file.string(), input->geterror()));
  }
  return texels;
}

std::vector<std::filesystem::path> made_texture_files(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  for (const Texture texture : {Texture::kGrains, Texture::kCrags}) {
    load_texture(texture, directory);
    files.push_back(file_of(texture, directory));
  }
  return files;
}

Materials::Materials(const std::filesystem::path& directory, ContentCache* cache)
    : grains_(solid_texture(load_texture(Texture::kGrains, directory, cache))),
      crags_(solid_texture(load_texture(Texture::kCrags, directory, cache))) {
  glGetTextureImage(grains_.id(), kLastLevel, GL_RGBA, GL_FLOAT, sizeof grain_mean_, &grain_mean_);
  glGetTextureImage(crags_.id(), kLastLevel, GL_RGBA, GL_FLOAT, sizeof crag_mean_, &crag_mean_);
}

double Materials::grainless_distance_m(double pixel_rad) {
  return kGrainPeriod / kSide * (1 << kFlatLevel) / pixel_rad;
}

void Materials::bind(const glm::dvec3& camera, GLuint program, GLuint unit,
                     UniformBuffers& buffers) const {
  glBindTextureUnit(unit, grains_.id());
  glBindTextureUnit(unit + 1, crags_.id());
  UniformBlock block(program, "Materials");
  block.set("grain_phase", glm::vec3(glm::fract(camera / kGrainPeriod)));
  block.set("grains_per_km", 1e3 / kGrainPeriod);
  block.set("crag_phase", glm::vec3(glm::fract(camera / kCragPeriod)));
  block.set("crags_per_km", 1e3 / kCragPeriod);
  block.set("far_crag_phase", glm::vec3(glm::fract(camera / kFarCragPeriod)));
  block.set("far_crags_per_km", 1e3 / kFarCragPeriod);
  block.set("grain_mean", grain_mean_);
  block.set("crag_mean", crag_mean_);
  block.bind(buffers);
}

}  // namespace skyfit
