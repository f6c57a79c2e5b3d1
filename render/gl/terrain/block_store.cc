// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/block_store.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace skyfit {
namespace {

constexpr int kBatch = 64;  // blocks made at a time: 4 MB
constexpr GLsizeiptr kBlockBytes = static_cast<GLsizeiptr>(kBlockVertices * sizeof(BlockVertex));

}  // namespace

BlockStore::BlockStore(const Ground& ground, double radius_m)
    : ground_(ground), radius_m_(radius_m) {}

void BlockStore::reserve(int blocks) {
  if (blocks <= capacity_) return;
  const int capacity = std::min(std::max(blocks, 2 * capacity_), kMostBlocks);
  GLuint id = 0;
  glCreateBuffers(1, &id);
  GlBuffer larger(id);
  glNamedBufferStorage(id, capacity * kBlockBytes, nullptr, GL_DYNAMIC_STORAGE_BIT);
  if (next_ > 0) glCopyNamedBufferSubData(vertices_.id(), id, 0, 0, next_ * kBlockBytes);
  vertices_ = std::move(larger);
  capacity_ = capacity;
}

int BlockStore::free_slot() {
  if (next_ < capacity_) return next_++;
  const auto oldest =
      std::min_element(slots_.begin(), slots_.end(),
                       [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
  if (oldest->second.used == frame_) throw std::length_error("render: too many blocks of terrain");
  const int slot = oldest->second.slot;
  slots_.erase(oldest);
  return slot;
}

void BlockStore::provide(std::span<const CubeBlock> blocks) {
  std::vector<CubeBlock> missing;
  for (const CubeBlock& block : blocks) {
    const auto found = slots_.find(block);
    if (found != slots_.end()) {
      found->second.used = frame_;
    } else {
      missing.push_back(block);
    }
  }
  if (missing.empty()) return;
  reserve(std::min(static_cast<int>(slots_.size() + missing.size()), kMostBlocks));
  std::vector<BlockVertex> made(static_cast<std::size_t>(kBatch) * kBlockVertices);
  std::array<BlockHeights, kBatch> heights{};
  for (std::size_t first = 0; first < missing.size(); first += kBatch) {
    const std::size_t count = std::min<std::size_t>(kBatch, missing.size() - first);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      heights[i] = make_block(missing[first + i], ground_, radius_m_,
                              std::span(made).subspan(i * kBlockVertices, kBlockVertices));
    });
    for (std::size_t i = 0; i < count; ++i) {
      const int slot = free_slot();
      slots_[missing[first + i]] = {slot, heights[i], frame_};
      glNamedBufferSubData(vertices_.id(), slot * kBlockBytes, kBlockBytes,
                           made.data() + i * kBlockVertices);
    }
  }
  made_ += static_cast<int>(missing.size());
}

}  // namespace skyfit
