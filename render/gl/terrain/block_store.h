// SPDX-License-Identifier: Apache-2.0
// The vertices of blocks in the device's memory: those of a frame are made when they are missing,
// in parallel, and stay for the frames that follow; the longest unused make room. A cache keeps
// them for other processes.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/base/content_cache.h"
#include "render/gl/context/objects.h"
#include "render/gl/terrain/block_mesh.h"

namespace skyfit {

class BlockStore {
 public:
  static constexpr int kMostBlocks = 6144;  // 68 kB each

  // `ground` and `cache` outlive the store; `cache` may be null.
  BlockStore(const Ground& ground, double radius_m, ContentCache* cache);

  // What is provided from now on stays until the next call.
  void begin_frame() { ++frame_; }

  // Makes what is missing. Throws std::length_error when a frame needs more than kMostBlocks.
  void provide(std::span<const CubeBlock> blocks);

  int take_made() { return std::exchange(made_, 0); }  // since the last call

  // Of a block of this frame: where its vertices begin, in vertices.
  GLint first_vertex(const CubeBlock& block) const {
    return slots_.at(block).slot * kBlockVertices;
  }

  const BlockHeights& heights(const CubeBlock& block) const { return slots_.at(block).heights; }

  GLuint vertices() const { return vertices_.id(); }

 private:
  struct Slot {
    int slot;
    BlockHeights heights;
    std::int64_t used;  // by which frame
  };
  // One after the other.
  void make(std::span<const CubeBlock> blocks, std::span<BlockHeights> heights,
            std::span<BlockVertex> vertices) const;
  void reserve(int blocks);
  int free_slot();

  const Ground& ground_;
  double radius_m_;
  ContentCache* cache_;
  std::string ground_name_;  // in the cache
  GlBuffer vertices_;
  int capacity_ = 0, next_ = 0;
  std::int64_t frame_ = 0;
  int made_ = 0;
  std::map<CubeBlock, Slot> slots_;
};

}  // namespace skyfit
