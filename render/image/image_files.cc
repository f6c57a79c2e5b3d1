// SPDX-License-Identifier: Apache-2.0
#include "render/image/image_files.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "model/base/npy_file.h"
#include "model/base/whole_file.h"
#include "render/image/caption.h"
#include "render/image/gamut.h"
#include "render/image/map_texture.h"
#include "render/image/tone.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

// The stream is ours, because OpenImageIO does not look whether its last bytes reach the disk.
void write_image(const fs::path& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                 const void* pixels) {
  const auto fail = [&](const std::string& reason) {
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", file.string(),
                                         reason.substr(0, reason.find('\n'))));
  };
  std::FILE* const stream = std::fopen(file.c_str(), "wb");
  if (stream == nullptr) fail(std::strerror(errno));
  std::string error;
  {
    OIIO::Filesystem::IOFile target(stream, OIIO::Filesystem::IOProxy::Write);
    const auto output = OIIO::ImageOutput::create(file.string(), &target);
    if (!output) {
      error = OIIO::geterror();
    } else if (!output->open(file.string(), spec) || !output->write_image(type, pixels) ||
               !output->close()) {
      error = output->geterror();
      if (error.empty()) error = "OpenImageIO gives no reason";
    }
  }
  errno = 0;
  const bool flushed = std::fflush(stream) == 0 && std::ferror(stream) == 0;
  const bool closed = std::fclose(stream) == 0;
  if (!flushed || !closed) error = errno != 0 ? std::strerror(errno) : "not all of it was written";
  if (!error.empty()) fail(error);
}

void write_whole(const fs::path& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                 const void* pixels) {
  WholeFiles whole({file});
  whole.make(0, [&](const fs::path& part) { write_image(part, spec, type, pixels); });
  whole.publish();
}

// [pixel][3] of the primaries from X, Y, Z.
std::vector<float> in_primaries(const std::vector<float>& xyz, const ColorSpace& space) {
  std::vector<float> result(xyz.size());
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    ColorChannels color{};
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < 3; ++k)
        color[c] += space.from_xyz[c][k] * static_cast<double>(xyz[i + k]);
    }
    const ColorChannels held = into_gamut(color, static_cast<double>(xyz[i + 1]), space);
    for (std::size_t c = 0; c < 3; ++c) result[i + c] = static_cast<float>(held[c]);
  }
  return result;
}

// An 8-bit picture.
struct Bytes {
  int width, height;
  std::vector<std::uint8_t> rgb;  // [pixel][3]

  void paste(const std::vector<std::uint8_t>& part, int part_width, int left, int top) {
    const std::size_t row = 3 * static_cast<std::size_t>(part_width);
    for (std::size_t from = 0; from < part.size(); from += row, ++top) {
      const auto begin = part.begin() + static_cast<std::ptrdiff_t>(from);
      std::copy(begin, begin + static_cast<std::ptrdiff_t>(row),
                rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(top) * width + left));
    }
  }
};

void write_png_picture(const Bytes& picture,
                       const std::vector<std::pair<std::string, std::string>>& metadata,
                       const fs::path& file) {
  OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  // Noise hardly shrinks: half the time of 6, 5 % larger.
  spec.attribute("png:compressionLevel", 3);
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  write_whole(file, spec, OIIO::TypeDesc::UINT8, picture.rgb.data());
}

// [pixel][a + b] of [pixel][a] and [pixel][b].
std::vector<float> interleaved(const std::vector<float>& first, std::size_t a,
                               const std::vector<float>& second, std::size_t b) {
  std::vector<float> result;
  result.reserve(first.size() + second.size());
  for (auto p = first.begin(), q = second.begin(); p != first.end();) {
    for (std::size_t k = 0; k < a; ++k) result.push_back(*p++);
    for (std::size_t k = 0; k < b; ++k) result.push_back(*q++);
  }
  return result;
}

}  // namespace

void write_exr_file(const Frame& frame, const fs::path& file) {
  struct Channel {
    std::string name;
    const std::vector<float>& values;
    std::size_t first, stride;
  };
  std::vector<Channel> channels;
  const auto add = [&](const std::string& layer, const std::vector<float>& values,
                       std::string_view suffixes) {
    for (std::size_t k = 0; k < suffixes.size(); ++k) {
      channels.push_back({layer + suffixes[k], values, k, suffixes.size()});
    }
  };
  add("", frame.rgb, "RGB");
  add("luminance.", frame.luminance, "Y");
  channels.push_back({"view.zenith_deg", frame.view_zenith_deg, 0, 1});
  channels.push_back({"view.azimuth_deg", frame.view_azimuth_deg, 0, 1});
  const auto depth = static_cast<int>(channels.size());
  add("", frame.depth_m, "Z");
  if (const auto& layers = frame.layers) {
    add("inscatter.", layers->in_scatter, "RGB");
    add("reflected.", layers->reflected, "RGB");
    add("direct.", layers->direct, "RGB");
    add("transmittance.", layers->transmittance, "RGB");
    add("normal.", layers->normal, "XYZ");
    add("albedo.", layers->albedo, "RGB");
  }
  if (const auto& light = frame.polarisation) {
    add("stokes.", light->q, "Q");
    add("stokes.", light->u, "U");
    channels.push_back({"dolp", light->degree, 0, 1});
    channels.push_back({"aolp", light->angle_deg, 0, 1});
  }
  OIIO::ImageSpec spec(frame.width, frame.height, static_cast<int>(channels.size()),
                       OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const Channel& channel : channels) spec.channelnames.push_back(channel.name);
  spec.z_channel = depth;
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                 color_space(frame.primaries).chromaticities.data());
  for (const auto& [name, value] : frame.metadata) spec.attribute(name, value);
  const std::size_t pixels = frame.luminance.size();
  std::vector<float> packed(pixels * channels.size());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto& [name, values, first, stride] = channels[c];
    for (std::size_t i = 0; i < pixels; ++i)
      packed[i * channels.size() + c] = values[i * stride + first];
  }
  write_whole(file, spec, OIIO::TypeDesc::FLOAT, packed.data());
}

void write_map_file(const SkyMap& map, Primaries primaries, const fs::path& file) {
  const std::size_t colors = map.channels.size(), layers = map.layers.size();
  OIIO::ImageSpec spec(map.width, map.height, static_cast<int>(colors + layers),
                       OIIO::TypeDesc::FLOAT);
  spec.channelnames = map.channels;
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  for (const auto& [name, value] : map.metadata) spec.attribute(name, value);
  std::vector<float> pixels = map.pixels;
  if (map.is_xyz) {
    const ColorSpace& space = color_space(primaries);
    spec.channelnames = {"R", "G", "B"};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                   space.chromaticities.data());
    pixels = in_primaries(map.pixels, space);
    if (file.extension() == ".ktx2") return write_map_texture(map, pixels, primaries, file);
  }
  spec.channelnames.insert(spec.channelnames.end(), map.layers.begin(), map.layers.end());
  if (layers > 0) pixels = interleaved(pixels, colors, map.layer_values, layers);
  if (file.extension() == ".npy")
    return write_npy(file,
                     {static_cast<std::size_t>(map.height), static_cast<std::size_t>(map.width),
                      colors + layers},
                     pixels);
  write_whole(file, spec, OIIO::TypeDesc::FLOAT, pixels.data());
}

void write_table_file(const EncodedTable& table, const fs::path& file) {
  const OIIO::TypeDesc type =
      table.precision == TablePrecision::kHalf ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
  OIIO::ImageSpec spec(table.width, table.height * table.depth, 4, type);
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  write_whole(file, spec, type, table.texels.data());
}

void write_png_file(const Frame& frame, const fs::path& file, const ToneOptions& tone) {
  write_png_picture({frame.width, frame.height, tone_mapped(frame, tone)}, frame.metadata, file);
}

void write_grid_file(const FrameGrid& grid, const fs::path& file) {
  const Frame& first = grid.frames.at(0);
  const auto columns = static_cast<std::size_t>(grid.columns);
  const CaptionBands bands = caption_bands(grid.captions, first.width, first.height);
  const int between = std::max(bands.height, kGridGap);
  const int rows = static_cast<int>(grid.frames.size() / columns);
  Bytes picture{grid.columns * (first.width + kGridGap) - kGridGap,
                rows * (first.height + between) - between + bands.height,
                {}};
  picture.rgb.resize(3 * static_cast<std::size_t>(picture.width) * picture.height);
  for (std::size_t i = 0; i < grid.frames.size(); ++i) {
    const int top = static_cast<int>(i / columns) * (first.height + between);
    const int left = static_cast<int>(i % columns) * (first.width + kGridGap);
    picture.paste(tone_mapped(grid.frames[i], grid.tones.at(i)), first.width, left, top);
    picture.paste(bands.rgb[i], first.width, left, top + first.height);
  }
  auto metadata = first.metadata;
  metadata.insert(metadata.end(), grid.metadata.begin(), grid.metadata.end());
  write_png_picture(picture, metadata, file);
}

void write_png_texels(std::span<const std::uint8_t> rgba, int width, int height,
                      const fs::path& file) {
  OIIO::ImageSpec spec(width, height, 4, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  write_whole(file, spec, OIIO::TypeDesc::UINT8, rgba.data());
}

}  // namespace skyfit
