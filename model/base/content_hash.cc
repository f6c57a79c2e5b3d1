// SPDX-License-Identifier: Apache-2.0
#include "model/base/content_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

namespace skyfit {
namespace fs = std::filesystem;

void ContentHash::add(std::string_view bytes) {
  for (const char byte : bytes)
    state_ = (state_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
}

void ContentHash::add_file(const fs::path& file) {
  if (fs::is_directory(file)) {
    std::vector<fs::path> inside;
    for (const auto& entry : fs::recursive_directory_iterator(file)) {
      if (entry.is_regular_file()) inside.push_back(entry.path());
    }
    std::ranges::sort(inside);
    for (const fs::path& path : inside) {
      add(path.lexically_relative(file).string());
      add_file(path);
    }
    return;
  }
  if (!fs::is_regular_file(file)) return;
  std::ifstream in(file, std::ios::binary);
  std::array<char, 1 << 16> block;
  while (in.read(block.data(), block.size()) || in.gcount() > 0)
    add({block.data(), static_cast<std::size_t>(in.gcount())});
}

std::string ContentHash::text() const { return fmt::format("{:016x}", state_); }

}  // namespace skyfit
