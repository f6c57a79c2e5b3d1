// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/block_store.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

namespace skyfit {
namespace {

constexpr std::size_t kBatch = 64;  // blocks made at a time: 4 MB
constexpr GLsizeiptr kBlockBytes = static_cast<GLsizeiptr>(kBlockVertices * sizeof(BlockVertex));

// They are split, and kept, together.
bool are_siblings(const CubeBlock& a, const CubeBlock& b) {
  return a.face == b.face && a.level == b.level && a.column / 2 == b.column / 2 &&
         a.row / 2 == b.row / 2;
}

// Where the runs of siblings begin, and the end.
std::vector<std::size_t> families(std::span<const CubeBlock> blocks) {
  std::vector<std::size_t> begins = {0};
  for (std::size_t i = 1; i < blocks.size(); ++i)
    if (!are_siblings(blocks[i - 1], blocks[i])) begins.push_back(i);
  begins.push_back(blocks.size());
  return begins;
}

std::string name_of(const Ground& ground, double radius_m) {
  CacheKey key("ground");
  ground.add_inputs(key);
  return key.value(radius_m).name();
}

CacheKey key_of(const std::string& ground, std::span<const CubeBlock> blocks) {
  CacheKey key("blocks");
  key.text(ground);
  for (const auto& [face, level, column, row] : blocks)
    key.value(face).value(level).value(column).value(row);
  return key;
}

}  // namespace

BlockStore::BlockStore(const Ground& ground, double radius_m, ContentCache* cache)
    : ground_(ground), radius_m_(radius_m), cache_(cache) {
  if (cache_ != nullptr) ground_name_ = name_of(ground, radius_m);
}

void BlockStore::make(std::span<const CubeBlock> blocks, std::span<BlockHeights> heights,
                      std::span<BlockVertex> vertices) const {
  std::optional<CacheKey> key;
  if (cache_ != nullptr) {
    key.emplace(key_of(ground_name_, blocks));
    const auto room = [&](std::size_t part, std::uint64_t) {
      return part == 0 ? std::as_writable_bytes(heights) : std::as_writable_bytes(vertices);
    };
    if (cache_->find(*key, room)) return;
  }
  for (std::size_t i = 0; i < blocks.size(); ++i)
    heights[i] = make_block(blocks[i], ground_, radius_m_,
                            vertices.subspan(i * kBlockVertices, kBlockVertices));
  if (key) cache_->keep(*key, {std::as_bytes(heights), std::as_bytes(vertices)});
}

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
  std::vector<BlockVertex> made(kBatch * kBlockVertices);
  std::array<BlockHeights, kBatch> heights{};
  for (std::size_t first = 0; first < missing.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, missing.size() - first);
    const auto batch = std::span(missing).subspan(first, count);
    const std::vector<std::size_t> begins = families(batch);
    tbb::parallel_for(std::size_t{0}, begins.size() - 1, [&](std::size_t i) {
      const std::size_t begin = begins[i], size = begins[i + 1] - begin;
      make(batch.subspan(begin, size), std::span(heights).subspan(begin, size),
           std::span(made).subspan(begin * kBlockVertices, size * kBlockVertices));
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
