// SPDX-License-Identifier: Apache-2.0
// The vertices of blocks in the device's memory: those of a frame are made when they are missing,
// in parallel, and stay for the frames that follow; the longest unused make room.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <vector>

#include "render/gl/block_mesh.h"
#include "render/gl/objects.h"

namespace skyfit {

class BlockStore {
 public:
  static constexpr int kMostBlocks = 6144;  // 68 kB each

  // Both outlive the store.
  BlockStore(const Ground& ground, double radius_m);

  // Makes what is missing, at most kMostBlocks in all; what the call before asked for may go.
  // Returns how many were made. Progress in 0..1.
  int provide(std::span<const CubeBlock> blocks, const std::function<void(double)>& progress);

  // Of a block that the last provide() asked for: where its vertices begin, in vertices.
  GLint first_vertex(const CubeBlock& block) const { return slots_.at(block).slot * kBlockVertices; }

  const HeightRange& heights(const CubeBlock& block) const { return slots_.at(block).heights; }

  GLuint vertices() const { return vertices_.id(); }

 private:
  struct Slot {
    int slot;
    HeightRange heights;
    std::int64_t used;  // by which call of provide()
  };
  void reserve(int blocks);
  int free_slot();

  const Ground& ground_;
  double radius_m_;
  GlBuffer vertices_;
  int capacity_ = 0, next_ = 0;
  std::int64_t call_ = 0;
  std::map<CubeBlock, Slot> slots_;
};

}  // namespace skyfit
