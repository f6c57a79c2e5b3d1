// SPDX-License-Identifier: Apache-2.0
#include "render/gl/image_files.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <system_error>

#include "render/gl/tone.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

// x and y of red, green, blue and white: IEC 61966-2-1.
constexpr std::array<float, 8> kSrgbChromaticities = {0.64f, 0.33f, 0.30f,   0.60f,
                                                      0.15f, 0.06f, 0.3127f, 0.3290f};

// Writes beside the target under another name and renames, so that the file is whole or not there.
void write_whole(const fs::path& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                 const void* pixels) {
  const fs::path part = file.parent_path() / fmt::format(".{}.{}{}", file.stem().string(), getpid(),
                                                         file.extension().string());
  std::string error;
  std::error_code code;
  {
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(part.string());
    if (!output) {
      error = OIIO::geterror();
    } else if (!output->open(part.string(), spec) || !output->write_image(type, pixels) ||
               !output->close()) {
      error = output->geterror();
    }
  }
  if (error.empty()) {
    fs::rename(part, file, code);
    if (code) error = code.message();
  }
  if (error.empty()) return;
  fs::remove(part, code);
  throw std::runtime_error(
      fmt::format("{}: cannot write: {}", file.string(), error.substr(0, error.find('\n'))));
}

}  // namespace

void write_exr_file(const Frame& frame, const fs::path& file) {
  constexpr int kChannels = 7;
  OIIO::ImageSpec spec(frame.width, frame.height, kChannels, OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B", "luminance.Y", "view.zenith_deg", "view.azimuth_deg", "Z"};
  spec.z_channel = kChannels - 1;
  spec.attribute("compression", "zip");
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                 kSrgbChromaticities.data());
  for (const auto& [name, value] : frame.metadata) spec.attribute(name, value);
  const std::size_t pixels = frame.luminance.size();
  std::vector<float> packed(pixels * kChannels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::array<float, kChannels> values = {
        frame.rgb[3 * i],   frame.rgb[3 * i + 1],     frame.rgb[3 * i + 2],
        frame.luminance[i], frame.view_zenith_deg[i], frame.view_azimuth_deg[i],
        frame.depth_m[i]};
    std::copy(values.begin(), values.end(),
              packed.begin() + static_cast<std::ptrdiff_t>(i) * kChannels);
  }
  write_whole(file, spec, OIIO::TypeDesc::FLOAT, packed.data());
}

void write_png_file(const Frame& frame, const fs::path& file, const ToneOptions& tone) {
  OIIO::ImageSpec spec(frame.width, frame.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  for (const auto& [name, value] : frame.metadata) spec.attribute(name, value);
  const std::vector<std::uint8_t> bytes = tone_mapped(frame, tone);
  write_whole(file, spec, OIIO::TypeDesc::UINT8, bytes.data());
}

}  // namespace skyfit
