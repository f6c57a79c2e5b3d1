// SPDX-License-Identifier: Apache-2.0
// Profiles whose density is linear between corners that a few numbers give, which no fit varies:
// one row each in corner_profiles.cc, of a header in corner_profiles/. Presets, validation, lowered
// ground, solver and renderer follow from it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/atmosphere/table_format.h"

namespace skyfit {

inline constexpr std::size_t kMostProfileNumbers = 4;
using ProfileNumbers = std::array<double, kMostProfileNumbers>;

struct ProfileNumber {
  std::string_view field;  // of the preset
  bool is_height;          // above the bottom radius: it moves with the ground
};

struct ProfileProblem {
  std::size_t number;
  std::string expected;
};

struct CornerProfile {
  std::string_view name;
  std::vector<ProfileNumber> numbers;  // at most kMostProfileNumbers
  // What cannot be, numbers being finite; nothing where corners() can do it.
  std::optional<ProfileProblem> (*problem)(const ProfileNumbers& numbers);
  // Heights from 0 on, ascending, m; densities >= 0 and not all 0, as LinearProfile wants them.
  TwoColumns (*corners)(const ProfileNumbers& numbers);
};

std::span<const CornerProfile> corner_profiles();
// Its place there. Throws std::logic_error where there is none of that name.
std::size_t corner_profile_named(std::string_view name);

}  // namespace skyfit
