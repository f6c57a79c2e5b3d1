// SPDX-License-Identifier: Apache-2.0
// Pictures of a whole planet, as files that OpenImageIO reads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace skyfit {

// Equirectangular: north up, from longitude -180 to 180 degrees, twice as wide as high. Cube: its
// faces +x, -x, +y, -y, +z, -z side by side, as a globe is seen from outside; the first four stand
// north up, the last two adjoin the upper and the lower edge of +x.
enum class MapLayout { kEquirectangular, kCube };

enum class TexelType { kByte, kShort, kFloat };

struct MapFile {
  std::filesystem::path file;
  MapLayout layout;
  int rows;        // = columns / 2 or columns / 6
  TexelType type;  // that holds what the file does
};

// Throws std::runtime_error in one line that names the file, what was found and what was expected.
MapFile inspect_map(const std::filesystem::path& file, int channels);

// [row][column][channel], the first `channels` of the file; integers fill the range of their type,
// so that a kByte file may be read as kShort. Throws as inspect_map(), also for values that are not
// finite.
void read_map(const MapFile& map, int channels, std::vector<std::uint8_t>& texels);
void read_map(const MapFile& map, int channels, std::vector<std::uint16_t>& texels);
void read_map(const MapFile& map, int channels, std::vector<float>& texels);

}  // namespace skyfit
