// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/lowered_ground.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "model/atmosphere/profile.h"

namespace skyfit {
namespace {

VerticalProfile<double> raised(VerticalProfile<double> profile, double by) {
  profile.base_m += by;
  profile.top_m += by;
  if (profile.type == ProfileType::kCorners) {
    const std::vector<ProfileNumber>& numbers = corner_profiles()[profile.corners].numbers;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (numbers[i].is_height) profile.numbers[i] += by;
  }
  if (profile.table) {
    TwoColumns corners{{0.0}, {profile.table->densities().front()}};
    for (std::size_t i = 0; i < profile.table->heights().size(); ++i) {
      corners.x.push_back(profile.table->heights()[i] + by);
      corners.y.push_back(profile.table->densities()[i]);
    }
    profile.table = std::make_shared<const LinearProfile>(std::move(corners));
  }
  return profile;
}

bool is_total(AmountType amount) {
  return amount != AmountType::kScattering && amount != AmountType::kExtinction;
}

}  // namespace

Atmosphere<double> lowered_by(double depth_m, const Atmosphere<double>& atmosphere) {
  if (depth_m == 0) return atmosphere;
  if (!(depth_m > 0 && depth_m < atmosphere.bottom_radius_m)) {
    throw std::invalid_argument(
        fmt::format("the ground lies {:.9g} m below planet.bottom_radius_m = {:.9g}: expected less",
                    depth_m, atmosphere.bottom_radius_m));
  }
  Atmosphere<double> lowered = atmosphere;
  lowered.bottom_radius_m -= depth_m;
  for (Constituent<double>& c : lowered.constituents) {
    const VerticalProfile<double> own = own_profile(atmosphere, c);
    const Profile before(own), after(raised(own, depth_m));
    if (c.amount_type == AmountType::kOxygenPairs && before.is_exponential()) {
      c.amount *=
          std::exp(0.5 * depth_m / before.scale_height());  // a pressure: they go as its square
    } else if (before.is_exponential()) {
      c.amount *= std::exp(depth_m / before.scale_height());
    } else if (is_total(c.amount_type)) {
      c.amount *= after.vertical_column().value / before.vertical_column().value;
    }
    if (c.profile.type != ProfileType::kSameAs && c.profile.type != ProfileType::kSquareOf)
      c.profile = raised(own, depth_m);
  }
  return lowered;
}

}  // namespace skyfit
