// SPDX-License-Identifier: Apache-2.0
#include "fit/exchange/srgb.h"

#include <Eigen/Dense>

namespace skyfit::fit {
namespace {

Eigen::Matrix3d from_xyz() {
  Eigen::Matrix3d m;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) m(row, column) = kLinearSrgbFromXyz[row][column];
  }
  return m;
}

std::array<double, 3> times(const Eigen::Matrix3d& m, const std::array<double, 3>& v) {
  const Eigen::Vector3d product = m * Eigen::Vector3d(v[0], v[1], v[2]);
  return {product[0], product[1], product[2]};
}

}  // namespace

Rgb linear_srgb(const Xyz& xyz) { return times(from_xyz(), xyz); }

std::vector<Rgb> linear_srgb(const std::vector<Xyz>& colors) {
  std::vector<Rgb> all;
  for (const Xyz& xyz : colors) all.push_back(linear_srgb(xyz));
  return all;
}

Xyz xyz_of_srgb(const Rgb& rgb) {
  static const Eigen::Matrix3d matrix = from_xyz().inverse();
  return times(matrix, rgb);
}

}  // namespace skyfit::fit
