// SPDX-License-Identifier: Apache-2.0
// Frames together: side by side in one picture, or one after the other under an exposure that does
// not flicker.
#pragma once

#include <span>

#include "render/render.h"

namespace skyfit {

// From left to right with `gap` black pixels between them. All must have the same height, and
// layers all or none; the metadata is the first's, statistics are not kept.
Frame side_by_side(std::span<const Frame> frames, int gap);

// Follows the metered exposures of the frames as an eye does: the logarithm approaches that of the
// frame and is within 1/e of it after `adaptation_s`, 0 for at once. Depends on nothing but what it
// was given, so that a sequence that is continued looks as one that was not interrupted.
class Adaptation {
 public:
  explicit Adaptation(double adaptation_s) : adaptation_s_(adaptation_s) {}
  // The exposure of the next frame, m^2/cd, `passed_s` >= 0 after the one before.
  double next(double metered, double passed_s);

 private:
  double adaptation_s_;
  double exposure_ = 0;  // of the frame before; 0: there was none
};

}  // namespace skyfit
