// SPDX-License-Identifier: Apache-2.0
#include "render/page/table_packing.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace skyfit {
namespace {

constexpr std::size_t kChannels = 4;

struct Steps {
  double offset = 0;             // what 0 stands for
  std::vector<std::int32_t> of;  // [texel][channel], 0..65535
};

Steps steps_of(const Table& table, const Packing& packing) {
  std::vector<double> held(table.rgba.begin(), table.rgba.end());
  if (packing.logarithm) {
    for (double& value : held) value = std::log(std::max(value, packing.least));
  }
  const auto [low, high] = std::ranges::minmax(held);
  constexpr double kMost = 65535;
  if (!((high - low) / packing.step < kMost))
    throw std::runtime_error("a table of the page spans too many steps or is not finite");
  Steps steps{low, {}};
  steps.of.reserve(held.size());
  for (const double value : held)
    steps.of.push_back(static_cast<std::int32_t>(std::lround((value - low) / packing.step)));
  return steps;
}

int row_of(const Table& table, const Packing& packing) {
  return packing.row > 0 ? packing.row : table.width;
}

// The plane through the neighbours before in x and y, where there are such.
std::int32_t predicted(const std::vector<std::int32_t>& steps, std::size_t at, bool has_left,
                       bool has_above, std::size_t above) {
  const std::int32_t left = has_left ? steps[at - kChannels] : 0,
                     top = has_above ? steps[at - above] : 0;
  if (has_left && has_above) return left + top - steps[at - above - kChannels];
  return has_left ? left : top;
}

// A plane of low bytes, then one of high bytes, of each channel after the other. Differences of 16
// bits wrap; 0, -1, 1, -2 .. become 0, 1, 2, 3 ..
std::vector<std::uint8_t> differences(const Table& table, const Steps& steps, int row) {
  const std::size_t texels = table.rgba.size() / kChannels,
                    width = static_cast<std::size_t>(table.width);
  std::vector<std::uint8_t> bytes(2 * table.rgba.size());
  for (std::size_t texel = 0; texel < texels; ++texel) {
    const bool has_left = texel % width % static_cast<std::size_t>(row) != 0,
               has_above = texel / width % static_cast<std::size_t>(table.height) != 0;
    for (std::size_t channel = 0; channel < kChannels; ++channel) {
      const std::size_t at = kChannels * texel + channel;
      const auto difference = static_cast<std::int16_t>(
          steps.of[at] - predicted(steps.of, at, has_left, has_above, kChannels * width));
      const auto folded = static_cast<std::uint16_t>((difference << 1) ^ (difference >> 15));
      bytes[channel * texels + texel] = static_cast<std::uint8_t>(folded & 0xff);
      bytes[(kChannels + channel) * texels + texel] = static_cast<std::uint8_t>(folded >> 8);
    }
  }
  return bytes;
}

std::string deflated(const std::vector<std::uint8_t>& bytes) {
  constexpr int kRaw = -15, kMemory = 9;  // no header; as zlib.h explains
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kRaw, kMemory, Z_FILTERED) != Z_OK)
    throw std::runtime_error("zlib cannot be initialised");
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = const_cast<Bytef*>(bytes.data());  // which zlib does not write to
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int status = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib cannot compress a table");
  return out;
}

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) -> std::uint32_t {
      return i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0;
    };
    const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? kDigits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

nlohmann::json packed(const Table& table, const Packing& packing) {
  const Steps steps = steps_of(table, packing);
  const int row = row_of(table, packing);
  return {{"width", table.width},
          {"height", table.height},
          {"depth", table.depth},
          {"row", row},
          {"step", packing.step},
          {"offset", steps.offset},
          {"logarithm", packing.logarithm},
          {"texels", base64(deflated(differences(table, steps, row)))}};
}

Table as_decoded(const Table& table, const Packing& packing) {
  const Steps steps = steps_of(table, packing);
  Table decoded = table;
  for (std::size_t i = 0; i < steps.of.size(); ++i) {
    const double held = steps.offset + packing.step * steps.of[i];
    decoded.rgba[i] = static_cast<float>(packing.logarithm ? std::exp(held) : held);
  }
  return decoded;
}

}  // namespace skyfit
