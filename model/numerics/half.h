// SPDX-License-Identifier: Apache-2.0
// Numbers as tables in half precision hold them.
#pragma once

#include <Eigen/Core>

namespace skyfit {

inline constexpr double kLeastHalf = 0x1p-24;  // above 0

// The nearest of binary16: 11 bits, fewer below 2^-14; 0 below kLeastHalf / 2.
inline double rounded_to_half(double x) {
  return static_cast<double>(static_cast<float>(Eigen::half(static_cast<float>(x))));
}

}  // namespace skyfit
