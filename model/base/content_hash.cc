// SPDX-License-Identifier: Apache-2.0
#include "model/base/content_hash.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <new>
#include <vector>

namespace skyfit {
namespace fs = std::filesystem;

struct ContentHash::State {
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> xxh3{XXH3_createState()};
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {
  if (!state_->xxh3 || XXH3_128bits_reset(state_->xxh3.get()) != XXH_OK) throw std::bad_alloc();
}

ContentHash::~ContentHash() = default;
ContentHash::ContentHash(ContentHash&&) noexcept = default;

void ContentHash::add(std::string_view bytes) {
  XXH3_128bits_update(state_->xxh3.get(), bytes.data(), bytes.size());
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

std::string ContentHash::text() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh3.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace skyfit
