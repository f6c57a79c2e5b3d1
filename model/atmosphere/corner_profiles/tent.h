// SPDX-License-Identifier: Apache-2.0
// 0 at peak - half_width, 1 at the peak, 0 at peak + half_width.
#pragma once

#include <fmt/format.h>

#include "model/atmosphere/corner_profiles.h"

namespace skyfit {

inline CornerProfile tent() {
  return {"tent",
          {{"peak_m", true}, {"half_width_m", false}},
          [](const ProfileNumbers& n) -> std::optional<ProfileProblem> {
            constexpr double kLeastWidth = 1;  // m
            if (!(n[1] >= kLeastWidth))
              return ProfileProblem{1, fmt::format("a height >= {} m", kLeastWidth)};
            if (!(n[0] >= n[1]))
              return ProfileProblem{0, fmt::format("a height >= half_width_m = {} m", n[1])};
            return {};
          },
          [](const ProfileNumbers& n) -> TwoColumns {
            const double low = n[0] - n[1], high = n[0] + n[1];
            if (low > 0) return {{0, low, n[0], high}, {0, 0, 1, 0}};
            return {{low, n[0], high}, {0, 1, 0}};
          }};
}

}  // namespace skyfit
