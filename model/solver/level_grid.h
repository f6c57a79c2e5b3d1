// SPDX-License-Identifier: Apache-2.0
// The levels at which the diffuse field is known, and interpolation between them.
#pragma once

#include <vector>

#include "model/atmosphere/shells.h"

namespace skyfit {

// What a quantity of the levels is between them: Lagrange's cubic through four levels, in the cube
// root of the height; on a level that level's.
struct LevelStencil {
  int first;  // of the levels
  std::vector<double> share;
};

// Of a grid, where nothing else is asked for.
inline constexpr int kDefaultLevels = 28;

class LevelGrid {
 public:
  // `count` levels at h_i = top (i / (count - 1))^3, and those that layers want besides, see
  // Profile::level_heights().
  LevelGrid(const Shells& shells, int count);

  // As it was asked for, without what layers add.
  int asked() const { return asked_; }
  // Ascending from 0 to the top.
  const std::vector<double>& heights() const { return heights_; }
  int size() const { return static_cast<int>(heights_.size()); }

  // The level, or a place between two levels, of a height.
  double coordinate(double height) const;
  LevelStencil stencil(double coordinate) const;

 private:
  int asked_;
  std::vector<double> heights_, roots_;
};

}  // namespace skyfit
