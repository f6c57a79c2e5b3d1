// SPDX-License-Identifier: Apache-2.0
#include "data_refs/image/image_module.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace skyfit::refs {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& error) {
  throw std::runtime_error(
      fmt::format("{}: cannot be read: {}", file.string(), error.substr(0, error.find('\n'))));
}

Image read(const std::filesystem::path& file) {
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string());
  if (!input) fail(file, OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.depth > 1 || spec.deep) fail(file, "expected a flat image");
  constexpr std::size_t kMostValues = std::size_t{1} << 30;
  if (spec.image_pixels() > kMostValues / static_cast<std::size_t>(std::max(spec.nchannels, 1)))
    fail(file, "expected at most 2^30 values");
  Image image{spec.width, spec.height, spec.channelnames, {}, {}};
  Chromaticities chromaticities;
  const OIIO::TypeDesc type(OIIO::TypeDesc::FLOAT, static_cast<int>(chromaticities.size()));
  if (spec.getattribute("chromaticities", type, chromaticities.data()))
    image.chromaticities = chromaticities;
  image.pixels.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  const bool whole =
      input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data());
  // Of a truncated TIFF or JPEG the reader only leaves a message.
  const std::string error = input->geterror();
  if (!whole || !error.empty()) fail(file, error);
  return image;
}

}  // namespace
}  // namespace skyfit::refs

extern "C" __attribute__((visibility("default"))) const void* skyfit_image_module() {
  static constexpr skyfit::refs::ImageModule kModule = {skyfit::refs::ImageModule::kRevision,
                                                        skyfit::refs::read};
  return &kModule;
}
