// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "model/atmosphere/derived.h"
#include "model/atmosphere/phase_moments.h"
#include "model/solver/reference_model.h"

namespace skyfit {

// A forward peak that the moments do not hold (a lobe of g above some 0.86, or of 0.85 in a cloud)
// is cut off too coarsely: twice the rays and moments. A lobe of g = 0.9 and optical depth 0.3 is
// then off by 0.7 % at worst instead of 2.4 %, a cloud of g = 0.85 and 2 by 0.5 instead of 4.9 %.
// Not where the atmosphere is thick against its planet: there few rays lie between the horizon and
// the limb, their quadrature of so many moments gains light, and in an optical depth of 9 (Titan)
// the field came out negative.
ReferenceOptions options_for(const Atmosphere<double>& atmosphere, ReferenceOptions options) {
  constexpr double kNarrow = 0.1;       // share of the scattering that would be cut off
  constexpr double kNarrowDepth = 0.1;  // the same times the vertical optical depth
  // A coarse mode beside a fine one scatters so little that its cut hardly shows.
  constexpr double kThinDepth = 0.01;
  const auto is_mode = [](const Constituent<double>& c) {
    return c.phase.type == PhaseType::kSizeDistribution;
  };
  constexpr double kThick = 0.05;  // top height over radius
  if (options.moments != ReferenceOptions{}.moments) return options;
  if (atmosphere.top_radius_m > (1 + kThick) * atmosphere.bottom_radius_m) return options;
  const auto is_narrow = [&](const Constituent<double>& c) {
    if (!scatters(c) || c.phase.type == PhaseType::kRayleigh) return false;
    constexpr double kGreen = 550;  // nm
    const double cut = phase_moments(phase_at(c.phase, kGreen), options.moments + 1).back();
    const double depth = cut * vertical_optical_depth(atmosphere, c, {kGreen, 0});
    return depth > kNarrowDepth || (cut > kNarrow && (!is_mode(c) || depth > kThinDepth));
  };
  if (std::ranges::any_of(atmosphere.constituents, is_narrow)) {
    options.streams *= 2;
    options.moments *= 2;
  }
  return options;
}

}  // namespace skyfit
