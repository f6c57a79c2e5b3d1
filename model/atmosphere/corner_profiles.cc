// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/corner_profiles.h"

#include <algorithm>
#include <stdexcept>

#include "model/atmosphere/corner_profiles/mixed_layer.h"
#include "model/atmosphere/corner_profiles/tent.h"

namespace skyfit {

std::span<const CornerProfile> corner_profiles() {
  static const std::vector<CornerProfile> rows = {tent(), mixed_layer()};
  return rows;
}

std::size_t corner_profile_named(std::string_view name) {
  const auto rows = corner_profiles();
  const auto found = std::ranges::find(rows, name, &CornerProfile::name);
  if (found == rows.end()) throw std::logic_error("no profile of the name " + std::string(name));
  return static_cast<std::size_t>(found - rows.begin());
}

}  // namespace skyfit
