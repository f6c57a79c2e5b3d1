// SPDX-License-Identifier: Apache-2.0
// Automatic exposure of frames that follow one another, without flicker.
#pragma once

namespace skyfit {

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
