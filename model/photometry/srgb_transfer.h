// SPDX-License-Identifier: Apache-2.0
// The transfer function of sRGB, IEC 61966-2-1: linear light, 0 to 1, and its code value, 0 to 1.
#pragma once

#include <cmath>

namespace skyfit {

inline double srgb_encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

inline double srgb_decoded(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

}  // namespace skyfit
