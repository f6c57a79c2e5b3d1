// SPDX-License-Identifier: Apache-2.0
#include "model/base/npy_file.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>

#include "model/base/whole_file.h"

namespace skyfit {

void write_npy(const std::filesystem::path& file, const std::vector<std::size_t>& shape,
               std::span<const float> values) {
  write_npy_bytes(file, shape, "<f4", sizeof(float), std::as_bytes(values));
}

void write_npy_bytes(const std::filesystem::path& file, const std::vector<std::size_t>& shape,
                     std::string_view type, std::size_t size, std::span<const std::byte> values) {
  write_whole_file(file, npy_bytes(shape, type, size, values));
}

// Magic bytes, length of the header, and the header: a Python dictionary, padded so that the
// numbers begin at a multiple of 64 bytes.
std::string npy_bytes(const std::vector<std::size_t>& shape, std::string_view type,
                      std::size_t size, std::span<const std::byte> values) {
  static_assert(std::endian::native == std::endian::little);
  if (std::accumulate(shape.begin(), shape.end(), size, std::multiplies<>()) != values.size())
    throw std::invalid_argument(
        fmt::format(".npy: {} values do not fill the shape", values.size() / size));
  std::string dimensions;
  for (const std::size_t extent : shape) dimensions += fmt::format("{}, ", extent);
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, dimensions);
  constexpr std::size_t kPrefix = 10, kAlignment = 64;
  header.append(kAlignment - 1 - (kPrefix + header.size()) % kAlignment, ' ');
  header += '\n';
  const auto length = static_cast<std::uint16_t>(header.size());
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(length & 0xff);
  bytes += static_cast<char>(length >> 8);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size());
  return bytes;
}

}  // namespace skyfit
