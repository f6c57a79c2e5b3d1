// SPDX-License-Identifier: Apache-2.0
// What the readers of images call in skyfit_image_module (model/base/module_file.h), the part of
// data_refs/ that loads OpenImageIO.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace skyfit::refs {

// x and y of red, green, blue and white.
using Chromaticities = std::array<float, 8>;

// Rows from the upper edge, channels interleaved; not a number where the file has no pixel.
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;                  // "R", "G", "B", ..
  std::vector<float> pixels;                          // height x width x channels
  std::optional<Chromaticities> chromaticities = {};  // where the file states them
  // "LatLong Environment" or "CubeFace Environment" where the file says so; empty otherwise.
  std::string environment = {};
  float white_luminance = 0;  // cd/m^2 of (1, 1, 1), where the file states it
  const float* pixel(int x, int y) const {
    return &pixels[(static_cast<std::size_t>(y) * width + x) * channels.size()];
  }
};

struct ImageModule {
  static constexpr int kRevision = 3;
  int revision;
  // `bytes`, unless empty, are read in the file's place. Throws std::runtime_error `file: cannot be
  // read: ...`.
  Image (*read)(const std::filesystem::path& file, const std::string& bytes);
};

}  // namespace skyfit::refs

// The module's only symbol.
extern "C" const void* skyfit_image_module();
