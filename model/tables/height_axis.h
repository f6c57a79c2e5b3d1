// SPDX-License-Identifier: Apache-2.0
// Where the texels of tables lie in height: as docs/theory (9.1) says, and beside layers, in which
// light changes over metres, at heights of their own.
#pragma once

#include <span>
#include <vector>

#include "model/atmosphere/shells.h"

namespace skyfit {

// Whether light changes over metres somewhere: a layer has more than a tenth of optical depth
// between two of 32 heights by docs/theory (9.1).
bool has_dense_layers(const Shells& shells);

class HeightAxis {
 public:
  HeightAxis() = default;  // by (9.1) alone

  // Texels as of a table of `heights` by (9.1) where no layer is; within dense layers, of more than
  // two within the two of the greatest optical depth, in steps that grow from either end. Without
  // them by (9.1) alone.
  HeightAxis(const Shells& shells, int heights);
  // Ascending values of unit_from_height() of model/shared/mapping.glsl, from 0 to 1, or none, and
  // the node at the deck.
  HeightAxis(std::vector<double> nodes, std::size_t deck) : nodes_(std::move(nodes)), deck_(deck) {}

  // Which (9.1) gives of the heights; evenly spaced texels are these. Empty: (9.1) alone.
  const std::vector<double>& nodes() const { return nodes_; }

  // The node at the top of the layer of the greatest optical depth, and its height, m; -1 without.
  int deck_node() const { return nodes_.empty() ? -1 : static_cast<int>(deck_); }
  double deck(double thickness) const;

  // docs/theory (9.13).
  // Coordinate 0..1 of a height (m) and back; `thickness` is the height of the atmosphere's top.
  double unit(double height, double thickness) const;
  double height(double unit, double thickness) const;

  // The least number of texels from `heights` on of which every node is one; `heights` by (9.1).
  int texels(int heights) const;

  friend bool operator==(const HeightAxis&, const HeightAxis&) = default;

 private:
  std::vector<double> nodes_;
  std::size_t deck_ = 0;
};

// Of the steps of an atmosphere that changes, whose shells hold all constituents (Keep::kAll) in
// the same order: the same node of each is the same place in a layer or between layers, wherever
// these move. Layers that are dense at any step are followed at all; of two that meet or pass each
// other the one of less optical depth is not.
std::vector<HeightAxis> height_axes(std::span<const Shells> steps, int heights);

// Nodes in between, linear in `share`. Throws std::invalid_argument unless both have as many.
HeightAxis interpolated(const HeightAxis& a, const HeightAxis& b, double share);

}  // namespace skyfit
