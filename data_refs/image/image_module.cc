// SPDX-License-Identifier: Apache-2.0
#include "data_refs/image/image_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace skyfit::refs {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& error) {
  throw std::runtime_error(
      fmt::format("{}: cannot be read: {}", file.string(), error.substr(0, error.find('\n'))));
}

// The whole display window; what the file does not hold of it is not a number.
Image within_display_window(const OIIO::ImageSpec& spec, std::vector<float> stored) {
  Image image{spec.full_width, spec.full_height, spec.channelnames, {}, {}};
  if (spec.x == spec.full_x && spec.y == spec.full_y && spec.width == spec.full_width &&
      spec.height == spec.full_height) {
    image.pixels = std::move(stored);
    return image;
  }
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  image.pixels.assign(
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * channels,
      std::numeric_limits<float>::quiet_NaN());
  for (int row = 0; row < spec.height; ++row) {
    for (int column = 0; column < spec.width; ++column) {
      const int y = spec.y + row - spec.full_y, x = spec.x + column - spec.full_x;
      if (x < 0 || y < 0 || x >= image.width || y >= image.height) continue;
      std::copy_n(&stored[(static_cast<std::size_t>(row) * spec.width + column) * channels],
                  channels,
                  &image.pixels[(static_cast<std::size_t>(y) * image.width + x) * channels]);
    }
  }
  return image;
}

void expect_one_flat_picture(OIIO::ImageInput& input, const std::filesystem::path& file) {
  const OIIO::ImageSpec& spec = input.spec();
  if (spec.depth > 1 || spec.deep) fail(file, "expected a flat image");
  if (spec.full_width < 1 || spec.full_height < 1) fail(file, "expected a display window");
  constexpr std::size_t kMostValues = std::size_t{1} << 30;
  constexpr std::size_t kMostWithout = std::size_t{1} << 26;  // pixels that the file does not hold
  const auto channels = static_cast<std::size_t>(std::max(spec.nchannels, 1));
  const std::size_t stored = spec.image_pixels();
  const auto shown =
      static_cast<std::size_t>(spec.full_width) * static_cast<std::size_t>(spec.full_height);
  if (std::max(stored, shown) > kMostValues / channels) fail(file, "expected at most 2^30 values");
  if (shown > stored + kMostWithout)
    fail(file, fmt::format("{} x {} pixels in the display window, {} of them stored: expected at "
                           "most 2^26 without",
                           spec.full_width, spec.full_height, stored));
  const float aspect = spec.get_float_attribute("PixelAspectRatio", 1);
  if (std::abs(aspect - 1) > 1e-3f)
    fail(file, fmt::format("PixelAspectRatio {:.6g}: expected square pixels, 1", aspect));
  if (std::string_view(input.format_name()) == "openexr" && input.seek_subimage(1, 0))
    fail(file, "expected one part, the picture, got several");
  input.seek_subimage(0, 0);
}

Image read(const std::filesystem::path& file, const std::string& bytes) {
  OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
  std::unique_ptr<OIIO::ImageInput> input =
      OIIO::ImageInput::open(file.string(), nullptr, bytes.empty() ? nullptr : &memory);
  if (!input) fail(file, OIIO::geterror());
  expect_one_flat_picture(*input, file);
  const OIIO::ImageSpec& spec = input->spec();
  std::vector<float> pixels(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  const bool whole =
      input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, pixels.data());
  // Of a truncated TIFF or JPEG the reader only leaves a message.
  const std::string error = input->geterror();
  if (!whole || !error.empty())
    fail(file, std::string_view(input->format_name()) == "hdr"
                   ? error +
                         " (cut off, or of the run-length code of before 1991, which ra_rgbe -r "
                         "brings up to date)"
                   : error);
  Image image = within_display_window(spec, std::move(pixels));
  Chromaticities chromaticities;
  const OIIO::TypeDesc type(OIIO::TypeDesc::FLOAT, static_cast<int>(chromaticities.size()));
  if (spec.getattribute("chromaticities", type, chromaticities.data()))
    image.chromaticities = chromaticities;
  image.environment = std::string(spec.get_string_attribute("textureformat"));
  image.white_luminance = spec.get_float_attribute("whiteLuminance", 0);
  return image;
}

}  // namespace
}  // namespace skyfit::refs

extern "C" __attribute__((visibility("default"))) const void* skyfit_image_module() {
  static constexpr skyfit::refs::ImageModule kModule = {skyfit::refs::ImageModule::kRevision,
                                                        skyfit::refs::read};
  return &kModule;
}
