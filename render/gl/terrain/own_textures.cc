// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/own_textures.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <span>
#include <stdexcept>

#include "model/photometry/srgb_transfer.h"
#include "render/gl/passes/site_axes.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

// As in own_materials.glsl: the shader knows places but for this many repeats.
constexpr double kRepeats = 64;
// Pictures lie along the axes of the middle of a field of the globe of so many degrees.
constexpr double kFieldDegrees = 10;
constexpr float kSteepest = 8;  // slope of a relief

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

[[noreturn]] void fail_to_read(const fs::path& file, const std::string& message) {
  fail(file, "cannot be read: " + message.substr(0, message.find('\n')));
}

// Red, green and blue, as they are coded, 0..1.
OwnPicture read_picture(const fs::path& file) {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(file.string(), &hints);
  if (!input) fail_to_read(file, OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width != spec.height || spec.width < kSmallestOwnSide || spec.width > kLargestOwnSide)
    fail(file, fmt::format("{} x {} pixels: expected a square of {} to {} on a side", spec.width,
                           spec.height, kSmallestOwnSide, kLargestOwnSide));
  if (spec.nchannels < 3)
    fail(file, fmt::format("{} channel{}: expected red, green and blue", spec.nchannels,
                           spec.nchannels == 1 ? "" : "s"));
  if (spec.format != OIIO::TypeDesc::UINT8 && spec.format != OIIO::TypeDesc::UINT16)
    fail(file,
         fmt::format("values of type {}: expected 8 or 16 bits a channel", spec.format.c_str()));
  OwnPicture picture{spec.width, {}};
  picture.texels.resize(std::size_t{3} * spec.width * spec.height);
  const bool done = input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, picture.texels.data());
  const std::string message = input->geterror();
  if (!done || !message.empty()) fail_to_read(file, message);
  return picture;
}

// What `of` makes of each texel of three channels.
template <std::size_t kChannels, class Of>
OwnPicture converted(const OwnPicture& picture, const Of& of) {
  OwnPicture result{picture.side, {}};
  const std::size_t count = picture.texels.size() / 3;
  result.texels.resize(kChannels * count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const float* p = &picture.texels[3 * i];
    const std::array<float, kChannels> texel = of(glm::vec3(p[0], p[1], p[2]), i);
    std::ranges::copy(texel, result.texels.begin() + static_cast<std::ptrdiff_t>(kChannels * i));
  });
  return result;
}

GlTexture texture_of(const OwnPicture& picture, GLenum stored, GLenum channels) {
  GLuint id = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &id);
  GlTexture texture(id);
  const int levels = 1 + static_cast<int>(std::log2(picture.side));
  glTextureStorage2D(id, levels, stored, picture.side, picture.side);
  glTextureSubImage2D(id, 0, 0, 0, picture.side, picture.side, channels, GL_FLOAT,
                      picture.texels.data());
  glGenerateTextureMipmap(id);
  glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

// Of the channels that it has, 0 of the others.
glm::vec4 mean_of(const OwnPicture& picture) {
  const std::size_t texels = std::size_t(picture.side) * static_cast<std::size_t>(picture.side);
  const std::size_t channels = picture.texels.size() / texels;
  glm::dvec4 sum(0);
  for (std::size_t i = 0; i < picture.texels.size(); ++i)
    sum[static_cast<int>(i % channels)] += picture.texels[i];
  return glm::vec4(sum / static_cast<double>(texels));
}

// East, north and up in the middle of the field of the globe that holds a place.
glm::dmat3 field_axes(const glm::dvec3& place) {
  const auto middle = [](double angle) {
    constexpr double kField = kFieldDegrees * std::numbers::pi / 180;
    return (std::floor(angle / kField) + 0.5) * kField;
  };
  const double latitude = std::asin(std::clamp(place.z / glm::length(place), -1.0, 1.0));
  // The sun in the east is along the frame's x axis, and its y axis points north.
  const SiteAxes axes = site_axes({middle(std::min(latitude, std::numbers::pi / 2 - 1e-9)),
                                   middle(std::atan2(place.y, place.x)), std::numbers::pi / 2});
  return {axes.x, axes.y, axes.z};
}

}  // namespace

OwnPicture read_own_color(const fs::path& file, const ColorReflectance& colors) {
  return converted<4>(read_picture(file), [&](const glm::vec3& coded, std::size_t) {
    const NodeValues value =
        colors.at({srgb_decoded(coded.x), srgb_decoded(coded.y), srgb_decoded(coded.z)});
    return std::array{static_cast<float>(value[0]), static_cast<float>(value[1]),
                      static_cast<float>(value[2]), static_cast<float>(value[3])};
  });
}

OwnPicture read_own_slopes(const fs::path& file) {
  const OwnPicture picture = read_picture(file);
  const auto side = static_cast<std::size_t>(picture.side);
  for (std::size_t i = 0; i < side * side; ++i) {
    // A picture of colours is not one of normals, which point out of the surface.
    if (picture.texels[3 * i + 2] <= 0.5f)
      fail(file, fmt::format("blue is {:.3g} of 1 in column {} of row {}: expected normals, whose "
                             "blue is above 0.5",
                             picture.texels[3 * i + 2], i % side, i / side));
  }
  return converted<2>(picture, [](const glm::vec3& coded, std::size_t) {
    const float up = 2 * coded.z - 1;  // above 0
    const auto slope = [up](float value) {
      const float along = 2 * value - 1;
      // Half of a step of 8 bits beside the middle is level.
      if (std::abs(along) <= 1.01f / 255) return 0.0f;
      return std::clamp(-along / up, -kSteepest, kSteepest);
    };
    return std::array{slope(coded.x), slope(coded.y)};
  });
}

OwnTextures::OwnTextures(const OwnMaterial& soil, const OwnMaterial& rock,
                         const ColorReflectance& colors)
    : soil_(soil), rock_(rock), textures_(4), means_(4, glm::vec4(0)) {
  struct Picture {
    const fs::path& file;
    const char *field, *define;
  };
  const std::array<Picture, 4> pictures = {{{soil_.color, "soil.color", "OWN_SOIL_COLOR"},
                                            {soil_.normal, "soil.normal", "OWN_SOIL_RELIEF"},
                                            {rock_.color, "rock.color", "OWN_ROCK_COLOR"},
                                            {rock_.normal, "rock.normal", "OWN_ROCK_RELIEF"}}};
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const auto& [file, field, define] = pictures[i];
    if (file.empty()) continue;
    const bool is_color = i % 2 == 0;
    try {
      const OwnPicture picture = is_color ? read_own_color(file, colors) : read_own_slopes(file);
      textures_[i] =
          texture_of(picture, is_color ? GL_RGBA16 : GL_RG16F, is_color ? GL_RGBA : GL_RG);
      means_[i] = mean_of(picture);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{} ({})", error.what(), field));
    }
    defines_.emplace_back(define);
  }
  if (!defines_.empty()) defines_.emplace_back("OWN_MATERIALS");
}

void OwnTextures::bind(const glm::dvec3& camera, GLuint program, GLuint unit,
                       UniformBuffers& buffers) const {
  if (defines_.empty()) return;
  for (const GlTexture& texture : textures_) glBindTextureUnit(unit++, texture.id());
  const glm::dmat3 axes = field_axes(camera);
  std::vector<glm::vec4> phases;
  for (const double repeat : {soil_.near_m, soil_.far_m, rock_.near_m, rock_.far_m}) {
    const glm::dvec3 repeats = glm::transpose(axes) * camera / repeat;
    phases.emplace_back(glm::vec3(kRepeats * glm::fract(repeats / kRepeats)),
                        static_cast<float>(1e3 / repeat));
  }
  UniformBlock block(program, "OwnMaterials");
  block.set("field_axes", glm::mat3(axes));
  block.set("own_repeats", std::span<const glm::vec4>(phases));
  block.set("own_means", std::span<const glm::vec4>(means_));
  block.bind(buffers);
}

}  // namespace skyfit
