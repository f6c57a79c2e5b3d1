// SPDX-License-Identifier: Apache-2.0
// 1 from the ground to `mixed_m`, the height to which air is mixed, then falling to 0 at `end_m`.
#pragma once

#include <fmt/format.h>

#include "model/atmosphere/corner_profiles.h"

namespace skyfit {

inline CornerProfile mixed_layer() {
  return {"mixed-layer",
          {{"mixed_m", true}, {"end_m", true}},
          [](const ProfileNumbers& n) -> std::optional<ProfileProblem> {
            constexpr double kLeast = 1;  // m
            if (!(n[0] >= kLeast))
              return ProfileProblem{0, fmt::format("a height >= {} m", kLeast)};
            if (!(n[1] >= n[0] + kLeast))
              return ProfileProblem{
                  1, fmt::format("a height >= mixed_m + {} = {} m", kLeast, n[0] + kLeast)};
            return {};
          },
          [](const ProfileNumbers& n) -> TwoColumns {
            return {{0, n[0], n[1]}, {1, 1, 0}};
          }};
}

}  // namespace skyfit
