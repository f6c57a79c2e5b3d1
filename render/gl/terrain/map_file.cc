// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/map_file.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace skyfit {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostPixels = 1'000'000'000;
constexpr int kFewestRows = 4;  // the reach of a smooth sample

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

[[noreturn]] void fail_to_read(const fs::path& file, const std::string& message) {
  fail(file, "cannot be read: " + message.substr(0, message.find('\n')));
}

std::unique_ptr<OIIO::ImageInput> opened(const fs::path& file) {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);  // transparent ground keeps its colour
  auto input = OIIO::ImageInput::open(file.string(), &hints);
  if (!input) fail_to_read(file, OIIO::geterror());
  return input;
}

std::int64_t columns(const MapFile& map) {
  return std::int64_t{map.rows} * (map.layout == MapLayout::kCube ? 6 : 2);
}

template <class T>
void read(const MapFile& map, int channels, OIIO::TypeDesc type, std::vector<T>& texels) {
  const auto input = opened(map.file);
  texels.resize(static_cast<std::size_t>(columns(map)) * map.rows * channels);
  // Half a TIFF or JPEG file is success to OpenImageIO, with a message.
  const bool done = input->read_image(0, 0, 0, channels, type, texels.data());
  const std::string message = input->geterror();
  if (!done || !message.empty()) fail_to_read(map.file, message);
}

}  // namespace

MapFile inspect_map(const fs::path& file, int channels) {
  const auto input = opened(file);
  const OIIO::ImageSpec& spec = input->spec();
  const auto found = fmt::format("{} x {} pixels", spec.width, spec.height);
  if (std::int64_t{spec.width} * spec.height > kMostPixels)
    fail(file, found + ": expected at most 1e9");
  const bool cube = std::int64_t{spec.width} == std::int64_t{6} * spec.height;
  if (!cube && std::int64_t{spec.width} != std::int64_t{2} * spec.height) {
    fail(file, found + ": expected twice as wide as high, or six times for the faces of a cube" +
                   (channels == 1 ? "; --dem reads the heights of a region" : ""));
  }
  if (spec.height < kFewestRows)
    fail(file, fmt::format("{}: expected at least {} rows", found, kFewestRows));
  if (spec.nchannels < channels) {
    fail(file, fmt::format("{} channel{}: expected red, green and blue", spec.nchannels,
                           spec.nchannels == 1 ? "" : "s"));
  }
  const TexelType type = spec.format == OIIO::TypeDesc::UINT8    ? TexelType::kByte
                         : spec.format == OIIO::TypeDesc::UINT16 ? TexelType::kShort
                                                                 : TexelType::kFloat;
  return {file, cube ? MapLayout::kCube : MapLayout::kEquirectangular, spec.height, type};
}

void read_map(const MapFile& map, int channels, std::vector<std::uint8_t>& texels) {
  read(map, channels, OIIO::TypeDesc::UINT8, texels);
}

void read_map(const MapFile& map, int channels, std::vector<std::uint16_t>& texels) {
  read(map, channels, OIIO::TypeDesc::UINT16, texels);
}

void read_map(const MapFile& map, int channels, std::vector<float>& texels) {
  read(map, channels, OIIO::TypeDesc::FLOAT, texels);
  const auto bad = std::ranges::find_if(texels, [](float value) { return !std::isfinite(value); });
  if (bad == texels.end()) return;
  const std::int64_t pixel = (bad - texels.begin()) / channels;
  fail(map.file, fmt::format("{} in column {} of row {}: expected finite values", *bad,
                             pixel % columns(map), pixel / columns(map)));
}

}  // namespace skyfit
