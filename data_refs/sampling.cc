// SPDX-License-Identifier: Apache-2.0
#include "data_refs/sampling.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

std::vector<SkyDirection> principal_plane_directions() {
  constexpr int kLastDeg = 85, kStepDeg = 5;
  std::vector<SkyDirection> directions;
  for (int deg = -kLastDeg; deg <= kLastDeg; deg += kStepDeg) {
    directions.push_back({std::abs(deg) * kRadiansPerDegree, deg < 0 ? kPi : 0.0});
  }
  return directions;
}

std::vector<TregenzaPatch> tregenza_patches() {
  constexpr std::array kPatchesOfRow = {30, 30, 24, 24, 18, 12, 6};
  constexpr int kRowHeightDeg = 12;
  std::vector<TregenzaPatch> patches;
  double bottom = 0;  // sine of the row's lower edge
  for (std::size_t row = 0; row < kPatchesOfRow.size(); ++row) {
    const int top_deg = kRowHeightDeg * (static_cast<int>(row) + 1);
    const double top = std::sin(top_deg * kRadiansPerDegree);
    const int count = kPatchesOfRow[row];
    for (int i = 0; i < count; ++i) {
      patches.push_back(
          {{(90 - top_deg + kRowHeightDeg / 2) * kRadiansPerDegree, 2 * kPi * i / count},
           2 * kPi * (top - bottom) / count});
    }
    bottom = top;
  }
  patches.push_back({{0.0, 0.0}, 2 * kPi * (1 - bottom)});
  return patches;
}

std::vector<SkyDirection> sampling_directions(Sampling sampling) {
  if (sampling == Sampling::kPrincipalPlane) return principal_plane_directions();
  std::vector<SkyDirection> directions;
  for (const TregenzaPatch& patch : tregenza_patches()) directions.push_back(patch.centre);
  return directions;
}

}  // namespace skyfit::refs
