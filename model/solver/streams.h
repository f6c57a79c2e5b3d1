// SPDX-License-Identifier: Apache-2.0
// The directions in which the diffuse field is known: straight rays through spherical shells, each
// with one impact parameter. Rays to the ground have Gauss's cosines there and grow steeper with
// height, as straight lines do; rays along the limb touch the shell of a level and exist above it.
// On a very large planet these are the double-Gauss rule of plane-parallel discrete ordinates.
#pragma once

#include <vector>

namespace skyfit {

// How many rays go along the limb. In deep twilight all light comes along the horizon, most of it
// through the narrow band of heights that the sun still lights; in an extended atmosphere they are
// a large part of all directions.
enum class LimbRays { kOfDay, kOfTwilight, kOfExtended };

class Streams {
 public:
  // `ground_rays` per hemisphere; heights ascend from 0.
  Streams(double bottom_radius, const std::vector<double>& heights, int ground_rays,
          LimbRays limb_rays);

  int levels() const { return static_cast<int>(count_.size()); }
  // Rays at a level, in the order in which they come into being from the ground upward.
  int count(int level) const { return count_[level]; }
  int most() const { return count_.back(); }
  double mu(int level, int ray) const { return mu_[level * most() + ray]; }  // >= 0
  // Of a quadrature over mu = 0 .. 1: sums to 1.
  double weight(int level, int ray) const { return weight_[level * most() + ray]; }

 private:
  void correct_weights(int level);

  std::vector<int> count_;
  std::vector<double> mu_, weight_;  // [level][ray]
};

}  // namespace skyfit
